/* opened_files.c - opens files for Assimp, and lists them. */
#include "import/opened_files.h"

#include <limits.h>
#include <stdio.h>

static FILE *file_of(struct aiFile *opened) { return (FILE *)opened->UserData; }

static size_t read_file(struct aiFile *opened, char *to, size_t size,
                        size_t count) {
  return fread(to, size, count, file_of(opened));
}

static size_t write_nothing(struct aiFile *opened, const char *from,
                            size_t size, size_t count) {
  (void)opened, (void)from, (void)size, (void)count;
  return 0;
}

static void flush_nothing(struct aiFile *opened) { (void)opened; }

static size_t tell(struct aiFile *opened) {
  long at = ftell(file_of(opened));
  return at > 0 ? (size_t)at : 0;
}

static enum aiReturn seek(struct aiFile *opened, size_t offset,
                          enum aiOrigin origin) {
  int from = origin == aiOrigin_SET   ? SEEK_SET
             : origin == aiOrigin_CUR ? SEEK_CUR
                                      : SEEK_END;
  return offset <= LONG_MAX && fseek(file_of(opened), (long)offset, from) == 0
             ? aiReturn_SUCCESS
             : aiReturn_FAILURE;
}

static size_t file_size(struct aiFile *opened) {
  long at = ftell(file_of(opened)), size = 0;
  if (at >= 0 && fseek(file_of(opened), 0, SEEK_END) == 0) {
    size = ftell(file_of(opened));
    (void)fseek(file_of(opened), at, SEEK_SET);
  }
  return size > 0 ? (size_t)size : 0;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path,
                                const char *mode) {
  struct opened_files *files = (struct opened_files *)io->UserData;
  (void)mode;
  FILE *file = fopen(path, "rb");
  if (file == NULL)
    return NULL;
  struct file_identity it;
  struct aiFile *opened = mem_alloc(1, sizeof *opened);
  bool is_known =
      opened != NULL && (!path_identity_of_descriptor(fileno(file), &it) ||
                         ARRAY_PUSH(&files->file, it));
  if (!is_known) {
    files->no_memory = true;
    mem_free(opened);
    fclose(file);
    return NULL;
  }
  *opened = (struct aiFile){.ReadProc = read_file,
                            .WriteProc = write_nothing,
                            .TellProc = tell,
                            .FileSizeProc = file_size,
                            .SeekProc = seek,
                            .FlushProc = flush_nothing,
                            .UserData = (aiUserData)file};
  return opened;
}

static void close_file(struct aiFileIO *io, struct aiFile *opened) {
  (void)io;
  fclose(file_of(opened));
  mem_free(opened);
}

void opened_files_init(struct opened_files *files) {
  *files = (struct opened_files){.io = {.OpenProc = open_file,
                                        .CloseProc = close_file,
                                        .UserData = (aiUserData)files}};
}
