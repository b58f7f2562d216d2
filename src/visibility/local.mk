librecto_core_la_SOURCES += \
  %D%/auto.c \
  %D%/brute.c \
  %D%/contact.c %D%/contact.h \
  %D%/copies.c %D%/copies.h \
  %D%/cover.c %D%/cover.h \
  %D%/crowd.c %D%/crowd.h \
  %D%/cut.c %D%/cut.h \
  %D%/depths.c %D%/depths.h \
  %D%/edge_query.c %D%/edge_query.h \
  %D%/facet.c %D%/facet.h \
  %D%/fragments.c %D%/fragments.h \
  %D%/hide.c %D%/hide.h \
  %D%/leftover.c %D%/leftover.h \
  %D%/map.c %D%/map.h \
  %D%/newell.c \
  %D%/newell_order.c %D%/newell_order.h \
  %D%/newell_tests.c %D%/newell_tests.h \
  %D%/octagon.h \
  %D%/outline.c %D%/outline.h \
  %D%/pagegrid.c %D%/pagegrid.h \
  %D%/painter.c \
  %D%/pair.c %D%/pair.h \
  %D%/pieces.c %D%/pieces.h \
  %D%/pierce.c %D%/pierce.h \
  %D%/pierce_pairs.c %D%/pierce_pairs.h \
  %D%/pierce_segment.c %D%/pierce_segment.h \
  %D%/pixels.c %D%/pixels.h \
  %D%/pulse.c %D%/pulse.h \
  %D%/raster.c %D%/raster.h \
  %D%/rivals.c %D%/rivals.h \
  %D%/rivals_part.c \
  %D%/scanline_zbuffer.c %D%/scanline_zbuffer.h \
  %D%/seams.c %D%/seams.h \
  %D%/sidegrid.c %D%/sidegrid.h \
  %D%/sidelabel.c %D%/sidelabel.h \
  %D%/solver.c %D%/solver.h \
  %D%/spans.c %D%/spans.h \
  %D%/stance.c %D%/stance.h \
  %D%/strokes.c %D%/strokes.h \
  %D%/subpixels.c %D%/subpixels.h \
  %D%/surround.c %D%/surround.h \
  %D%/tilelist.c %D%/tilelist.h \
  %D%/tilemap.c %D%/tilemap.h \
  %D%/tiles.c \
  %D%/trace.c %D%/trace.h \
  %D%/undecided.c %D%/undecided.h \
  %D%/warnock.c \
  %D%/warnock_raster.c %D%/warnock_raster.h \
  %D%/warnock_sample.c %D%/warnock_sample.h \
  %D%/warnock_window.c %D%/warnock_window.h \
  %D%/watkins.c %D%/watkins.h \
  %D%/watkins_cells.c %D%/watkins_cells.h \
  %D%/watkins_edges.c \
  %D%/watkins_ends.c \
  %D%/watkins_exact.c %D%/watkins_exact.h \
  %D%/watkins_interval.c \
  %D%/watkins_lists.c \
  %D%/watkins_places.c \
  %D%/watkins_sweep.c %D%/watkins_sweep.h \
  %D%/window.c %D%/window.h \
  %D%/zbuffer.c %D%/zbuffer.h \
  %D%/zfill.c %D%/zfill.h \
  %D%/zsmall.c %D%/zsmall.h
