"""What physics says of perturbed objects and of networks: runs and tables of docs/trials.md. Called by scripts/reproduce."""
import argparse
import csv
import math
import pathlib
import time

from reproduce_document import SETS, call, commit, means, write_section

DOCUMENT = pathlib.Path("docs/trials.md")
METHODS = (
    ("random 20", "random --alpha 20"),
    ("rotation 0.075", "rotation --beta 0.075"),
    ("search 10", "search --alpha 10"),
    ("search 20", "search --alpha 20"),
    ("search 20, broad dents", "search --alpha 20 --coarse 200 --max-move 20"),
)
ORDER = [METHODS[i][0] for i in (4, 3, 0, 2, 1)]  # in which they are tried
FRICTIONS = (0.5, 0.25)
TIPS = ("sphere", "pad")
EQUAL = 0.05  # kg


def folder_name(label):
    return "".join(c if c.isalnum() or c == "." else "-" for c in label)


def once(target, *arguments):
    """Calls the binary unless what it makes is there: a second call of the script goes on where the first stopped."""
    if target.exists():
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    call(*arguments)
    print(f"{time.monotonic() - begin:6.0f} s  antigrasp {' '.join(map(str, arguments[:4]))} ...", flush=True)


def perturbed(out, objects, kind, label, flags):
    prior = out / f"{kind}.h5"
    once(prior, "dataset", "make", kind, "--count", objects, "--seed", 77, "--out", prior)
    folder = out / kind / folder_name(label)
    once(folder / "perturb.csv", "perturb", *flags.split(), prior, "--out", folder)
    return folder


def tried(folder, friction, tip, grasps):
    out = folder / f"trial-{friction}-{tip}"
    once(out / "trials.csv", "trial", folder / "after", "--baseline", folder / "before", "--friction", friction, "--tip",
         tip, "--equal-mass", EQUAL, "--num-grasps", grasps, "--replays", 1, "--out", out)
    return rows_of(out)


def rows_of(folder):
    with open(folder / "means.csv", newline="") as file:
        return {(row["masses"], row["stage"], row["grasps"]): row for row in csv.DictReader(file)}


def number(row, name):
    return float(row[name]) if row[name] else math.nan


def change(row):
    if row is None or not row["difference"]:
        return "-"
    return f"{number(row, 'difference'):+.1f} +-{number(row, 'difference_half_width'):.1f}"


def perturb_rows(out, objects, friction, tip, sets):
    lines = []
    for label, flags in METHODS:
        for kind in sets:
            folder = out / kind / folder_name(label)
            if not (folder / f"trial-{friction}-{tip}" / "means.csv").exists():
                continue
            rows = rows_of(folder / f"trial-{friction}-{tip}")
            shape = means(folder)[0]
            own, equal = (rows[(masses, "1 g", "all")] for masses in ("own", "equal"))
            lines.append(
                f"| {kind} | {label} | {percent(shape, 'reduction_pct')} | {percent(shape, 'hausdorff_pct')} | {number(own, 'held_before'):.1f} | "
                f"{change(own)} | {change(equal)} | {change(rows[('equal', '3 g', 'all')])} | {change(rows[('equal', '8 g', 'all')])} | "
                f"{change(rows[('equal', '1 g', 'top quarter')])} | {change(rows[('equal', '', 'candidates kept')])} |")
    return lines


def percent(row, name):
    return f"{float(row[name]):.1f}" if row[name] else "-"


def samples(out, objects, grasps, kind, which, friction):
    """Samples of a network, tried at their own and at an equal mass."""
    grids = out / "networks" / f"{kind}-{which}.h5"
    once(grids, "sample", f"{kind}-{which}", "--count", objects, "--seed", 7, "--out", grids)
    rows = {}
    for masses, flags in (("own", ()), ("equal", ("--mass", EQUAL))):
        folder = out / "networks" / f"{kind}-{which}-{friction}-{masses}"
        once(folder / "trials.csv", "trial", grids, "--friction", friction, "--num-grasps", grasps, "--replays", 1, "--out",
             folder, *flags)
        rows[masses] = rows_of(folder)
    return rows


def unpaired(before, after, masses, stage):
    a, b = (rows[masses][(masses, stage, "all")] for rows in (before, after))
    half = math.hypot(number(a, "held_half_width"), number(b, "held_half_width"))
    return f"{number(a, 'held'):.1f} -> {number(b, 'held'):.1f} ({number(b, 'held') - number(a, 'held'):+.1f} +-{half:.1f})"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--objects", type=int, default=50)
    parser.add_argument("--grasps", type=int, default=100)
    parser.add_argument("--only", choices=SETS)
    parser.add_argument("--tips", nargs="*", choices=TIPS, default=TIPS)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--report", action="store_true", help="write what there is")
    arguments = parser.parse_args()
    out = arguments.out or pathlib.Path("runs/physics") / str(arguments.objects)
    sets = (arguments.only,) if arguments.only else SETS
    if not arguments.report:
        for label, flags in METHODS:
            for kind in sets:
                perturbed(out, arguments.objects, kind, label, flags)
        # What matters most first: low friction, then the metric's own, then the other fingertip.
        for tip in arguments.tips:
            for label in ORDER:
                for friction in reversed(FRICTIONS):
                    for kind in sets:
                        tried(out / kind / folder_name(label), friction, tip, arguments.grasps)
    text = [f"`scripts/reproduce physics --objects {arguments.objects} --grasps {arguments.grasps}` at {commit()}: {arguments.objects} objects a set (seed 77), "
            f"{arguments.grasps} grasps each, planned at the trial's friction on the object they are tried on, five executions a grasp. Percent held "
            "and its change in points, +-95 % over objects; lengths in percent of the diagonal. The judge is the trial "
            f"(`six-ways`); kappa is the metric's."]
    for tip in TIPS:
        for friction in FRICTIONS:
            lines = perturb_rows(out, arguments.objects, friction, tip, sets)
            if not lines:
                continue
            text += ["", f"Friction {friction}, fingertip {tip}:", "",
                     f"| set | method | kappa, % less | Hausdorff, % | before, 1 g | own mass, 1 g | {1000 * EQUAL:.0f} g, 1 g | 3 g | 8 g | "
                     "best quarter, 1 g | candidates kept, points |",
                     "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |", *lines]
    text += network_table(out, arguments, sets)
    write_section("physics", "\n".join(text), DOCUMENT)


def network_table(out, arguments, sets):
    lines = []
    for friction in FRICTIONS:
        for kind in sets:
            done = out / "networks" / f"{kind}-adversarial-{friction}-equal" / "means.csv"
            if arguments.report and not done.exists():
                continue
            before, after = (samples(out, arguments.objects, arguments.grasps, kind, which, friction) for which in ("prior", "adversarial"))
            lines.append(f"| {kind} | {friction} | {unpaired(before, after, 'own', '1 g')} | {unpaired(before, after, 'equal', '1 g')} | "
                         f"{unpaired(before, after, 'equal', '8 g')} |")
    if not lines:
        return []
    return ["", f"Networks that ship, {arguments.objects} samples a set, prior -> adversarial, fingertip sphere (not paired: the interval is of "
            "two sets):", "", f"| set | friction | own mass, 1 g | {1000 * EQUAL:.0f} g, 1 g | {1000 * EQUAL:.0f} g, 8 g |",
            "| --- | --- | --- | --- | --- |", *lines]


if __name__ == "__main__":
    main()
