"""three_lines.py TEXT STATS OUT - lines of x y z in millimetres, by the matrix
of a drawing of the same view."""
import sys

import page

source, stats, out = sys.argv[1:]
lines = []
for line in open(source):
    v = [float(w) for w in line.split()]
    lines.append([v[i:i + 3] for i in range(0, len(v), 3)])
page.write_svg(out, lines, page.read_matrix(stats))
