"""sketch_lines.py TIKZ SHIFT-STATS OUT - the sides of the polygons that sketch
painted, in millimetres; what later ones paint over is there, as a pen cannot
overpaint."""
import re
import sys

import page

source, stats, out = sys.argv[1:]
dx, dy = page.read_shift(stats)
lines = []
for line in open(source):
    if "cycle" not in line:
        continue
    xy = [(float(x) + dx, float(y) + dy)
          for x, y in re.findall(r"\(([-\d.e]+),([-\d.e]+)\)", line)]
    lines.append(xy + xy[:1])
page.write_svg(out, lines)
