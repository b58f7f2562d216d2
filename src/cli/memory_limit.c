/* memory_limit.c - keeps the program within the machine's memory.
 *
 * Of the limits that Linux has, RLIMIT_DATA counts what is allocated, some
 * percent more than what is in use; RLIMIT_AS counts libraries, mapped files
 * and reserved address space as well, and RLIMIT_RSS nothing. */
#include "cli/memory_limit.h"

#ifdef __linux__
#include <stdio.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>

/* Bytes, 0: not known. */
static rlim_t machine_memory(void) {
  struct sysinfo info;
  if (sysinfo(&info) != 0)
    return 0;
  rlim_t memory = (rlim_t)info.totalram * info.mem_unit;
  return memory - memory / 8 + (rlim_t)info.totalswap * info.mem_unit;
}

/* Bytes that count already: terabytes where a sanitizer has reserved its shadow
 * memory.  RLIM_INFINITY: not known. */
static rlim_t allocated(void) {
  FILE *file = fopen("/proc/self/statm", "re");
  unsigned long pages;
  if (file == NULL)
    return RLIM_INFINITY;
  int found = fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages);
  (void)fclose(file);
  return found == 1 ? (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE)
                    : RLIM_INFINITY;
}

void memory_limit_set(void) {
  struct rlimit limit;
  rlim_t most = machine_memory();
  if (most == 0 || getrlimit(RLIMIT_DATA, &limit) != 0 ||
      limit.rlim_cur != RLIM_INFINITY || allocated() > most / 2)
    return;
  limit.rlim_cur = most;
  (void)setrlimit(RLIMIT_DATA, &limit);
}
#else
void memory_limit_set(void) {}
#endif
