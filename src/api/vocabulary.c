/* vocabulary.c - the words that stand for the public enumerators, for
 * directions and for paper sizes. */
#include "recto.h"

const char *recto_method_name(recto_method method) {
  static const char *const name[RECTO_METHOD_COUNT] = {
      [RECTO_METHOD_AUTO] = "auto",
      [RECTO_METHOD_NEWELL] = "newell",
      [RECTO_METHOD_WATKINS] = "watkins",
      [RECTO_METHOD_WARNOCK] = "warnock",
      [RECTO_METHOD_TILES] = "tiles",
      [RECTO_METHOD_ZBUFFER] = "zbuffer",
      [RECTO_METHOD_SCANLINE_ZBUFFER] = "scanline-zbuffer",
      [RECTO_METHOD_PAINTER] = "painter",
      [RECTO_METHOD_PAINTER_GIVEN] = "painter-given",
      [RECTO_METHOD_BRUTE] = "brute",
  };
  return (unsigned)method < RECTO_METHOD_COUNT ? name[method] : "unknown";
}

const char *recto_edge_class_name(recto_edge_class edge_class) {
  switch (edge_class) {
  case RECTO_EDGE_SILHOUETTE:
    return "silhouette";
  case RECTO_EDGE_BORDER:
    return "border";
  case RECTO_EDGE_CREASE:
    return "crease";
  case RECTO_EDGE_GROUP:
    return "group";
  case RECTO_EDGE_INTERSECTION:
    return "intersection";
  case RECTO_EDGE_WIRE:
    return "wire";
  case RECTO_EDGE_SMOOTH:
    return "smooth";
  case RECTO_EDGE_SECTION:
    return "section";
  }
  return "unknown";
}

/* A word for two numbers. */
struct named_pair {
  const char *name;
  double first, second;
};

static const char *give_pair(const struct named_pair *pair, double *first,
                             double *second) {
  if (first != NULL)
    *first = pair->first;
  if (second != NULL)
    *second = pair->second;
  return pair->name;
}

/* Dimetric: the axes to the right and up are drawn at one scale, the third at
 * half of it, so that sin^2 elevation = 1/9 and sin^2 azimuth = 1/8. */
const char *recto_view_name(size_t index, double *azimuth_deg,
                            double *elevation_deg) {
  static const struct named_pair view[] = {
      {"iso", 45, 35.264389682754654}, /* tan = 1 / sqrt(2) */
      {"front", 0, 0},
      {"back", 180, 0},
      {"left", -90, 0},
      {"right", 90, 0},
      {"top", 0, 90},
      {"bottom", 0, -90},
      {"dimetric", 20.704811054635428, 19.471220634490691},
      {"trimetric", 30, 25},
  };
  return index < sizeof view / sizeof view[0]
             ? give_pair(&view[index], azimuth_deg, elevation_deg)
             : NULL;
}

const char *recto_page_name(size_t index, double *width_mm, double *height_mm) {
  static const struct named_pair page[] = {
      {"A0", 841, 1189}, {"A1", 594, 841},         {"A2", 420, 594},
      {"A3", 297, 420},  {"A4", 210, 297},         {"A5", 148, 210},
      {"A6", 105, 148},  {"letter", 215.9, 279.4}, {"legal", 215.9, 355.6},
  };
  return index < sizeof page / sizeof page[0]
             ? give_pair(&page[index], width_mm, height_mm)
             : NULL;
}
