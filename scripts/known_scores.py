#!/usr/bin/env python3
"""known_scores.py: what graspabilities known objects have, at the constants of every preset.

Makes 200 objects of each prior set and of each adversarial network that ship (seed 1) and four everyday solids, scores
them on 1000 grasps each (seed 1) and writes quality/known_scores.inc, which `antigrasp evaluate` sets scores beside, and
the table in docs/metric.md. Seven minutes of processor time; needs a build with the networks.
"""
import argparse
import csv
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PRESETS = ("default", "settled", "dexnet", "egad")
KINDS = ("cylinders", "prisms", "bottles")
COUNT, GRASPS = 200, 1000
MARKS = ("<!-- begin known scores -->\n", "<!-- end known scores -->\n")


def ring(radius, z, sides):
    return [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), z)
            for i in range(sides)]


def lathe(profile, sides):
    """The closed surface about the z axis of a profile (radius, z) that begins and ends on the axis."""
    rings = [[(0.0, 0.0, z)] if radius == 0 else ring(radius, z, sides) for radius, z in profile]
    return tube(rings)


def tube(rings):
    """Faces between successive closed rings, outward where these turn to the left as seen from the end."""
    faces = []
    for low, high in zip(rings, rings[1:]):
        for i in range(max(len(low), len(high))):
            a, b = low[i % len(low)], low[(i + 1) % len(low)]
            c, d = high[i % len(high)], high[(i + 1) % len(high)]
            faces += [face for face in ((a, b, d), (a, d, c)) if len(set(face)) == 3]
    return faces


def handle(inner, reach, thickness, middle, sides=24, steps=32):
    """A half ring in the plane y = 0 that ends inside the wall at x = inner."""
    rings = []
    for k in range(steps + 1):
        angle = math.pi * (k / steps - 0.5)
        centre, out = (inner + reach * math.cos(angle), middle + reach * math.sin(angle)), (math.cos(angle), math.sin(angle))
        rings.append([(centre[0] + x * out[0], y, centre[1] + x * out[1]) for x, y, _ in ring(thickness, 0, sides)])
    first, last = ([tuple(statistics.fmean(p[i] for p in one) for i in range(3))] for one in (rings[0], rings[-1]))
    return tube([first, *rings, last])


def solids():
    """A sphere, a cube, a cylinder twice as high as wide, and a mug with walls of 4 mm; in millimetres."""
    around = [math.pi * k / 64 for k in range(65)]
    sphere = [(0 if k in (0, 64) else 20 * math.sin(a), -20 * math.cos(a)) for k, a in enumerate(around)]
    square = [(x, y) for x, y in ((20, -20), (20, 20), (-20, 20), (-20, -20))]
    cube = tube([[(0, 0, -20)], [(x, y, -20) for x, y in square], [(x, y, 20) for x, y in square], [(0, 0, 20)]])
    mug = lathe([(0, 0), (40, 0), (40, 95), (36, 95), (36, 5), (0, 5)], 96) + handle(38, 26, 6, 48)
    return {"sphere": lathe(sphere, 128), "cube": cube,
            "cylinder": lathe([(0, -40), (20, -40), (20, 40), (0, 40)], 128), "mug": mug}


def write_obj(path, faces):
    """With every vertex once, so that edges close."""
    places = {}
    for face in faces:
        for vertex in face:
            places.setdefault(tuple(round(x, 9) for x in vertex), len(places) + 1)
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in places]
    lines += ["f " + " ".join(str(places[tuple(round(x, 9) for x in vertex)]) for vertex in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--antigrasp", default=os.environ.get("ANTIGRASP_BINARY", ROOT / "build/release/bin/antigrasp"))
    binary = parser.parse_args().antigrasp

    def call(*arguments):
        subprocess.run([binary, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def scores(preset, objects, folder):
        """(graspability, ends of its interval) by name; objects that are no solids are left out."""
        call("evaluate", objects, "--preset", preset, "--num-grasps", GRASPS, "--max-attempts", 40 * GRASPS, "--out",
             folder / "scores.csv")
        with open(folder / "scores.csv", encoding="utf-8") as file:
            return {row["object"]: [float(row[name]) for name in ("graspability", "ci_low", "ci_high")]
                    for row in csv.DictReader(file) if row["graspability"]}

    entries, table = [], ["| preset | " + " | ".join(solids()) + " | " + " | ".join(
        f"{kind}{end}" for kind in KINDS for end in ("", "-adversarial")) + " |", "| --- |" + 10 * " --- |"]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "solids").mkdir()
        for name, faces in solids().items():
            write_obj(folder / "solids" / f"{name}.obj", faces)
        for kind in KINDS:
            call("dataset", "make", kind, "--count", COUNT, "--seed", 1, "--out", folder / f"{kind}.h5")
            call("sample", f"{kind}-adversarial", "--count", COUNT, "--seed", 1, "--out",
                 folder / f"{kind}-adversarial.h5")
        for preset in PRESETS:
            own = scores(preset, folder / "solids", folder)
            factor, digits = (100, 1) if preset == "settled" else (1000, 3)

            def text(*numbers):
                return [f"{factor * x:.{digits}f}" for x in numbers]

            cells = ["{} ({}-{})".format(*text(*own[f"{name}.obj"])) for name in solids()]
            for name in (f"{kind}{end}" for kind in KINDS for end in ("", "-adversarial")):
                values = sorted(score for score, _, _ in scores(preset, folder / f"{name}.h5", folder).values())
                cells.append(" / ".join(text(*statistics.quantiles(values, n=4))))
                entries.append(f'{{"{preset}", "{name}",\n {{' + ", ".join(f"{value:.4g}" for value in values) + "}},\n")
            table.append(f"| {preset}{', percent' if preset == 'settled' else ''} | " + " | ".join(cells) + " |")
    (ROOT / "quality/known_scores.inc").write_text("// Written by scripts/known_scores.py.\n" + "".join(entries))
    document = ROOT / "docs/metric.md"
    text = document.read_text()
    begin, end = text.index(MARKS[0]) + len(MARKS[0]), text.index(MARKS[1])
    document.write_text(text[:begin] + "\n".join(table) + "\n" + text[end:])


if __name__ == "__main__":
    sys.exit(main())
