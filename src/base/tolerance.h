/* tolerance.h - every tolerance of the library, in one place.
 *
 * They serve input that was rounded before it came to us, and output.  Those of
 * contact are part of the definition of visibility: surfaces that touch do not
 * hide each other.  No other decides what is visible.  Each says its unit,
 * where it comes from, who uses it, and what ten times as much would do.  Error
 * bounds of filters are no tolerances: what they leave undecided is decided
 * exactly.
 *
 * Defined elsewhere, beside what they follow from: STRAIGHT in
 * judge/svg/svg_path.c, from TOLERANCE_CURVE_MM; FINE_UNIT_MM in api/verify.c,
 * from the resolutions of plotters. */
#ifndef BASE_TOLERANCE_H
#define BASE_TOLERANCE_H

/* Lines that are the same on the page count as one within this distance.
 * Unit        page grid units (2^-20 mm)
 * Derivation  an end point is rounded by at most 1/2 unit in x and in y, so by
 *             0.71 across any line; of two pieces of one line, each end lies
 *             within 2 * 0.71 = 1.41 of the other piece: rounded up.
 * Users       ink/lines/free_ends.c, ink/lines/isolated.c, ink/lines/nodes.c,
 *             ink/lines/overlap_collinear.c, ink/lines/overlap.c,
 *             ink/lines/overlap_output.c, ink/lines/short_spurs.c,
 *             ink/hatch/hatch_lines.c, ink/hatch/inset.c,
 *             visibility/fit/border_ends.c, visibility/fit/line_ends.c,
 *             visibility/fold/nearest_contours.c,
 *             visibility/fold/outline_gaps.c, visibility/index/bsp_plane.h,
 *             visibility/intersection/edge_crossing.c
 * Ten times   lines 20 nm apart, such as two models side by side, become one:
 *             still far below what a pen can show. */
#define TOLERANCE_COINCIDENT_UNITS 2

/* A point this close to the straight line past it is no corner.
 * Unit        page grid units (2^-20 mm)
 * Derivation  the points of a subdivided straight edge are rounded like any
 *             other, 1.41 units as above; those that TOLERANCE_COINCIDENT_UNITS
 *             moved are off by as much again in either direction, rarely.
 * Users       ink/lines/straighten.c
 * Ten times   a finely divided circle loses points where it bends by less
 *             than 20 nm: shorter files, no visible change. */
#define TOLERANCE_COLLINEAR_UNITS 2.0

/* Lines of a drawing that is tidied as a pen shows it are one within this
 * distance, whatever the output's step: so what is left out or joined is the
 * same in all formats.
 * Unit        mm
 * Derivation  the step of SVG's three decimals, less than a hundredth of the
 *             thinnest pens.
 * Users       ink/ink.c, ink/ink_lines.c
 * Ten times   a slit of 0.01 mm is drawn as one line. */
#define TOLERANCE_TIDY_MM 0.001

/* A normal of the smooth surface is at right angles to the view where the
 * cosine between them is no more.
 * Unit        1
 * Derivation  a normal is a sum of some ten terms, each of a cross product of
 *             differences of coordinates that are themselves rounded: some
 *             hundred units of 2^-53, and ten times as much for a model far
 *             from its origin.
 * Users       visibility/zero_set/facing.h
 * Ten times   contours move by 1e-11 of the surface's radius. */
#define TOLERANCE_FACING 0x1p-40

/* Parts of the outline that smooth contours leave open are found to within
 * this, and contours that end no farther apart leave none.
 * Unit        page grid units (2^-20 mm)
 * Derivation  an eighth of a millimetre, less than half of a common pen's
 *             width: a gap that ink fills.
 * Users       visibility/fit/border_ends.c,
 *             visibility/contour/doubled_cells.h,
 *             visibility/contour/page_loop.h, visibility/fold/fold_chains.c,
 *             visibility/fold/intersection_gaps.c,
 *             visibility/fold/nearest_contours.c,
 *             visibility/fold/outline_gaps.c, visibility/smooth_contours.c
 * Ten times   gaps of a millimetre stay open. */
#define TOLERANCE_OUTLINE_UNITS (1 << 17)

/* The outline of fills follows the drawn outline where it is farther from it
 * than this.
 * Unit        page grid units (2^-20 mm)
 * Derivation  1/64 mm, a tenth of what the thinnest pens draw.
 * Users       visibility/fit/corner_moves.c,
 *             visibility/fit/drawn_outlines.c, visibility/fit/fit_outline.c
 * Ten times   a rim of the fill 0.16 mm wide, or of paper, shows beside a thin
 *             line. */
#define TOLERANCE_FILL_UNITS (1 << 14)

/* Normals that a file gives to two faces at a common corner are one where the
 * square of the cosine between them is no less; and faces that bend by no more
 * meet at no edge that is marked.
 * Unit        1 (the square of a cosine)
 * Derivation  one degree: normals that are written with two digits are off by
 *             half of it, those of CAD programs at the seams of smooth surfaces
 *             by some tenths.
 * Users       scene/corner_normals.c, scene/edges/crease_marks.c
 * Ten times   hard edges that bend by less than ten degrees are none. */
#define TOLERANCE_NORMAL_SQUARED_COSINE 0.99969541350954785

/* Two faces bend only if the cosine between their normals is below that of the
 * crease angle by more than this.
 * Unit        1 (a cosine)
 * Derivation  each unit normal is off by about 2 units in the last place and
 *             their product by as many again: 8 * 2^-53, so that a flat or a
 *             square joint is not a crease by rounding.
 * Users       scene/edges/edge_classes.c, scene/edges/crease_marks.c
 * Ten times   joints within 5e-8 rad of the crease angle count as within. */
#define TOLERANCE_CREASE_COSINE (8 * 0x1p-53)

/* A face turns by rounding by no more than so many errors of its largest
 * coordinate over its least height.
 * Unit        1
 * Derivation  where one corner moves by the root of three of an error one way
 *             and others the other way, it turns by 3.5 of them over its
 *             height: rounded up.
 * Users       scene/edges/crease_rounding.c
 * Ten times   in single precision creases of 30.01 degrees are none where faces
 *             are a hundredth of the model wide. */
#define TOLERANCE_CREASE_ERRORS 4

/* What rounding of coordinates changes of the cosine between two faces counts
 * as no more than this.
 * Unit        1 (a cosine)
 * Derivation  a twentieth of a degree about 30: of scans, whose faces are so
 *             small that rounding turns them by more, creases stay as they are.
 * Users       scene/edges/crease_rounding.c, scene/edges/edge_classes.c
 * Ten times   creases of 30.5 degrees between the small faces of a scan are
 *             none, which divides lines of noise so that more are drawn. */
#define TOLERANCE_CREASE_ROUNDING 0x1p-11

/* The up direction and the view direction are one if the sine between them is
 * not above this.
 * Unit        1 (a sine)
 * Derivation  below it, half of the digits of the camera's right would be
 *             rounding noise.
 * Users       view/camera_axes.c
 * Ten times   views within 1.5e-7 rad of up are refused. */
#define TOLERANCE_UP_SINE 0x1p-26

/* A perspective eye farther away than this has the view of an orthographic
 * view does.
 * Unit        the scene's diagonal
 * Derivation  a point half a diagonal behind the middle and half of one aside
 *             moves on the page by 2^-29 of the drawing's extent, half a grid
 *             unit on A4; and differences to an eye so far away are off by
 *             2^-26 of the diagonal.  The one error falls and the other rises
 *             with the distance: they meet here.
 * Users       view/camera_aim.c
 * Ten times   eyes almost as far lose another three bits of their depths. */
#define TOLERANCE_FAR_EYE 0x1p27

/* A scene at true scale is refused where one unit in the last place of its
 * extent is more than this on the page.
 * Unit        mm
 * Derivation  a pen is ten times as wide; a scene of 45,000 km in true size has
 *             units of this.
 * Users       view/camera_aim.c
 * Ten times   lines are drawn where they are not, by half a pen. */
#define TOLERANCE_SCALE_MM 0.01

/* Planes of a cut are one where their unit normals differ by no more.
 * Unit        of a coordinate of a unit normal
 * Derivation  half the grid on which points of a cut lie, 2^-38 of the scene.
 * Users       cut/cut_points.c
 * Ten times   planes that cross in the scene are taken for one. */
#define TOLERANCE_PARALLEL_PLANES 0x1p-39

/* A drawing of what a cut leaves is refused where one unit of the grid on which
 * the points of the cut lie is more than this on the page.
 * Unit        mm
 * Derivation  as of TOLERANCE_SCALE_MM; what is left is then a 2^-24 of the
 *             model that fills a page of 200 mm.
 * Users       api/preparation.c
 * Ten times   cut faces end where they do not, by half a pen. */
#define TOLERANCE_CUT_MM 0.01

/* Nearest that a perspective view comes to the eye where no near distance is
 * given and something is drawn still nearer.
 * Unit        share of the distance from the eye to its target
 * Derivation  depths on the page go as 1 / d in 40 bits, so with a near plane
 *             at n a grid unit of depth at distance d is d^2 / (2^40 n) long:
 *             2^-26 of d at the target, and a thousandth of d sixty thousand
 *             times as far away.
 * Users       view/camera_aim.c, api/preparation.c
 * Ten times   the near plane cuts more of a wall that the eye touches; depths
 *             beyond it are ten times finer. */
#define TOLERANCE_NEAR_SHARE 0x1p-14

/* How much of what two roundings may do, to a plane and to a point that touches
 * it, is taken to be contact.
 * Unit        1
 * Derivation  all of it; a little less, so that level faces which are meant to
 *             lie one unit of the last place apart do.
 * Users       view/coordinate_error.c, judge/contact.c
 * Ten times   walls as thick as ten units of the last place are seen
 *             through. */
#define TOLERANCE_ROUNDING_SHARE (63 / 64.0)

/* Contact on the page's grid, where the user gives no length.
 * Unit        page grid units (2^-20 mm), and units of depth
 * Derivation  one explains what rounding to the grid does to a point over a
 *             triangle; beyond the triangle, where the corners of another one
 *             are tested, it grows with the distance over the
 *             triangle's width.
 * Users       view/layout_clipping.c, visibility/predicate/contact.c,
 *             visibility/intersection/edge_crossing.c, api/verify.c
 * Ten times   faces 0.15 um apart on paper count as touching. */
#define TOLERANCE_CONTACT_GRID_UNITS 16

/* Ends of lines of a section that are no farther apart, in each coordinate, are
 * joined where one line begins and another ends.
 * Unit        units of the grid of a cut, 2^-38 of the scene's extent
 * Derivation  an edge that neighbouring faces have in different pieces meets a
 *             plane in points that are rounded separately: by 1/2 unit each,
 *             and more where the edge nearly lies in the plane.
 * Users       cut/cut_sections.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_SECTION_UNITS 4

/* Extents of the drawing and of its depth below this are rounding noise: a
 * wire seen end-on, a plate seen square-on.
 * Unit        share of the scene's diagonal
 * Derivation  view coordinates are sums of three products, off by about
 *             2^-51 of the diagonal, more for a model far from its origin.
 * Users       view/camera_fit.c, view/project.c, view/layout_clipping.c,
 *             view/preferred_scale.c, api/multiview_grid.c, api/captions.c,
 *             judge/triangles.c, judge/sampler.c
 * Ten times   a plate turned by 1e-11 rad still counts as square-on. */
#define TOLERANCE_EXTENT_SHARE 0x1p-40

/* A face is counted as warped where a corner is off its plane by more.
 * Unit        share of the face's own extent
 * Derivation  single precision and six digits round a point by 1e-7 of its
 *             size; sums of a few of those stay below.
 * Users       scene/triangulation/triangulate.c, judge/triangles.c
 * Ten times   fewer faces are counted as warped. */
#define TOLERANCE_WARP_SHARE 1e-6

/* Corners of borders are joined, where the user does not say, over so many
 * times what rounding moved a coordinate ...
 * Unit        1
 * Derivation  two corners that should be one were computed in several ways: a
 *             chain of some ten operations in the file's precision, each off
 *             by half a unit in the last place, at either corner.
 * Users       scene/weld/weld_near.c
 * Ten times   of %.6f, gaps of 1.6e-4 units: see the next. */
#define TOLERANCE_WELD_ERRORS 32

/* ... but only over four times that where it is more than this share of the
 * model.
 * Unit        share of the common scale of the coordinates
 * Derivation  2^-18 of a sheet of A4 is 1 um, a hundredth of a fine pen.
 * Users       scene/weld/weld_near.c
 * Ten times   gaps of 10 um on the page are closed; still a tenth of a pen. */
#define TOLERANCE_WELD_SHARE 0x1p-18

/* ... and never over more than this share of the smallest face about a corner.
 * Unit        share of the face's longest side
 * Derivation  parts of a face that are so thin are not seen, even where the
 *             face is as large as the page: a millimetre by 297 mm.
 * Users       scene/weld/weld_near.c, scene/weld/thin_faces.c,
 *             scene/face_normal.c
 * Ten times   gaps of a tenth of a face are closed, which can be seen. */
#define TOLERANCE_WELD_FACE_SHARE 0x1p-8

/* Where many corners of borders are no farther apart than this, a warning says
 * that they may be meant to be one.
 * Unit        share of the size of the faces about a corner
 * Derivation  by experience: modelled gaps are wider.
 * Users       scene/weld/weld_suspicion.c
 * Ten times   models of loose plates are warned about too. */
#define TOLERANCE_GAP_SHARE 0x1p-6

/* A polygon shows no area along an axis where it is no more than this.
 * Unit        share of the square of the polygon's extent
 * Derivation  the areas of lobes that cancel add up to rounding noise, 2^-53 of
 *             the square for each of the corners: this leaves room for
 *             thousands.
 * Users       scene/triangulation/polygon.c, judge/triangulation.c,
 *             judge/intersections.c
 * Ten times   needles that are ten times wider, in relation to their length,
 *             are projected along their thinnest extent, and may be
 *             triangulated otherwise. */
#define TOLERANCE_NO_AREA_SHARE 0x1p-40

/* How far the judge's rays are moved to either side of an edge.
 * Unit        mm
 * Derivation  20 grid units: what the page grid rounds, and doubles do in a
 *             ray's way through the scene, is a tenth of it.
 * Users       judge/options.c
 * Ten times   slits and slivers of 0.2 um are passed over. */
#define TOLERANCE_JUDGE_RAY_OFFSET_MM 2e-5

/* Faces are nearly parallel, for the judge, below this: where they intersect on
 * the page grid may be far from where they do in the scene.
 * Unit        1 (the sine of their angle)
 * Derivation  rounding either by two grid units moves the line by four over the
 *             sine: by no more than a line may be off, 1.5 um, above 2.5e-3.
 * Users       judge/intersections.c
 * Ten times   ink between faces at less than 1.4 degrees is left open. */
#define TOLERANCE_JUDGE_PARALLEL 2.5e-3

/* The judge leaves open what a face's slope to the view, or an edge's angle to
 * the crease angle, is within this of.
 * Unit        1 (a sine, a cosine)
 * Derivation  single precision rounds a normal by 1e-7 of its length and that
 *             of a face a hundred times longer than wide by 1e-5.
 * Users       judge/collinear_cuts.c, judge/cut_edges.c, judge/edge_classes.c,
 *             judge/edge_classes.h, judge/missing_run.c, judge/winding.c
 * Ten times   silhouettes seen within 0.006 degrees of edge-on may be missing
 *             unnoticed. */
#define TOLERANCE_JUDGE_ANGLE 1e-5

/* The judge takes the near plane to be nearer by this.
 * Unit        share of the near distance
 * Derivation  doubles place a point of the near plane within 1e-15 of it; this
 *             is well above, and far below what is seen.
 * Users       judge/camera.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_JUDGE_NEAR_SHARE 1e-9

/* The judge leaves open what is this close to a plane that cuts the scene, and,
 * of an eighth of it, to a side of a triangle where it counts what a ray leaves
 * and enters.
 * Unit        share of the scene's diagonal
 * Derivation  a cut's points are rounded to 2^-37 of the scene's extent, and
 *             doubles place the crossing of a ray and a triangle within 2^-40
 *             of it: this is well above, and a tenth of a micrometre on A4.
 * Users       judge/judge_context.c, judge/winding.c
 * Ten times   lines within a micrometre of a cut are left open. */
#define TOLERANCE_JUDGE_CUT_SHARE 1e-9

/* The judge has no image of an edge nearer to the eye than this.
 * Unit        share of the distances of its ends from the eye
 * Derivation  8 roundings of a double; nearer than that, its depth may be wrong
 *             in sign.
 * Users       judge/edge_list.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_JUDGE_EYE_SHARE 0x1p-50

/* What lies on the margins' border is inside them for the judge, as a drawing
 * that fits them has its outermost lines there.
 * Unit        mm
 * Derivation  doubles place a point of the page within 1e-10 mm; the drawing's
 *             own border is 4e-6 mm farther out.
 * Users       api/judge_input.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_JUDGE_MARGIN_MM 1e-9

/* The judge clips edges whose images reach farther than this from the page, as
 * they do beside the eye.
 * Unit        mm
 * Derivation  doubles place a point of such an image within 1e-10 mm; of one
 *             of 1e13 mm within 0.002 mm, and strokes along it would be false.
 * Users       judge/edge_list.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_JUDGE_IMAGE_MM 1e6

/* Curves of a drawing that is judged are as straight pieces off by no more.
 * Unit        mm
 * Derivation  what three decimals of a millimetre round.
 * Users       judge/svg/svg_pen.c
 * Ten times   a third as many pieces; still a tenth of a fine pen. */
#define TOLERANCE_CURVE_MM 1e-3

/* A curve that the circle of a detail cuts becomes a polyline no farther from
 * it than this.
 * Unit        mm
 * Derivation  a fifth of RECTO_FINEST_MM, which plotters resolve.
 * Users       drawing/circle_clip.c
 * Ten times   chords of curves may show in print beside the circle. */
#define TOLERANCE_CUT_CURVE_MM 0.002

/* The polygon that stands for an arc is no farther from it than this.
 * Unit        mm
 * Derivation  half of RECTO_FINEST_MM, which plotters resolve.
 * Users       drawing/curve.c
 * Ten times   the circle of a detail shows its corners in print. */
#define TOLERANCE_ARC_MM 0.005

/* A region whose tones differ by less is uniform.
 * Unit        1 (a tone, 0 to 1)
 * Derivation  half a step of 8 bits: neither a pen nor a screen shows less.
 * Users       ink/tone.c
 * Ten times   shallow curved surfaces get hatching of one density. */
#define TOLERANCE_TONE (1.0 / 512)

/* Faces are coplanar where the sine of the angle between their normals is no
 * more, and corners of a face where they are no farther from its plane, in
 * square roots of twice its area.
 * Unit        1
 * Derivation  brightness changes by no more than the angle to the light, in
 *             radians: faces of one plane differ by less than TOLERANCE_TONE.
 * Users       ink/planar_regions.c
 * Ten times   facets of finely divided curved surfaces become one plane. */
#define TOLERANCE_COPLANAR (1.0 / 1024)

/* Runs of tone hatching, and gaps in it, that only the tone limits are noise
 * where they are shorter.
 * Unit        pen widths
 * Derivation  by eye: a run of six widths is seen as a line, a shorter one as a
 *             dot (hatch_runs.h).
 * Users       ink/hatch/tone_hatch.c
 * Ten times   light tones lose most of their lines. */
#define TOLERANCE_TONE_PENS 6.0

/* The least distance that weights a sample of a curve.
 * Unit        mm
 * Derivation  two page grid units: weights, whose inverse square roots these
 *             are, stay finite and within 1e10 of each other.
 * Users       ink/curve/cubic_fit.c
 * Ten times   curves pass a little farther from where lines nearly meet. */
#define TOLERANCE_FIT_WEIGHT_MM 2e-6

/* Control points of a curve that are to be exactly on a line may be off it by
 * this.
 * Unit        mm
 * Derivation  doubles place a point of a page of 2 m within 1e-12 mm, after a
 *             dozen operations.
 * Users       ink/curve/cubic_fit.c
 * Ten times   nothing that could be seen. */
#define TOLERANCE_FIT_ROUNDING_MM 1e-10

/* Samples whose normal equations have a smaller determinant lie on a straight
 * line, and no parabola is fitted to them.
 * Unit        share of the product of the diagonal
 * Derivation  half of the digits of doubles, so that what is left has six.
 * Users       ink/curve/part_fit.c
 * Ten times   slightly fewer directions follow a parabola. */
#define TOLERANCE_PARABOLA_SHARE 1e-6

/* A page may be larger than the paper by this much.
 * Unit        mm
 * Derivation  sizes in inches are rounded, 8.5in is no binary number, and
 *             paper is cut no better.
 * Users       backends/device.c
 * Ten times   pages 5 mm too large are plotted without a warning. */
#define TOLERANCE_PAPER_MM 0.5

/* A change of the pen's way in the air is made where it gains more.
 * Unit        mm
 * Derivation  sums of distances up to 2 m are rounded to 1e-12 mm; a gain
 *             well above it is a real one, so no two moves can undo each
 *             other for ever.
 * Users       ink/order/tour.c
 * Ten times   nothing that could be measured. */
#define TOLERANCE_TRAVEL_MM 1e-6

#endif
