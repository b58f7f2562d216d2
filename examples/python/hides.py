"""Which face hides which edge, and where: a tower in front of a wall.

What is seen where an edge is hidden is the nearest of the faces that hide it."""

import numpy as np
import recto

BOX = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
       [1, 5, 7, 3]]


def box(low, high):
    """The eight corners of a box."""
    ends = np.array([low, high], float).T
    return [[x, y, z] for x in ends[0] for y in ends[1] for z in ends[2]]


def behind(part, fragment):
    """Where a part of an edge, from 0 to 1, lies behind a visible face: from
    each crossing of its line with the face's sides to the next but one."""
    start, way = part["from_mm"], part["to_mm"] - part["from_mm"]
    at = []
    for p in (fragment.exterior, *fragment.holes):
        q = np.roll(p, -1, axis=0)
        left_p, left_q = np.cross(way, p - start), np.cross(way, q - start)
        cut = (left_p > 0) != (left_q > 0)
        share = (left_p[cut] / (left_p - left_q)[cut])[:, None]
        point = p[cut] + share * (q - p)[cut]
        at.extend((point - start) @ way / (way @ way))
    at = np.clip(np.sort(at), 0, 1)
    return [(a, b) for a, b in zip(at[::2], at[1::2]) if b - a > 1e-6]


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
    for part in edge.intervals[edge.intervals["hidden_by"] > 0]:
        for fragment in drawing.fragments:
            for shares in behind(part, fragment):
                a, b = part["t0"] + np.array(shares) * (part["t1"] - part["t0"])
                print(
                    f"{drawing.groups[edge.group]} edge {edge.points} from {a:.3f} "
                    f"to {b:.3f}: hidden by {part['hidden_by']}, first by "
                    f"{names[fragment.face]} face {fragment.face}"
                )
