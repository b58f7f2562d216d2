/* memory_limit.h - keeps the program within the machine's memory. */
#ifndef CLI_MEMORY_LIMIT_H
#define CLI_MEMORY_LIMIT_H

/* Limits what this process may allocate to seven eighths of the machine's
 * memory and all of its swap space, unless a limit is set already (ulimit -d).
 * What needs more then fails with a message.  Without a limit the system grants
 * any allocation, and ends one process or another once the memory is used. */
void memory_limit_set(void);

#endif
