"""A surface in numpy arrays, drawn from all around.

python3 turntable.py NAME COUNT writes NAME000.svg and so on."""

import sys

import numpy as np
import recto


def trefoil(along=240, around=24, radius=0.6):
    """A tube around a trefoil knot: its vertices and its quads."""
    t = np.linspace(0, 2 * np.pi, along, endpoint=False)[:, None]
    centre = np.hstack(
        [
            np.sin(t) + 2 * np.sin(2 * t),
            np.cos(t) - 2 * np.cos(2 * t),
            -np.sin(3 * t),
        ]
    )
    ahead = np.roll(centre, -1, 0) - np.roll(centre, 1, 0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    side = np.cross(ahead, [0, 0, 1])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, ahead)
    angle = np.linspace(0, 2 * np.pi, around, endpoint=False)[None, :, None]
    ring = np.cos(angle) * side[:, None] + np.sin(angle) * up[:, None]
    vertices = (centre[:, None] + radius * ring).reshape(-1, 3)

    at = np.arange(along * around).reshape(along, around)
    on, beside = np.roll(at, -1, 0), np.roll(at, -1, 1)
    both = np.roll(on, -1, 1)
    return vertices, np.stack([at, on, both, beside], -1).reshape(-1, 4)


def main(name, count):
    scene = recto.Scene(*trefoil())
    scene.prepare()
    for i in range(count):
        # The sphere about the scene fills the page: one scale for all.
        drawing = scene.render(
            azimuth=360 * i / count,
            elevation=40,
            fit="sphere",
            page=(120, 120),
            contours="smooth",  # of the tube that the mesh samples
        )
        drawing.write(f"{name}{i:03d}.svg")


if len(sys.argv) != 3:
    sys.exit(__doc__)
main(sys.argv[1], int(sys.argv[2]))
