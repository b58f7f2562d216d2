"""page.py - what the adapters share: a model in page coordinates, a drawing as
SVG in millimetres.

A model is prepared once (prepare.py): x and y are millimetres of the page from
its middle, x right and y up, z towards the viewer, seen along -z without
perspective.  An adapter reads that and writes polylines in the same x and y.
"""
import json
import sys

PAGE = 200  # millimetres a side


def read_obj(path):
    """The points and the faces, as indices from 0."""
    points, faces = [], []
    for line in open(path):
        word = line.split()
        if word and word[0] == "v":
            points.append(tuple(float(w) for w in word[1:4]))
        elif word and word[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in word[1:]])
    return points, faces


def write_svg(path, lines, matrix=None):
    """Polylines as strokes.  matrix: 3 x 4, from x y z to page millimetres; else
    they are x y of the page, from its middle."""
    with open(path, "w") as file:
        file.write(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{PAGE}mm" '
            f'height="{PAGE}mm" viewBox="0 0 {PAGE} {PAGE}" fill="none" '
            'stroke="#000" stroke-width="0.3">\n')
        for line in lines:
            pairs = [project(p, matrix) for p in line]
            text = " ".join(f"{x:.6f},{PAGE - y:.6f}" for x, y in pairs)
            file.write(f'<polyline points="{text}"/>\n')
        file.write("</svg>\n")


def project(point, matrix):
    if matrix is None:
        return point[0] + PAGE / 2, point[1] + PAGE / 2
    m, p = matrix, tuple(point) + (1.0,)
    row = [sum(m[4 * r + k] * p[k] for k in range(4)) for r in range(3)]
    return row[0] / row[2], row[1] / row[2]


def read_matrix(path):
    """From the statistics of recto: a model's points to page millimetres."""
    return json.load(open(path))["camera"]["model_to_page_mm"]


def read_shift(path):
    """What recto adds to x and y of a prepared model, less half a page."""
    m = read_matrix(path)
    return m[3] - PAGE / 2, m[7] - PAGE / 2


def fail(text):
    print(text, file=sys.stderr)
    sys.exit(1)
