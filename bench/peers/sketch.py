"""sketch.py MODEL OUT - a model in page coordinates as input for sketch, which
sorts by Newell's algorithm and writes TikZ: white polygons with black sides."""
import sys

import page

model, out = sys.argv[1:]
points, faces = page.read_obj(model)
with open(out, "w") as file:
    for face in faces:
        corners = "".join("(%.6f,%.6f,%.6f)" % points[i] for i in face)
        file.write(f"polygon[cull=false]{corners}\n")
    file.write("global { language tikz }\n")
