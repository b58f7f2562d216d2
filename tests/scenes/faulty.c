/* faulty.c - OBJ files with one bad element each, which must not spoil the
 * rest. */
#include "scene/diagnostics.h"
#include "tests/scenes/scenes.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"

const struct scenes_faulty scenes_faulty_list[] = {
    {"sound", SQUARE, SCENE_FAULT_COUNT, 0, 1},
    {"nan", SQUARE "v nan 0 1\nv 1 0 1\nv 1 1 1\nf 5 6 7\nf 1 2 7\n",
     SCENE_FAULT_NOT_FINITE, 6, 2},
    {"infinity", SQUARE "v 0 inf 1\nv 1 0 1\nv 1 1 1\nf 5 6 7\nf 1 2 7\n",
     SCENE_FAULT_NOT_FINITE, 6, 2},
    {"minus infinity", SQUARE "v 0 0 -Inf\nf 1 2 5\nf 2 3 4\n",
     SCENE_FAULT_NOT_FINITE, 6, 2},
    {"overflow", SQUARE "v 1e999 0 0\nf 1 2 5\n", SCENE_FAULT_NOT_FINITE, 6, 1},
    {"index too large", SQUARE "f 1 2 99\nf 1 3 4\n", SCENE_FAULT_INDEX, 6, 2},
    {"index zero", SQUARE "f 0 1 2\nf 1 3 4\n", SCENE_FAULT_INDEX, 6, 2},
    {"index too far back", SQUARE "f -9 -1 -2\nf -4 -2 -1\n", SCENE_FAULT_INDEX,
     6, 2},
    {"index beyond 64 bits", SQUARE "f 1 2 99999999999999999999\nf 1 3 4\n",
     SCENE_FAULT_COUNT, 6, 2},
    {"two corners", SQUARE "f 1 2\nf 1 3 4\n", SCENE_FAULT_FEW_CORNERS, 6, 2},
    {"the same corner thrice", SQUARE "f 2 2 2\nf 1 3 4\n",
     SCENE_FAULT_FEW_CORNERS, 6, 2},
    {"corners on one line", SQUARE "v 2 0 0\nf 1 2 5\nf 1 3 4\n",
     SCENE_FAULT_ZERO_AREA, 7, 2},
    {"bow-tie", SQUARE "v 0 0 1\nv 1 1 1\nv 1 0 1\nv 0 1 1\nf 5 6 7 8\n",
     SCENE_FAULT_BOW_TIE, 10, 2},
    {"warped quad", SQUARE "v 0 0 1\nv 1 0 2\nv 1 1 1\nv 0 1 2\nf 5 6 7 8\n",
     SCENE_FAULT_WARPED, 10, 2},
    {"empty groups", "g\ng nothing\no\n" SQUARE "g last\nusemtl none\n",
     SCENE_FAULT_COUNT, 0, 1},
    {"not a number", SQUARE "v x 0 0\nf 1 2 5\nf 1 3 4\n", SCENE_FAULT_SYNTAX,
     6, 2},
    {"no corners", SQUARE "f\nf 1 3 4\n", SCENE_FAULT_COUNT, 6, 2},
    {"unknown words", "mtllib a.mtl\nvt 0 0\nvn 0 0 1\ns off\nxyzzy 1\n" SQUARE,
     SCENE_FAULT_COUNT, 0, 1},
    {NULL, NULL, SCENE_FAULT_COUNT, 0, 0},
};
