# src/import/local.mk - the importer: the only program that sees Assimp.
if HAVE_ASSIMP
pkglibexec_PROGRAMS += recto-import
recto_import_SOURCES = %D%/importer.c \
  %D%/archive_3mf.c %D%/archive_3mf.h \
  %D%/model_3mf.c %D%/model_3mf.h \
  %D%/opened_files.c %D%/opened_files.h \
  %D%/xml_tags.c %D%/xml_tags.h
recto_import_LDADD = librecto_core.la $(ASSIMP_LIBS)
endif
