# doc/local.mk - the man page and the documents that go with a release.
dist_man_MANS = %D%/recto.1
EXTRA_DIST += NEWS.md CONTRIBUTING.md BIBLIOGRAPHY.md \
	%D%/algorithms.md %D%/decisions

# The README's pictures, as recto draws them now; a test compares them.
PICTURES = %D%/images/castle.svg
EXTRA_DIST += $(PICTURES)
CASTLE = '$(srcdir)/examples/models/castle.obj' \
	--page 180x140mm --margin 2mm
images: recto
	./recto $(CASTLE) -o '$(srcdir)/%D%/images/castle.svg'
.PHONY: images
