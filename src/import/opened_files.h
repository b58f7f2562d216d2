/* opened_files.h - opens files for Assimp, and lists them: formats such as
 * glTF have their data in other files beside the model, and no output may
 * replace what was read. */
#ifndef IMPORT_OPENED_FILES_H
#define IMPORT_OPENED_FILES_H

#include <assimp/cfileio.h>

#include "base/memory.h"
#include "base/path.h"

struct opened_files {
  struct aiFileIO io; /* for aiImportFileEx; its files are read only */
  ARRAY(struct file_identity) file; /* every regular file that was opened */
  bool no_memory;                   /* some could not be listed */
};

void opened_files_init(struct opened_files *files);

#endif
