"""gnuplot.py MODEL DATA SCRIPT SVG FRAME - a model in page coordinates as a program for
gnuplot: every quadrilateral is a grid of its own, of two by two points, and so
is every triangle, with two of them at one place; set hidden3d, seen from above, 4000 units a side.  FRAME gets a drawing of the page's frame alone, as
gnuplot does not tell its scale."""
import sys

import page

model, data, script, svg, frame = sys.argv[1:]
points, faces = page.read_obj(model)
with open(data, "w") as file:
    for face in faces:
        parts = [face] if len(face) == 4 else [
            [face[0], face[k], face[k + 1]] for k in range(1, len(face) - 1)]
        for part in parts:
            a, b, c, d = (points[i] for i in (part + part[-1:])[:4])
            row = "%.6f %.6f %.6f\n"
            file.write(row % a + row % b + "\n" + row % d + row % c + "\n\n")
with open(data + ".frame", "w") as file:
    file.write("-100 -100 0\n100 -100 0\n\n-100 100 0\n100 100 0\n")
with open(script, "w") as file:
    file.write(f"""set terminal svg size 4000,4000 font "sans,8"
set output "{frame}"
set hidden3d nooffset
unset border
unset tics
unset key
set lmargin at screen 0.05
set rmargin at screen 0.95
set tmargin at screen 0.95
set bmargin at screen 0.05
set xrange [-100:100]
set yrange [-100:100]
set zrange [-300:300]
set view equal xyz
set view 0,0
splot "{data}.frame" with lines lc "black"
set output "{svg}"
splot "{data}" with lines lc "black"
""")
