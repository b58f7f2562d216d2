# src/import/local.mk - the importer: the only program that sees Assimp.
if HAVE_ASSIMP
pkglibexec_PROGRAMS += recto-import
recto_import_SOURCES = %D%/importer.c \
  %D%/opened_files.c %D%/opened_files.h \
  %D%/unit_3mf.c %D%/unit_3mf.h
recto_import_LDADD = librecto_core.la $(ASSIMP_LIBS)
endif
