# doc/local.mk - the man pages and the documents that go with a release.
dist_man_MANS = %D%/recto.1
man_MANS = %D%/recto.3
CLEANFILES += %D%/recto.3
EXTRA_DIST += %D%/recto.3.in %D%/manual.awk
%D%/recto.3: %D%/recto.3.in %D%/manual.awk src/recto.h
	@$(MKDIR_P) $(@D)
	$(AM_V_GEN)$(AWK) -f $(srcdir)/%D%/manual.awk $(srcdir)/src/recto.h \
	  $(srcdir)/%D%/recto.3.in >$@.new && mv $@.new $@

EXTRA_DIST += NEWS.md CONTRIBUTING.md BIBLIOGRAPHY.md \
	%D%/algorithms.md %D%/decisions %D%/draw.sh \
	%D%/contact_sheet.sh %D%/glossary.md \
	%D%/python.md %D%/testing.md %D%/gallery.md \
	%D%/plotting.md %D%/figures.md %D%/testing-with-recto.md \
	%D%/part-format.md %D%/large.md %D%/speed.md

# What completes command lines in bash and zsh, by the program's own table of
# options; a program that was built for another machine is not run.
if !CROSS_COMPILING
bashcompletiondir = $(datadir)/bash-completion/completions
bashcompletion_DATA = %D%/completion/recto
zshcompletiondir = $(datadir)/zsh/site-functions
zshcompletion_DATA = %D%/completion/_recto
CLEANFILES += $(bashcompletion_DATA) $(zshcompletion_DATA)
endif
%D%/completion/recto: recto$(EXEEXT)
	@$(MKDIR_P) $(@D)
	$(AM_V_GEN)./recto --completion bash >$@
%D%/completion/_recto: recto$(EXEEXT)
	@$(MKDIR_P) $(@D)
	$(AM_V_GEN)./recto --completion zsh >$@

# The pictures of the README and of the gallery, as recto draws them now; a test
# compares them.
EXTRA_DIST += %D%/images/castle.svg %D%/images/gears.svg %D%/images/knot.svg \
  %D%/images/gallery
images: recto
	bash '$(srcdir)/%D%/draw.sh' ./recto '$(srcdir)/examples/models' \
	  '$(srcdir)/%D%/images'
# Twelve drawings by default options, to be looked at.
contact-sheet: recto
	$(AM_TESTS_ENVIRONMENT) bash '$(srcdir)/%D%/contact_sheet.sh' ./recto \
	  '$(srcdir)/examples/models' contact-sheet.svg
CLEANFILES += contact-sheet.svg
.PHONY: images contact-sheet
