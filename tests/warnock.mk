# tests/warnock.mk - subdivision of the page, in lines and in pixels.
unit_tests += %D%/test_window
%C%_test_window_SOURCES = %D%/test_window.c $(hand_sheet)
%C%_test_window_CPPFLAGS = $(hand_cppflags)
