/* heap.h - what the program's heap keeps. */
#ifndef CLI_HEAP_H
#define CLI_HEAP_H

/* Lets blocks of up to some megabytes stay in the heap when they are freed, and
 * this grow by large steps, of which large pages can be made (base/memory.c,
 * doc/decisions/0138).  The address space alone is taken at once.  Where the C
 * library knows no such thing, or the memory of this process is limited to less
 * than a gigabyte, nothing changes. */
void heap_keep_blocks(void);

#endif
