"""What physics says of perturbed objects and of networks: runs and tables of docs/trials.md. Called by scripts/reproduce."""
import argparse
import collections
import csv
import filecmp
import math
import pathlib
import shutil
import sys
import time

from reproduce_document import SETS, call, commit, made, means, write_section

DOCUMENT = pathlib.Path("docs/trials.md")
METHODS = (
    ("random 20", "random --alpha 20"),
    ("rotation 0.075", "rotation --beta 0.075"),
    ("search 10", "search --alpha 10"),
    ("search 20", "search --alpha 20"),
    ("search 20, broad dents", "search --alpha 20 --coarse 200 --max-move 20"),
)
ORDER = [METHODS[i][0] for i in (4, 3, 0, 2, 1)]  # in which they are tried
NETWORKS = ("prior", "adversarial")
FRICTIONS = (0.5, 0.25)
TIPS = ("sphere", "pad")
EQUAL = 0.05  # kg
MASSES = {"own": (), "equal": ("--mass", EQUAL)}
# Columns of trials.csv that are compared; the last one is made of two.
LOADS = {"1 g": "held", "3 g": "held_3_g", "8 g": "held_8_g", "best quarter": "held_top_quarter", "kept": "kept"}
# Seconds on two quiet cores, which the estimate at the start goes by; its end goes by those measured.
PERTURB_SECONDS = {"random": 0.5, "rotation": 0.3, "search": 1.7}  # an object
SAMPLE_SECONDS = 0.2  # an object
EXECUTION_SECONDS = {"sphere": 0.004, "pad": 0.011}  # plan included


class Job:
    """A call of the binary; done when what it makes is there."""

    def __init__(self, target, seconds, *arguments):
        self.target, self.seconds, self.arguments = target, seconds, arguments

    def done(self):
        return made(self.target)

    def run(self):
        self.target.parent.mkdir(parents=True, exist_ok=True)
        try:
            call(*self.arguments)
        except BaseException:  # what an interrupted perturb has done by then would count as done
            if self.target.name == "perturb.csv":
                shutil.rmtree(self.target.parent)
            raise


def folder_name(label):
    return "".join(c if c.isalnum() or c == "." else "-" for c in label)


def minutes(seconds):
    return f"{math.ceil(seconds / 60)} min"


def run_all(jobs):
    """Does what is not done yet: a second call of the script goes on where the first stopped."""
    left = [job for job in jobs if not job.done()]
    expected = sum(job.seconds for job in left)
    print(f"{len(left)} of {len(jobs)} calls to make, about {minutes(expected)} on two cores", flush=True)
    begin, behind = time.monotonic(), 0.0
    for number, job in enumerate(left, 1):
        start = time.monotonic()
        job.run()
        now = time.monotonic()
        behind += job.seconds
        # The estimate counts as five minutes that went by it, so that the first calls do not sway what is left.
        rest = (expected - behind) * (now - begin + 300) / (behind + 300)
        print(f"{number:4} of {len(left)}  {now - start:5.0f} s  about {minutes(rest)} left  {job.target.parent}", flush=True)


class Study:
    """Where everything lies. Objects once, for trials of any number of grasps and draws."""

    def __init__(self, out, objects, grasps, draws, sets, tips):
        self.out, self.objects, self.grasps, self.draws = out, objects, grasps, draws
        self.sets, self.tips = sets, tips

    def perturbed(self, kind, label):
        return self.out / kind / folder_name(label)

    def before(self, kind):
        """The originals, which every method writes: those of the first one."""
        return self.perturbed(kind, ORDER[0]) / "before"

    def samples(self, kind, which):
        return self.out / "networks" / f"{kind}-{which}.h5"

    def trial(self, name, kind, friction, tip, masses):
        return self.out / f"trials-{self.grasps}x{self.draws}" / f"{kind}-{friction}-{tip}-{masses}" / folder_name(name)

    def jobs(self):
        made = [Job(self.out / f"{kind}.h5", 1.0, "dataset", "make", kind, "--count", self.objects, "--seed", 77,
                    "--out", self.out / f"{kind}.h5") for kind in self.sets]
        flags_of = dict(METHODS)
        for label in ORDER:
            flags = flags_of[label].split()
            for kind in self.sets:
                folder = self.perturbed(kind, label)
                made.append(Job(folder / "perturb.csv", PERTURB_SECONDS[flags[0]] * self.objects, "perturb", *flags,
                                self.out / f"{kind}.h5", "--out", folder))
        for kind in self.sets:
            for which in NETWORKS:
                made.append(Job(self.samples(kind, which), SAMPLE_SECONDS * self.objects, "sample", f"{kind}-{which}", "--count",
                                self.objects, "--seed", 7, "--out", self.samples(kind, which)))
        return made + self.trials()

    def trials(self):
        # What matters most first: low friction, then the metric's own, then the other fingertip.
        jobs = []
        for tip in self.tips:
            for friction in reversed(FRICTIONS):
                for kind in self.sets:
                    objects = {"before": self.before(kind)}
                    objects.update({label: self.perturbed(kind, label) / "after" for label in ORDER})
                    objects.update({which: self.samples(kind, which) for which in NETWORKS})
                    for name, place in objects.items():
                        for masses, flags in MASSES.items():
                            folder = self.trial(name, kind, friction, tip, masses)
                            seconds = self.objects * self.grasps * self.draws * EXECUTION_SECONDS[tip]
                            jobs.append(Job(folder / "trials.csv", seconds, "trial", place, "--friction", friction,
                                            "--tip", tip, "--num-grasps", self.grasps, "--draws", self.draws,
                                            "--replays", 0, "--out", folder, *flags))
        return jobs

    def rows(self, name, *where):
        """trials.csv by object, or None where it is not there yet."""
        table = self.trial(name, *where) / "trials.csv"
        return read_trials(table) if table.exists() else None


def require_same_originals(study):
    """One trial of the originals stands for all methods because all wrote the same."""
    for kind in study.sets:
        first = study.before(kind)
        names = sorted(path.name for path in first.iterdir())
        for label in ORDER[1:]:
            other = study.perturbed(kind, label) / "before"
            _, different, missing = filecmp.cmpfiles(first, other, names, shallow=False)
            if different or missing or len(names) != len(list(other.iterdir())):
                sys.exit(f"{other}: not the originals of {first}; remove the folders of one of the two")


def read_trials(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        candidates = float(row["candidates"])
        row["kept"] = float(row["grasps"]) / candidates if candidates > 0 else math.nan
    return {row["object"]: row for row in rows}


def percent_of(row, column):
    return 100 * float(row[column]) if row[column] != "" else math.nan


Mean = collections.namedtuple("Mean", "mean half_width count")


def mean_of(values):
    """The mean and its 95 % interval over the objects that have a number, as means.csv has it."""
    values = [value for value in values if not math.isnan(value)]
    if not values:
        return Mean(math.nan, math.nan, 0)
    mean = math.fsum(values) / len(values)
    if len(values) == 1:
        return Mean(mean, math.nan, 1)
    variance = math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1)
    return Mean(mean, 1.96 * math.sqrt(variance / len(values)), len(values))


def paired(before, after, column):
    """Points of change over objects of one name, each with its own original; and the originals of these pairs."""
    pairs = [(percent_of(before[name], column), percent_of(row, column)) for name, row in after.items() if name in before]
    pairs = [(a, b) for a, b in pairs if not math.isnan(b - a)]
    return mean_of([b - a for a, b in pairs]), mean_of([a for a, _ in pairs])


def change_text(change):
    if not change.count:
        return "-"
    return f"{change.mean:+.1f}" + ("" if math.isnan(change.half_width) else f" +-{change.half_width:.1f}")


def number_text(text):
    return f"{float(text):.1f}" if text else "-"


def perturb_lines(study, friction, tip):
    lines = []
    for label, _ in METHODS:
        for kind in study.sets:
            rows = {(side, masses): study.rows(name, kind, friction, tip, masses)
                    for side, name in (("before", "before"), ("after", label)) for masses in MASSES}
            if None in rows.values():
                continue
            shape = means(study.perturbed(kind, label))[0]
            own, original = paired(rows["before", "own"], rows["after", "own"], LOADS["1 g"])
            equal = [paired(rows["before", "equal"], rows["after", "equal"], column)[0] for column in LOADS.values()]
            cells = [kind, label, number_text(shape["reduction_pct"]), number_text(shape["hausdorff_pct"]),
                     f"{original.mean:.1f}", change_text(own), *map(change_text, equal)]
            lines.append("| " + " | ".join(cells) + " |")
    return lines


def unpaired(before, after, column):
    a, b = (mean_of([percent_of(row, column) for row in rows.values()]) for rows in (before, after))
    change = Mean(b.mean - a.mean, math.hypot(a.half_width, b.half_width), min(a.count, b.count))
    return f"{a.mean:.1f} -> {b.mean:.1f} ({change_text(change)})"


def network_lines(study, friction, tip):
    lines = []
    for kind in study.sets:
        rows = {(which, masses): study.rows(which, kind, friction, tip, masses) for which in NETWORKS for masses in MASSES}
        if None in rows.values():
            continue
        cells = [unpaired(rows["prior", masses], rows["adversarial", masses], LOADS[load])
                 for masses, load in (("own", "1 g"), ("equal", "1 g"), ("equal", "8 g"))]
        lines.append(f"| {kind} | {friction} | {tip} | " + " | ".join(cells) + " |")
    return lines


def section(study, command):
    mass = f"{1000 * EQUAL:.0f} g"
    text = [f"`{command}` at {commit()}: {study.objects} objects a set (seed 77), {study.grasps} grasps each, planned at the trial's friction on the "
            f"object they are tried on, {study.draws} executions a grasp. Percent held and its change in points, +-95 % over objects; lengths in "
            "percent of the diagonal. The judge is the trial (`six-ways`); kappa is the metric's."]
    for tip in TIPS:
        for friction in FRICTIONS:
            lines = perturb_lines(study, friction, tip)
            if lines:
                text += ["", f"Friction {friction}, fingertip {tip}:", "",
                         f"| set | method | kappa, % less | Hausdorff, % | before, 1 g | own mass, 1 g | {mass}, 1 g | 3 g | 8 g | "
                         "best quarter, 1 g | candidates kept, points |",
                         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |", *lines]
    lines = [line for tip in TIPS for friction in FRICTIONS for line in network_lines(study, friction, tip)]
    if lines:
        text += ["", f"Networks that ship, {study.objects} samples a set, prior -> adversarial (not paired: the interval is of two sets):", "",
                 f"| set | friction | fingertip | own mass, 1 g | {mass}, 1 g | {mass}, 8 g |",
                 "| --- | --- | --- | --- | --- | --- |", *lines]
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--objects", type=int, default=50)
    parser.add_argument("--grasps", type=int, default=8, help="of an object")
    parser.add_argument("--draws", type=int, default=3, help="executions of a grasp")
    parser.add_argument("--only", choices=SETS)
    parser.add_argument("--tips", nargs="*", choices=TIPS, default=TIPS)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--report", action="store_true", help="write what there is")
    arguments = parser.parse_args()
    study = Study(arguments.out or pathlib.Path("runs/physics") / str(arguments.objects), arguments.objects, arguments.grasps,
                  arguments.draws, (arguments.only,) if arguments.only else SETS, arguments.tips)
    if not arguments.report:
        run_all(study.jobs())
    require_same_originals(study)
    command = f"scripts/reproduce physics --objects {study.objects} --grasps {study.grasps} --draws {study.draws}"
    write_section("physics", section(study, command), DOCUMENT)


if __name__ == "__main__":
    main()
