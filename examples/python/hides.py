"""Which face hides which edge: a tower in front of a wall.

What is seen in the middle of a hidden part of an edge is the nearest of the
faces that hide it."""

import numpy as np
import recto

BOX = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
       [1, 5, 7, 3]]


def box(low, high):
    """The eight corners of a box."""
    ends = np.array([low, high], float).T
    return [[x, y, z] for x in ends[0] for y in ends[1] for z in ends[2]]


def crossings(ring, point):
    """How many sides of a ring a ray from the point to the right crosses."""
    a, b = ring, np.roll(ring, -1, axis=0)
    astride = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    a, b = a[astride], b[astride]
    x = a[:, 0] + (point[1] - a[:, 1]) * (b - a)[:, 0] / (b - a)[:, 1]
    return int((x > point[0]).sum())


def find_face(fragments, point):
    """The face that is seen at a point of the page; None: no face."""
    for fragment in fragments:
        rings = (fragment.exterior, *fragment.holes)
        if sum(crossings(ring, point) for ring in rings) % 2 == 1:
            return fragment.face
    return None


scene = recto.Scene()
names = []
for name, low, high in (
    ("wall", (0, 0, 0), (8, 3, 1)),
    ("tower", (3, 0, 2), (5, 6, 4)),
):
    scene.add_mesh(box(low, high), BOX, [name] * 6)
    names += [name] * 6
drawing = scene.render(azimuth=20, elevation=15, results="all")
for edge in drawing.edges:
    for part in edge.intervals:
        if part["hidden_by"] > 0:
            middle = (part["from_mm"] + part["to_mm"]) / 2
            face = find_face(drawing.fragments, middle)
            print(
                f"{drawing.groups[edge.group]} edge {edge.points} from "
                f"{part['t0']:.3f} to {part['t1']:.3f}: hidden by "
                f"{part['hidden_by']}, first by {names[face]} face {face}"
            )
