"""The search on a judge beside the other methods, over the Hausdorff distance: runs, table and figure of docs/perturbation.md.
Called by scripts/reproduce."""
import argparse
import csv
import math
import pathlib

from reproduce_document import IMAGES, SETS, commit, means, pyplot, save_figure, write_section
from reproduce_physics import EQUAL, Job, folder_name, run_all

DOCUMENT = pathlib.Path("docs/perturbation.md")
DISTANCES = (5, 12, 2, 8, 1, 3)  # percent of the diagonal, in the order in which they are run
ON_THE_JUDGE, ON_THE_METRIC = "search on the settled metric", "search on the metric"
# Methods without a budget of distance: one point each.
OTHERS = (("random 20", "random --alpha 20"), ("rotation 0.075", "rotation --beta 0.075"))
# Seconds an object on two quiet cores.
SECONDS = {"judge": 8.0, "metric": 2.0, "other": 0.5, "trial": 2.5}


def methods(friction, distances):
    """(label, distance or None, flags of perturb, kind for SECONDS)"""
    for distance in distances:
        yield (ON_THE_JUDGE, distance, f"search --objective settled --friction {friction} --hausdorff {distance}", "judge")
    for distance in distances:
        yield (ON_THE_METRIC, distance, f"search --alpha 60 --friction {friction} --max-move {distance}", "metric")
    for label, flags in OTHERS:
        yield (label, None, flags, "other")


class Study:
    def __init__(self, out, objects, grasps, frictions, distances, sets):
        self.out, self.objects, self.grasps = out, objects, grasps
        self.frictions, self.distances, self.sets = frictions, distances, sets

    def prior(self, kind):
        return self.out / f"{kind}.h5"

    def perturbed(self, kind, flags):
        return self.out / kind / folder_name(flags)

    def trial(self, kind, flags, friction):
        return self.out / f"trials-{self.grasps}" / f"{kind}-{friction}" / folder_name(flags)

    def jobs(self):
        jobs = [Job(self.prior(kind), 1.0, "dataset", "make", kind, "--count", self.objects, "--seed", 77, "--out", self.prior(kind))
                for kind in self.sets]
        for friction in self.frictions:
            for _, _, flags, cost in methods(friction, self.distances):
                for kind in self.sets:
                    changed, tried = self.perturbed(kind, flags), self.trial(kind, flags, friction)
                    jobs.append(Job(changed / "perturb.csv", SECONDS[cost] * self.objects, "perturb", *flags.split(),
                                    self.prior(kind), "--out", changed))
                    # Other draws than those that perturb.csv was judged by.
                    jobs.append(Job(tried / "trials.csv", SECONDS["trial"] * self.objects, "trial", changed / "after", "--baseline",
                                    changed / "before", "--friction", friction, "--mass", EQUAL, "--num-grasps", self.grasps,
                                    "--seed", 2, "--replays", 0, "--out", tried))
        return jobs

    def row(self, kind, flags, friction):
        """What is known of one method on one set, None before it was tried."""
        table = self.trial(kind, flags, friction) / "means.csv"
        if not table.exists():
            return None
        rows = read_means(table)
        shape = means(self.perturbed(kind, flags))[0]
        return {"held": rows["1 g", "all"], "kept": rows["", "candidates kept"], "shape": shape,
                "turned": mean_turn(self.perturbed(kind, flags) / "perturb.csv")}


def mean_turn(path):
    """By how much normals turn in the mean over a surface and over objects, degrees: what tells ripples from dents of the same height."""
    with open(path, newline="") as file:
        turns = [float(row["normal_mean_deg"]) for row in csv.DictReader(file) if row["status"] == "ok"]
    return sum(turns) / len(turns) if turns else math.nan


def read_means(path):
    with open(path, newline="") as file:
        return {(row["stage"], row["grasps"]): row for row in csv.DictReader(file) if row["masses"] == "equal"}


def number(row, name):
    return float(row[name]) if row[name] else math.nan


def share(row, name, digits=1):
    return f"{number(row, name):.{digits}f}" if row[name] else "-"


def table_line(kind, label, row):
    held, kept, shape = row["held"], row["kept"], row["shape"]
    change = f"{number(held, 'difference'):+.1f} +-{number(held, 'difference_half_width'):.1f}" if held["difference"] else "-"
    return (f"| {kind} | {label} | {share(shape, 'hausdorff_pct')} | {row['turned']:.0f} | {share(shape, 'volume_pct')} | {share(shape, 'reduction_pct', 0)} | "
            f"{share(held, 'held_before')} | {share(held, 'held')} | {change} | {share(kept, 'held_before')} -> {share(kept, 'held')} |")


def label_of(label, distance):
    return label if distance is None else f"{label}, {distance} %"


def table(study, friction):
    lines = []
    for label, distance, flags, _ in sorted(methods(friction, study.distances), key=lambda m: (m[0], m[1] or 0)):
        for kind in study.sets:
            row = study.row(kind, flags, friction)
            if row:
                lines.append(table_line(kind, label_of(label, distance), row))
    if not lines:
        return []
    return ["", f"Friction {friction}:", "",
            "| set | method | Hausdorff, % | normals turned, degrees | volume, % | kappa, % less | held before, % | after | change, points | candidates kept, % |",
            "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |", *lines]


def figure(study, path):
    """Points of success lost over the Hausdorff distance; a row a friction, a panel a set."""
    grid, axes = pyplot().subplots(len(study.frictions), len(study.sets), squeeze=False, sharey="row",
                                   figsize=(3.2 * len(study.sets), 2.6 * len(study.frictions)))
    for line, friction in zip(axes, study.frictions):
        for axis, kind in zip(line, study.sets):
            curves = {}
            for label, _, flags, _ in methods(friction, study.distances):
                row = study.row(kind, flags, friction)
                if row and row["held"]["difference"]:
                    curves.setdefault(label, []).append((number(row["shape"], "hausdorff_pct"), -number(row["held"], "difference"),
                                                         number(row["held"], "difference_half_width")))
            for label, points in curves.items():
                distance, lost, half = zip(*sorted(points))
                axis.errorbar(distance, lost, half, label=label, marker="o", markersize=3, capsize=2, linewidth=1)
            axis.set_title(f"{kind}, friction {friction}", fontsize=8)
            axis.set_xlabel("Hausdorff distance, % of the diagonal", fontsize=7)
            axis.tick_params(labelsize=7)
            axis.axhline(0.0, color="gray", linewidth=0.5)
        line[0].set_ylabel("success lost, points", fontsize=7)
    axes[0][0].legend(fontsize=6)
    save_figure(grid, path)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--objects", type=int, default=12)
    parser.add_argument("--grasps", type=int, default=100)
    parser.add_argument("--distances", type=float, nargs="*", default=DISTANCES, help="percent of the diagonal")
    parser.add_argument("--frictions", type=float, nargs="*", default=(0.25, 0.5))
    parser.add_argument("--only", choices=SETS)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--report", action="store_true", help="write what there is")
    arguments = parser.parse_args()
    out = arguments.out or pathlib.Path("runs/judge") / str(arguments.objects)
    distances = [int(d) if d == int(d) else d for d in arguments.distances]
    study = Study(out, arguments.objects, arguments.grasps, arguments.frictions, distances, (arguments.only,) if arguments.only else SETS)
    if not arguments.report:
        run_all(study.jobs())
    image = IMAGES / "search_on_a_judge.png"
    figure(study, image)
    text = [f"`scripts/reproduce judge --objects {arguments.objects} --grasps {arguments.grasps}` at {commit()}: {arguments.objects} objects a set "
            f"(seed 77), every object of {1000 * EQUAL:.0f} g, grasps planned at the trial's friction on the object they are tried on, by draws that no "
            "search has seen; percent held and its change, paired, +-95 % over objects. The judge is the trial (`six-ways`, sphere)."]
    for friction in study.frictions:
        text += table(study, friction)
    text += ["", f"![success lost over the Hausdorff distance]({image.relative_to('docs')})"]
    write_section("judge", "\n".join(text), DOCUMENT)


if __name__ == "__main__":
    main()
