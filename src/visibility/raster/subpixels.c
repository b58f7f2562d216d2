/* subpixels.c - supersampling: K lines of sub-pixels become a line of pixels.
 */
#include "visibility/raster/subpixels.h"

#include <string.h>

recto_status subpixels_lines(const struct solver_request *request, int *lines,
                             recto_error *error) {
  int k = subpixels_of(request);
  int lines_requested =
      request->resolution == 0 ? RASTER_LINES_DEFAULT : request->resolution;
  if (k < 1 || k > SUBPIXELS_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "%d sub-pixels are not within 1 to %d", k, SUBPIXELS_MAX);
  *lines = lines_requested > RASTER_LINES_MAX ? lines_requested
                                              : lines_requested * k;
  return RECTO_OK;
}

/* The facet that most sub-pixels see, of equals the one of lower index. */
static uint32_t find_most_frequent(const uint32_t *seen, uint32_t all) {
  uint32_t best = 0, most = 0;
  for (uint32_t i = 0; i < all; i++) {
    uint32_t same = 0;
    if (seen[i] == best || seen[i] == 0)
      continue;
    for (uint32_t j = 0; j < all; j++)
      same += seen[j] == seen[i];
    if (same > most || (same == most && seen[i] < best)) {
      most = same;
      best = seen[i];
    }
  }
  return best;
}

uint32_t subpixels_resolve(const uint32_t *seen, uint32_t all,
                           uint32_t *covered) {
  *covered = 0;
  for (uint32_t i = 0; i < all; i++)
    *covered += seen[i] != 0;
  return 2 * *covered >= all ? find_most_frequent(seen, all) : 0;
}

bool subpixels_init(struct subpixels *subpixels, int k, int32_t fine_columns,
                    int32_t columns) {
  memset(subpixels, 0, sizeof *subpixels);
  subpixels->k = k;
  subpixels->fine_columns = fine_columns;
  subpixels->columns = columns;
  subpixels->seen =
      mem_alloc((size_t)k * (size_t)fine_columns, sizeof *subpixels->seen);
  subpixels->pixel = mem_alloc((size_t)columns, sizeof *subpixels->pixel);
  if (subpixels->seen != NULL && subpixels->pixel != NULL)
    return true;
  subpixels_fini(subpixels);
  return false;
}

void subpixels_fini(struct subpixels *subpixels) {
  mem_free(subpixels->seen);
  mem_free(subpixels->pixel);
  memset(subpixels, 0, sizeof *subpixels);
}

/* Resolves all pixels of the line.  The last pixel may extend beyond the
 * sub-pixels of the page, which are background there. */
static void resolve_line(struct subpixels *subpixels) {
  int32_t k = subpixels->k;
  for (int32_t column = 0; column < subpixels->columns; column++) {
    uint32_t seen[SUBPIXELS_MAX * SUBPIXELS_MAX], all = 0, covered;
    for (int32_t y = 0; y < k; y++)
      for (int32_t x = column * k; x < (column + 1) * k; x++)
        seen[all++] =
            x < subpixels->fine_columns
                ? subpixels->seen[(size_t)y * (size_t)subpixels->fine_columns +
                                  (size_t)x]
                : 0;
    subpixels->pixel[column] = subpixels_resolve(seen, all, &covered);
    subpixels->covered += covered;
  }
}

bool subpixels_add_line(struct subpixels *subpixels, int32_t fine_line,
                        const uint32_t *seen) {
  size_t columns = (size_t)subpixels->fine_columns;
  int32_t at = fine_line % subpixels->k;
  memcpy(subpixels->seen + (size_t)at * columns, seen, columns * sizeof *seen);
  if (at > 0)
    return false;
  resolve_line(subpixels);
  return true;
}
