"""prepare.py MODEL STATS OUT - the model in page coordinates (page.py), by the
matrix of a drawing of it without perspective."""
import sys

import page

model, stats, out = sys.argv[1:]
m = page.read_matrix(stats)
x, y = m[0:4], m[4:8]
scale = sum(v * v for v in x[:3]) ** 0.5
# Towards the viewer, by the same scale.
z = [(x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3]) / scale
     for k in range(3)]
points, faces = page.read_obj(model)


def place(p):
    return (sum(x[k] * p[k] for k in range(3)) + x[3] - page.PAGE / 2,
            sum(y[k] * p[k] for k in range(3)) + y[3] - page.PAGE / 2,
            sum(z[k] * p[k] for k in range(3)))


placed = [place(p) for p in points]
depth = [p[2] for p in placed]
middle = (min(depth) + max(depth)) / 2
with open(out, "w") as file:
    for p in placed:
        file.write(f"v {p[0]:.9g} {p[1]:.9g} {p[2] - middle:.9g}\n")
    for face in faces:
        file.write("f " + " ".join(str(i + 1) for i in face) + "\n")
