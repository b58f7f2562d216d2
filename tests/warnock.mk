# tests/warnock.mk - subdivision of the page, in lines and in pixels.
unit_tests += %D%/test_window
%C%_test_window_SOURCES = %D%/test_window.c $(exact_sheet)
%C%_test_window_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_warnock_raster
%C%_test_warnock_raster_SOURCES = %D%/test_warnock_raster.c $(exact_pixels)
%C%_test_warnock_raster_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_warnock
%C%_test_warnock_SOURCES = %D%/test_warnock.c $(exact_sheet)
%C%_test_warnock_CPPFLAGS = $(exact_cppflags)
