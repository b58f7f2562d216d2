/* vocabulary.c - the words that stand for the public enumerators. */
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
  }
  return "unknown";
}
