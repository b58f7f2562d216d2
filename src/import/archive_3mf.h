/* archive_3mf.h - the model within the ZIP archive that a 3MF file is. */
#ifndef IMPORT_ARCHIVE_3MF_H
#define IMPORT_ARCHIVE_3MF_H

#include <stdbool.h>
#include <stddef.h>

/* Takes the next bytes; returns false where it needs no more. */
typedef bool archive_3mf_take(void *user, const char *bytes, size_t count);

/* Expands the part 3D/3dmodel.model of a 3MF file and passes it on block by
 * block, up to its end or to where it is damaged; nothing of what is no ZIP
 * archive with such a part. */
void archive_3mf_expand(const char *bytes, size_t count, archive_3mf_take *take,
                        void *user);

#endif
