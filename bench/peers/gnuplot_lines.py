"""gnuplot_lines.py SVG FRAME SHIFT-STATS OUT - gnuplot's strokes in millimetres,
by its drawing of the page's frame."""
import re
import sys

import page

source, frame_path, stats, out = sys.argv[1:]


def frame(lines):
    x = [p[0] for line in lines for p in line]
    y = [p[1] for line in lines for p in line]
    return min(x), min(y), max(x), max(y)


def strokes(path):
    lines, line = [], []
    text = open(path).read().partition("</defs>")[2]
    for d in re.findall(r"<path[^>]* d='([^']*)'", text, re.S):
        for verb, x, y in re.findall(r"([ML])\s*([-\d.]+),([-\d.]+)", d):
            if verb == "M":
                line = []
                lines.append(line)
            line.append((float(x), -float(y)))
    return [line for line in lines if len(line) > 1]


lines = strokes(source)
x0, y0, x1, y1 = frame(strokes(frame_path))
dx, dy = page.read_shift(stats)
page.write_svg(out, [[((x - x0) * page.PAGE / (x1 - x0) - page.PAGE / 2 + dx,
                       (y - y0) * page.PAGE / (y1 - y0) - page.PAGE / 2 + dy)
                      for x, y in line] for line in lines])
