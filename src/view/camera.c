/* camera.c - the camera as a matrix. */
#include "view/camera.h"

#include <string.h>

#include "geom/vector.h"

void camera_matrix(const struct camera *camera, double matrix[12]) {
  const double *axis[2] = {camera->right, camera->up};
  double depth[4] = {0, 0, 0, 1};
  if (camera->perspective) {
    for (int k = 0; k < 3; k++)
      depth[k] = -camera->back[k] + 0.0;
    depth[3] = vector_dot(camera->back, camera->eye);
  }
  for (int row = 0; row < 2; row++) {
    double *to = matrix + 4 * row;
    for (int k = 0; k < 3; k++)
      to[k] = camera->s * axis[row][k] + camera->middle_mm[row] * depth[k];
    to[3] = -camera->s * vector_dot(axis[row], camera->eye) +
            camera->middle_mm[row] * depth[3];
  }
  memcpy(matrix + 8, depth, sizeof depth);
}
