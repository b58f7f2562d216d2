# doc/local.mk - the man page and the documents that go with a release.
dist_man_MANS = %D%/recto.1
EXTRA_DIST += NEWS.md CONTRIBUTING.md BIBLIOGRAPHY.md \
	%D%/algorithms.md %D%/decisions %D%/draw.sh %D%/glossary.md \
	%D%/python.md %D%/testing.md

# The README's pictures, as recto draws them now; a test compares them.
PICTURES = %D%/images/castle.svg %D%/images/gears.svg %D%/images/knot.svg
EXTRA_DIST += $(PICTURES)
images: recto
	bash '$(srcdir)/%D%/draw.sh' ./recto '$(srcdir)/examples/models' \
	  '$(srcdir)/%D%/images'
.PHONY: images
