"""asymptote.py MODEL OUT - a model in page coordinates as a program for
Asymptote's module bsp, which divides faces by a binary space partition, clips
each piece to its part of it and paints them from back to front: triangles, as it
takes a polygon for linear whose corners are not in one plane to the last bits."""
import sys

import page

model, out = sys.argv[1:]
points, faces = page.read_obj(model)
with open(out, "w") as file:
    file.write("import bsp;\nunitsize(1mm);\n"
               "currentprojection=orthographic(0,0,1000,up=Y);\n"
               "face[] faces;\n")
    for face in faces:
        for k in range(1, len(face) - 1):
            path = "--".join("(%.6f,%.6f,%.6f)" % points[i]
                             for i in (face[0], face[k], face[k + 1]))
            file.write(
                f"{{ path3 p={path}--cycle; "
                "filldraw(faces.push(p),project(p),white,black+0.1mm); }\n")
    file.write("add(faces);\n")
