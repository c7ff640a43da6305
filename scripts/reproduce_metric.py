"""Which static number follows trials in physics: the table of docs/metric.md. Called by scripts/reproduce."""
import argparse
import csv
import math
import pathlib
import resource

import numpy
from scipy.stats import rankdata, spearmanr

from reproduce_document import SETS, call, commit, write_section
from reproduce_physics import Job, run_all

DOCUMENT = pathlib.Path("docs/metric.md")
# Nothing was chosen by what came of the second half's objects.
HALVES = {"chosen on": 77, "held out": 4177}
METHODS = {"random": "random --alpha 20", "search": "search --alpha 20",
           "dents": "search --alpha 20 --coarse 200 --max-move 20"}
FRICTIONS = (0.25, 0.5)
SETTLED = ("--contact", "sphere", "--closing", "settled")
# label: (column of scores.csv, flags of evaluate)
NUMBERS = {
    "graspability (75th percentile of robust epsilon)": ("graspability", ()),
    "mean of robust epsilon": ("mean", ()),
    "the same, balls of 5 mm at their first contacts": ("mean", ("--contact", "sphere")),
    "**settled**, balls": ("graspability", ("--preset", "settled")),
    "settled, pads (the trials are of balls)": ("graspability", ("--preset", "settled", "--contact", "pad")),
    "settled, balls, 400 grasps": ("graspability", ("--preset", "settled", "--num-grasps", 400, "--max-attempts", 16000)),
}


class Study:
    def __init__(self, out, objects, samples):
        self.out, self.objects, self.samples = out, objects, samples

    def groups(self, half):
        """{name: folder or file of objects} of one half."""
        base = self.out / half.replace(" ", "-")
        found = {}
        for kind in SETS:
            found[f"{kind}-before"] = base / kind / "random" / "before"
            found.update({f"{kind}-{name}": base / kind / name / "after" for name in METHODS})
            found.update({f"{kind}-{which}": base / f"{kind}-{which}.h5" for which in ("prior", "adversarial")})
        return base, found

    def jobs(self):
        jobs = []
        for half, seed in HALVES.items():
            base, groups = self.groups(half)
            for kind in SETS:
                grids = base / f"{kind}.h5"
                jobs.append(Job(grids, 1, "dataset", "make", kind, "--count", self.objects, "--seed", seed, "--out", grids))
                for name, flags in METHODS.items():
                    folder = base / kind / name
                    jobs.append(Job(folder / "perturb.csv", 1.5 * self.objects, "perturb", *flags.split(), grids, "--out", folder))
                for which in ("prior", "adversarial"):
                    file = groups[f"{kind}-{which}"]
                    jobs.append(Job(file, 2, "sample", f"{kind}-{which}", "--count", self.samples, "--seed", seed, "--out", file))
            for friction in FRICTIONS:
                for name, place in groups.items():
                    folder = base / f"trial-{friction}" / name
                    flags = ("--friction", friction, "--mass", 0.05, "--num-grasps", 25, "--draws", 4, "--replays", 0)
                    jobs.append(Job(folder / "trials.csv", 0.4 * self.objects, "trial", place, *flags, *SETTLED,
                                    "--num-draws", 25, "--out", folder))
                    for number, (_, own) in enumerate(NUMBERS.values()):
                        table = base / f"scores-{friction}" / f"{name}-{number}.csv"
                        jobs.append(TimedJob(table, 0.02 * self.objects, "evaluate", place, "--friction", friction,
                                             *(() if own[:1] == ("--preset",) else ("--num-grasps", 100)), *own, "--out", table))
        return jobs


class TimedJob(Job):
    """Writes the processor time of the call beside its table."""

    def run(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        super().run()
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        self.target.with_suffix(".seconds").write_text(f"{spent}\n")


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def auc(predicted, held):
    """Area under the curve of a prediction; None where all came out alike."""
    held = numpy.array(held, bool)
    if held.all() or not held.any():
        return None
    ranks = rankdata(predicted)
    return (ranks[held].sum() - held.sum() * (held.sum() + 1) / 2) / (held.sum() * (~held).sum())


def inside_objects(executions, predicted):
    """Mean AUC over objects of a prediction of each execution."""
    objects = {}
    for row in executions:
        objects.setdefault(row["object"], []).append((float(row[predicted]), int(row["stages"]) > 0))
    found = [auc(*zip(*rows)) for rows in objects.values()]
    return [value for value in found if value is not None]


def gather(study, half, friction):
    """Simulated success and every number of NUMBERS, an object each; AUC inside objects; seconds an object."""
    base, groups = study.groups(half)
    success, numbers = [], {label: [] for label in NUMBERS}
    seconds, areas = {label: 0.0 for label in NUMBERS}, {"epsilon": [], "robust_quality": []}
    for name in groups:
        folder = base / f"trial-{friction}" / name
        held = {row["object"]: float(row["held"]) for row in read(folder / "trials.csv") if row["held"]}
        executions = read(folder / "executions.csv")
        for column, found in areas.items():
            found += inside_objects(executions, column)
        tables = {}
        for number, (label, (column, _)) in enumerate(NUMBERS.items()):
            table = base / f"scores-{friction}" / f"{name}-{number}.csv"
            seconds[label] += float(table.with_suffix(".seconds").read_text())
            tables[label] = {row["object"]: row for row in read(table)}
        for name_of, value in held.items():
            success.append(value)
            for label, (column, _) in NUMBERS.items():
                row = tables[label][name_of]
                numbers[label].append(float(row[column]) if row[column] else math.nan)
    return numpy.array(success), {k: numpy.array(v) for k, v in numbers.items()}, areas, \
        {k: v / len(success) for k, v in seconds.items()}


def spearman(a, b, rng):
    """Rank correlation with its 95 % bootstrap interval over objects."""
    both = numpy.isfinite(a) & numpy.isfinite(b)
    a, b = a[both], b[both]
    again = []
    for _ in range(500):
        pick = rng.integers(0, len(a), len(a))
        again.append(spearmanr(a[pick], b[pick])[0])
    low, high = numpy.nanpercentile(again, [2.5, 97.5])
    return f"{spearmanr(a, b)[0]:.2f} ({low:.2f} to {high:.2f})"


def report(study, words):
    rng = numpy.random.default_rng(1)
    found = {(half, friction): gather(study, half, friction) for friction in FRICTIONS for half in HALVES}
    head = [f"{friction}, {half}" for friction in FRICTIONS for half in HALVES]
    lines = ["| number | " + " | ".join(head) + " | processor time an object |", "| --- |" + " --- |" * (len(head) + 1)]
    first = next(iter(found.values()))
    for label in NUMBERS:
        cells = [spearman(success, numbers[label], rng) for success, numbers, _, _ in found.values()]
        lines.append(f"| {label} | " + " | ".join(cells) + f" | {1000 * first[3][label]:.1f} ms |")
    counts = {half: len(found[half, FRICTIONS[0]][0]) for half in HALVES}
    areas = []
    for friction in FRICTIONS:
        both = {c: [v for half in HALVES for v in found[half, friction][2][c]] for c in ("epsilon", "robust_quality")}
        areas.append(f"{friction}: {numpy.mean(both['robust_quality']):.3f} by the mean of 25 draws of a grasp, "
                     f"{numpy.mean(both['epsilon']):.3f} by the very draw")
    held = ", ".join(f"{100 * success.mean():.0f} +-{100 * success.std():.0f}" for success, *_ in found.values())
    text = [f"`scripts/reproduce metric{words}` at {commit()}: rank correlation (Spearman, 95 % interval over objects) of each number with the share held in MuJoCo, "
            f"at friction 0.25 and 0.5, all objects at 50 g; {counts['chosen on']} objects on which the metric was made (seed 77) and {counts['held out']} held out (seed 4177): prior sets, "
            "the same perturbed at random, by the search and by broad dents, samples of all six networks. Trials: `six-ways` at 1 g, balls, 25 planned grasps, four executions each; "
            f"held, mean and spread over objects, percent: {held}. The numbers have grasps and draws of their own.", "", *lines, "",
            "Inside an object, area under the curve of the settled metric for one execution at 1 g, mean over objects: " + "; ".join(areas) + "."]
    write_section("judges", "\n".join(text), DOCUMENT)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--objects", type=int, default=10, help="of a prior set and half")
    parser.add_argument("--samples", type=int, default=8, help="of a network and half")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/metric"))
    arguments = parser.parse_args()
    study = Study(arguments.out / f"{arguments.objects}-{arguments.samples}", arguments.objects, arguments.samples)
    run_all(study.jobs())
    default = (arguments.objects, arguments.samples) == (10, 8)
    report(study, "" if default else f" --objects {arguments.objects} --samples {arguments.samples}")


if __name__ == "__main__":
    main()
