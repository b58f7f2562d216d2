/* gl2ps.c - a model through gl2ps and OSMesa, as SVG.
 *
 *   gl2ps MODEL OUT simple|bsp [culled]
 *
 * The model is in page coordinates (page.py).  Faces are white and a step
 * behind, their sides black; sorted by gl2ps, and what it finds wholly occluded
 * is left out on request. */
#include <GL/osmesa.h>
#include <gl2ps.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  pixels = 2000,
  half_mm = 100,
  faces_max = 1 << 21,
  corners_max = 1 << 23
};

static double (*point)[3];
static unsigned *corner, *first, points, faces, corners;

static void read_model(const char *path) {
  FILE *file = fopen(path, "r");
  char line[65536];
  if (file == NULL)
    exit(1);
  while (fgets(line, sizeof line, file) != NULL)
    if (line[0] == 'v') {
      sscanf(line + 1, "%lf %lf %lf", &point[points][0], &point[points][1],
             &point[points][2]);
      points++;
    } else if (line[0] == 'f') {
      first[faces++] = corners;
      for (char *word = strtok(line + 1, " \n"); word != NULL;
           word = strtok(NULL, " \n"))
        corner[corners++] = (unsigned)atoi(word) - 1;
    }
  first[faces] = corners;
  fclose(file);
}

static void draw_faces(void) {
  for (unsigned f = 0; f < faces; f++) {
    glBegin(GL_POLYGON);
    for (unsigned k = first[f]; k < first[f + 1]; k++)
      glVertex3dv(point[corner[k]]);
    glEnd();
  }
}

static int compare_sides(const void *a, const void *b) {
  const unsigned long long *x = a, *y = b;
  return *x < *y ? -1 : *x > *y;
}

/* Each side once, whoever shares it. */
static void draw_sides(void) {
  unsigned long long *side = calloc(corners, sizeof *side), last = ~0ull;
  for (unsigned f = 0; f < faces; f++)
    for (unsigned k = first[f]; k < first[f + 1]; k++) {
      unsigned long long a = corner[k];
      unsigned long long b = corner[k + 1 == first[f + 1] ? first[f] : k + 1];
      side[k] = a < b ? a << 32 | b : b << 32 | a;
    }
  qsort(side, corners, sizeof *side, compare_sides);
  glBegin(GL_LINES);
  for (unsigned k = 0; k < corners; last = side[k++])
    if (side[k] != last) {
      glVertex3dv(point[side[k] >> 32]);
      glVertex3dv(point[side[k] & 0xffffffff]);
    }
  glEnd();
  free(side);
}

static void draw(void) {
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 1);
  gl2psEnable(GL2PS_POLYGON_OFFSET_FILL);
  glColor3d(1, 1, 1);
  draw_faces();
  gl2psDisable(GL2PS_POLYGON_OFFSET_FILL);
  glColor3d(0, 0, 0);
  draw_sides();
}

int main(int argc, char **argv) {
  if (argc < 4)
    return 2;
  point = calloc(faces_max, sizeof *point);
  corner = calloc(corners_max, sizeof *corner);
  first = calloc(faces_max, sizeof *first);
  unsigned char *buffer = malloc(4u * pixels * pixels);
  read_model(argv[1]);
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 32, 0, 0, NULL);
  if (!OSMesaMakeCurrent(context, buffer, GL_UNSIGNED_BYTE, pixels, pixels))
    return 1;
  glViewport(0, 0, pixels, pixels);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(-half_mm, half_mm, -half_mm, half_mm, -10 * half_mm, 10 * half_mm);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  FILE *file = fopen(argv[2], "w");
  GLint viewport[4] = {0, 0, pixels, pixels};
  GLint sort = strcmp(argv[3], "bsp") == 0 ? GL2PS_BSP_SORT : GL2PS_SIMPLE_SORT;
  GLint options = GL2PS_BEST_ROOT | GL2PS_SILENT;
  if (argc > 4)
    options |= GL2PS_OCCLUSION_CULL;
  int state = GL2PS_OVERFLOW;
  for (int size = 1 << 24; state == GL2PS_OVERFLOW && size < 1 << 30;
       size *= 4) {
    rewind(file);
    gl2psBeginPage("", "", viewport, GL2PS_SVG, sort, options, GL_RGBA, 0, NULL,
                   0, 0, 0, size, file, argv[2]);
    draw();
    state = gl2psEndPage();
  }
  fclose(file);
  return state != GL2PS_SUCCESS;
}
