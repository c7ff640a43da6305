"""The paper's Table I in physics, and success over friction: runs and tables of docs/trials.md. Called by scripts/reproduce."""
import argparse
import csv
import pathlib

from reproduce_document import call, commit, made, write_section

DOCUMENT = pathlib.Path("docs/trials.md")
# Predicted and actual of Table I, percent.
PAPER = {
    "cube-0": (100, 100.0), "cube-10": (100, 80.0), "cube-15": (100, 13.3), "cube-26": (0, 0.0),
    "cuboctahedron-0": (100, 100.0), "cuboctahedron-10": (100, 60.0), "cuboctahedron-15": (100, 13.3), "cuboctahedron-26": (0, 0.0),
    "cylinders-000000": (0, 13.3), "cylinders-000001": (0, 6.7),
}
NOISE = {
    "default": (),
    "calibrated": ("--friction-std", 0.02, "--object-translation-std", 0.0005, "--grasp-translation-std", 0.00025),
}
FRICTIONS = (0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6)


def once(target, *arguments):
    if not made(target):
        target.parent.mkdir(parents=True, exist_ok=True)
        call(*arguments)
        print("antigrasp", *arguments[:3], "...", flush=True)


def solids(out):
    for name in PAPER:
        kind, phi = name.rsplit("-", 1)
        if kind != "cylinders":
            once(out / "solids" / f"{name}.stl", "shape", kind, "--phi", phi, "--size-mm", 30, "--out", out / "solids" / f"{name}.stl")
    grids = out / "cylinders.h5"
    once(grids, "sample", "cylinders-adversarial", "--count", 2, "--seed", 1, "--out", grids)
    return grids


def rows(folder):
    with open(folder / "trials.csv", newline="") as file:
        return list(csv.DictReader(file))


def share(row, name="held"):
    if row is None or not row[name]:
        return "-"
    text = f"{100 * float(row[name]):.0f}"
    return f"{text} ({100 * float(row[name + '_low']):.0f} to {100 * float(row[name + '_high']):.0f})" if name + "_low" in row else text


def table_one(out, series):
    grids = solids(out)
    found = {}
    for noise, flags in NOISE.items():
        for reading in ("full-cone", "half-angle"):
            common = ("--protocol", "paper", "--friction-angle", 17, "--reading", reading, "--series", series, "--replays", 0, *flags)
            for part, inputs in (("solids", (out / "solids", "--mm")), ("cylinders", (grids,))):
                folder = out / f"{part}-{noise}-{reading}"
                once(folder / "trials.csv", "trial", *inputs, *common, "--out", folder)
                for row in rows(folder):
                    found[(pathlib.Path(row["object"]).stem.replace(".stl", ""), noise, reading)] = row
    columns = [(noise, reading) for noise in NOISE for reading in ("full-cone", "half-angle")]
    lines = ["| object | paper: predicted | actual | " + " | ".join(f"{noise} noise, {reading}" for noise, reading in columns) + " |",
             "| --- | --- | --- |" + " --- |" * len(columns)]
    for name, (predicted, actual) in PAPER.items():
        place = {"cylinders-000000": "adversarial cylinders 1", "cylinders-000001": "adversarial cylinders 2"}.get(name, name.replace("-", ", "))
        cells = []
        for column in columns:
            row = next((row for (stem, *rest), row in found.items() if tuple(rest) == column and (stem == name or stem.endswith(name[-6:]) and "cylinders" in name)), None)
            cells.append(share(row))
        lines.append(f"| {place} | {predicted} | {actual} | " + " | ".join(cells) + " |")
    return lines


def over_friction(out):
    table = {}
    for friction in FRICTIONS:
        folder = out / f"friction-{friction}"
        once(folder / "trials.csv", "trial", out / "solids", "--mm", "--friction", friction, "--num-grasps", 50, "--replays", 0, "--out", folder)
        for row in rows(folder):
            table[(pathlib.Path(row["object"]).stem, friction)] = row
    names = sorted({name for name, _ in table}, key=lambda name: (name.rsplit("-", 1)[0], int(name.rsplit("-", 1)[1])))
    lines = ["| object | " + " | ".join(map(str, FRICTIONS)) + " |", "| --- |" + " --- |" * len(FRICTIONS)]
    for name in names:
        cells = []
        for friction in FRICTIONS:
            row = table[(name, friction)]
            kept = 100 * int(row["grasps"]) / max(int(row["candidates"]), 1)
            cells.append(f"{100 * float(row['held']):.0f} ({kept:.1f})" if row["status"] == "ok" else "no grasp")
        lines.append(f"| {name.replace('-', ', ')} | " + " | ".join(cells) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--series", type=int, default=100)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/trial"))
    arguments = parser.parse_args()
    first = table_one(arguments.out, arguments.series)
    second = over_friction(arguments.out)
    write_section("trial", "\n".join([
        f"`scripts/reproduce trial --series {arguments.series}` at {commit()}; solids of 30 mm, balls of 5 mm, percent held (95 % interval). The judge is physics, protocol "
        "`paper`; nothing is fitted. 17 degrees in both readings; noise of docs/metric.md, and that of a calibrated cell (friction 0.02, object 0.5 mm, gripper 0.25 mm). "
        "The adversarial cylinders are the first two samples of the networks that ship, at 40 mm, not the paper's.", "", *first, "",
        "Protocol `six-ways` at 1 g over friction, all planned grasps, default noise; in brackets the candidates kept, percent:", "", *second]), DOCUMENT)


if __name__ == "__main__":
    main()
