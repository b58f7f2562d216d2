"""The visible faces of a model as GeoJSON and as WKT, in mm of the page.

python3 faces.py MODEL GEOJSON WKT"""

import json
import sys

import recto


def close(ring):
    """A ring as both formats have it: the first point is repeated."""
    return [*ring.tolist(), ring[0].tolist()]


def wkt(rings):
    texts = [", ".join(f"{x:.4f} {y:.4f}" for x, y in ring) for ring in rings]
    return "POLYGON (" + ", ".join(f"({text})" for text in texts) + ")"


def main(model, geojson_path, wkt_path):
    drawing = recto.Scene.read(model).render(results="faces")
    features, lines = [], []
    for fragment in drawing.fragments:
        rings = [close(r) for r in (fragment.exterior, *fragment.holes)]
        properties = {
            "face": fragment.face,
            "group": drawing.groups[fragment.group],
            "colour": fragment.colour,
            "brightness": round(fragment.brightness, 4),
            "neighbours": fragment.neighbours,
        }
        geometry = {"type": "Polygon", "coordinates": rings}
        features.append(
            {"type": "Feature", "properties": properties, "geometry": geometry}
        )
        lines.append(wkt(rings))
    with open(geojson_path, "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "features": features}, file)
    with open(wkt_path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if len(sys.argv) != 4:
    sys.exit(__doc__)
main(*sys.argv[1:])
