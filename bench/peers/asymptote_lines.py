"""asymptote_lines.py EPS SHIFT-STATS OUT - the strokes of Asymptote's drawing in
millimetres, each clipped by the paths that clip it there; a stroke along the
border of such a path is there, by half of its width.  What later pieces paint over
is there, as a pen cannot overpaint."""
import sys

import page

NEAR = 0.01  # points: what is so near a border is on it
MM = 25.4 / 72


def intersections(p, q, clip):
    """Where the segment meets the sides of a clipping path, from 0 to 1."""
    found = []
    dx, dy = q[0] - p[0], q[1] - p[1]
    for loop in clip:
        for a, b in zip(loop, loop[1:] + loop[:1]):
            ex, ey = b[0] - a[0], b[1] - a[1]
            det = dx * ey - dy * ex
            if abs(det) < 1e-12:  # along it: its ends
                length = dx * dx + dy * dy
                for c in (a, b):
                    found.append(((c[0] - p[0]) * dx + (c[1] - p[1]) * dy) /
                                 length)
                continue
            s = ((a[0] - p[0]) * dy - (a[1] - p[1]) * dx) / det
            if -1e-9 <= s <= 1 + 1e-9:
                found.append(((a[0] - p[0]) * ey - (a[1] - p[1]) * ex) / det)
    return found


def is_within(at, clip):
    winding = 0
    for loop in clip:
        for a, b in zip(loop, loop[1:] + loop[:1]):
            ex, ey = b[0] - a[0], b[1] - a[1]
            ax, ay = at[0] - a[0], at[1] - a[1]
            length = ex * ex + ey * ey
            t = min(max((ax * ex + ay * ey) / length, 0), 1) if length else 0
            if (ax - t * ex) ** 2 + (ay - t * ey) ** 2 < NEAR * NEAR:
                return True
            if (a[1] <= at[1]) != (b[1] <= at[1]):
                side = ex * ay - ey * ax
                if (b[1] > a[1]) == (side > 0):
                    winding += 1 if b[1] > a[1] else -1
    return winding != 0


def clipped(p, q, clips):
    """The parts of a segment within all of the paths."""
    parts = [(0.0, 1.0)]
    for clip in clips:
        at = sorted(intersections(p, q, clip))
        kept = []
        for low, high in parts:
            ends = [low] + [t for t in at if low < t < high] + [high]
            for a, b in zip(ends, ends[1:]):
                t = (a + b) / 2
                if b - a > 1e-9 and is_within(
                        (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])),
                        clip):
                    if kept and kept[-1][1] == a:
                        kept[-1] = (kept[-1][0], b)
                    else:
                        kept.append((a, b))
        parts = kept
    return parts


def strokes(path):
    """Pairs of points, in millimetres from the middle of the page."""
    saved, clips, loops = [], [], []
    for line in open(path):
        word = line.split()
        verb = word[-1] if word else ""
        if verb == "moveto":
            if word[0] == "newpath":
                loops = []
            loops.append([(float(word[-3]), float(word[-2]))])
        elif verb == "lineto":
            loops[-1].append((float(word[0]), float(word[1])))
        elif verb == "closepath" and loops[-1][0] != loops[-1][-1]:
            loops[-1].append(loops[-1][0])
        elif verb == "gsave":
            saved.append(clips)
        elif verb == "grestore":
            clips = saved.pop()
        elif verb in ("clip", "eoclip"):
            clips = clips + [loops]
        elif verb == "stroke":
            for loop in loops:
                for p, q in zip(loop, loop[1:]):
                    if p == q:
                        continue
                    for a, b in clipped(p, q, clips):
                        yield [tuple(MM * (p[k] + t * (q[k] - p[k]))
                                     for k in (0, 1)) for t in (a, b)]


if __name__ == "__main__":
    source, stats, out = sys.argv[1:]
    dx, dy = page.read_shift(stats)
    page.write_svg(out, [[(x + dx, y + dy) for x, y in line]
                         for line in strokes(source)])
