"""gl2ps_lines.py SVG SHIFT-STATS OUT - the strokes of gl2ps's drawing, in
millimetres; fills are left out, as a pen cannot overpaint."""
import re
import sys

import page

source, stats, out = sys.argv[1:]
dx, dy = page.read_shift(stats)
scale = page.PAGE / 2000
lines = []
for points in re.findall(r'<polyline[^>]*points="([^"]*)"', open(source).read()):
    xy = [tuple(map(float, p.split(","))) for p in points.split()]
    lines.append([(x * scale - page.PAGE / 2 + dx,
                   page.PAGE / 2 - y * scale + dy) for x, y in xy])
page.write_svg(out, lines)
