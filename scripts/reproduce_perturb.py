"""Sections VI-A and VI-B with the binary antigrasp: runs, tables, figures. Called by scripts/reproduce."""
import argparse
import csv
import pathlib
import re
import shutil
import time

from reproduce_document import DOCUMENT, SETS, call, commit, means, pyplot, save_figure, write_section

QUICK_OBJECTS = 20
HISTORY = ("iteration", "pairs", "pairs_below_cone")  # columns of history.csv


class Setting:
    """One row of a table: a method with its flags. `cost` is roughly the seconds an object takes."""

    def __init__(self, label, flags, cost, paper=""):
        self.label, self.flags, self.cost, self.paper = label, flags, cost, paper
        self.folder = re.sub(r"[^a-z0-9.]+", "-", flags.replace("--", "")).strip("-")


def random_settings():
    paper = {10: "32 / 12 / 32"}
    rows = [Setting(f"alpha {alpha}", f"random --alpha {alpha}", 0.6, paper.get(alpha, "")) for alpha in (10, 15, 20)]
    rows += [
        Setting(f"alpha {alpha} per step", f"random --alpha {alpha} --limit step --iterations-per-vertex 1", 0.2,
                paper.get(alpha, ""))
        for alpha in (10, 15, 20)
    ]
    return rows


def rotation_settings():
    paper = {0.01: "32 / 11 / 21"}
    rows = [Setting("decimated only", "rotation --iterations-per-face 0", 0.2)]
    for unchecked in ("", " --unchecked"):
        for times in (1, 10):
            rows += [
                Setting(f"beta {beta}, {times} x{', unchecked' if unchecked else ''}",
                        f"rotation --beta {beta} --iterations-per-face {times}{unchecked}", 0.3, paper.get(beta, ""))
                for beta in (0.01, 0.075, 0.3)
            ]
    return rows


def search_settings():
    return [Setting(f"search, alpha {alpha}", f"search --alpha {alpha}", 4.0) for alpha in (10, 20)]


def search_variants():
    rows = [Setting("the default", "search", 3.5), Setting("half the steps", "search --steps 150", 1.8),
            Setting("twice the steps", "search --steps 600", 7.0), Setting("50 grasps a step", "search --grasps 50", 2.0),
            Setting("a sharper percentile", "search --percentile-softness 0.1", 3.5),
            Setting("a hard cone for planned grasps", "search --cone-width 0 --acceptance-softness 0.001", 3.5),
            Setting("steps a third as long", "search --step 0.1", 3.5),
            Setting("no annealing: the step stays", "search --last-step 1", 3.5),
            Setting("free extents", "search --no-keep-extents", 3.5),
            Setting("coarse to fine: 200 smoothing passes, moves not limited", "search --coarse 200 --max-move 100", 3.7)]
    return rows


def reading_settings():
    rows = [Setting("the default: alpha 10, original normals, smallest step, pairs by ray, 8 a vertex", "random", 0.6)]
    rows += [Setting(f"step {rule}", f"random --step {rule}", 0.6)
             for rule in ("smallest_or_none", "largest_angle", "largest")]
    rows += [Setting(f"pairs {draw}", f"random --pairs {draw}", 0.6) for draw in ("uniform", "area")]
    rows += [Setting("pairs within the jaw opening", "random --max-width 0.05", 0.6)]
    rows += [Setting(f"{count} iterations a vertex", f"random --iterations-per-vertex {count}", 0.1 * count)
             for count in (1, 24)]
    rows += [Setting(f"per step, {count} a vertex", f"random --limit step --iterations-per-vertex {count}", 0.1 * count)
             for count in (0.5, 2, 4)]
    rows += [Setting("unchecked", "random --unchecked", 0.5),
             Setting("per step, 2 a vertex, unchecked", "random --limit step --iterations-per-vertex 2 --unchecked", 0.2)]
    rows += [Setting(f"rotation, beta 0.075, pairs {draw}", f"rotation --pairs {draw}", 0.3)
             for draw in ("uniform", "area", "ray")]
    rows += [Setting(f"rotation, beta 0.075, turned by at most {turn} degrees", f"rotation --max-turn {turn}", 0.3)
             for turn in (30, 90)]
    return rows


class Runner:
    def __init__(self, out, objects, settings):
        self.out, self.objects = out, objects
        out.mkdir(parents=True, exist_ok=True)
        self.left = sum(s.cost for s in settings) * len(SETS)
        self.rate = None  # seconds of wall time per unit of cost

    def prior(self, kind):
        file = self.out / f"{kind}.h5"
        if not file.exists():
            call("dataset", "make", kind, "--count", self.objects, "--out", file)
        return file

    def folder(self, setting, kind):
        return self.out / kind / setting.folder

    def result(self, setting, kind):
        """Runs what is not there yet; the means over the objects, and those at Dex-Net's noise."""
        folder = self.folder(setting, kind)
        scores = folder / "dexnet_noise.csv"
        start = time.time()
        fresh = not scores.exists()
        if fresh:
            left = f", {self.left * self.rate / 60:.0f} min left" if self.rate else ""
            print(f"{setting.label}, {kind}{left}", flush=True)
            shutil.rmtree(folder, ignore_errors=True)
            call("perturb", *setting.flags.split(), self.prior(kind), "--out", folder, allowed=(0, 1))  # 1: no object
            if any((folder / "after").iterdir()):
                call("evaluate", folder / "after", "--baseline", folder / "before", "--noise", "dexnet",
                     "--num-grasps", "100", "--out", scores)
            else:
                scores.touch()
        self.left -= setting.cost
        if fresh:
            now = (time.time() - start) / setting.cost
            self.rate = now if self.rate is None else 0.5 * (self.rate + now)
        own = means(folder)[0]
        return own, means(scores)[0] if int(own["ok"]) else own


def number(text, form):
    return format(float(text), form) if text else "-"


def table(settings, runner):
    lines = ["| setting | paper | ours, % | at Dex-Net's noise, % | largest turn of a normal | broken, % | Hausdorff, % | volume, % |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for setting in settings:
        cells = [[] for _ in range(6)]
        for kind in SETS:
            own, dexnet = runner.result(setting, kind)
            cells[3].append(f"{100 * (1 - int(own['ok']) / int(own['objects'])):.0f}")
            if int(own["ok"]) < 3:
                for column in (0, 1, 2, 4, 5):
                    cells[column].append("-")
                continue
            for column, found in zip((0, 1), (own, dexnet)):
                cells[column].append(f"{number(found['reduction_pct'], '.0f')} ±{number(found['reduction_half_width_95'], '.0f')}")
            for column, name, form in ((2, "normal_max_deg", ".0f"), (4, "hausdorff_pct", ".1f"), (5, "volume_pct", ".1f")):
                cells[column].append(number(own[name], form))
        lines.append(f"| {setting.label} | {setting.paper} | " + " | ".join(" / ".join(c) for c in cells) + " |")
    return "\n".join(lines)


def distributions(name, columns, runner, images):
    """A picture for every set, a row for every setting: an object before and after, and the graspability of all."""
    for kind in SETS:
        call("figure", 3, *(runner.folder(setting, kind) for setting in columns),
             "--label", *(setting.label for setting in columns), "--out", images / f"{name}_{kind}.png")
    return "\n\n".join(f"![Graspability of {kind} before and after](images/{name}_{kind}.png)" for kind in SETS)


def figure_1(path, runner):
    """|F_a| of a dodecahedron against iterations of IV-A, five seeds, two friction cones. `antigrasp figure 1` has no
    line for the pairs below the cone."""
    solid = runner.out / "dodecahedron.stl"
    call("shape", "dodecahedron", "--phi", 0, "--size-mm", 60, "--out", solid)
    figure, axes = pyplot().subplots(1, 2, figsize=(7, 2.6))
    for ax, cone in zip(axes, (10, 26.565)):
        for seed in range(1, 6):
            folder = runner.out / f"dodecahedron-{cone}-{seed}"
            call("perturb", "exhaustive", solid, "--cone", cone, "--seed", seed, "--history", "--overwrite", "--out", folder)
            with open(folder / "history.csv") as table:
                history = [{name: float(row[name]) for name in HISTORY} for row in csv.DictReader(table)]
            iterations, pairs, below = ([row[name] for row in history] for name in HISTORY)
            ax.plot(iterations, pairs, color="#b2182b", linewidth=1, label="all" if seed == 1 else None)
            ax.plot(iterations, below, color="0.4", linewidth=1, linestyle="--",
                    label="with phi below the cone" if seed == 1 else None)
        ax.set_title(f"friction cone {cone:.0f} degrees", fontsize=9)
        ax.set_xlabel("iteration", fontsize=8)
        ax.set_ylim(bottom=0)
        ax.tick_params(labelsize=8)
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel("antipodal pairs of faces", fontsize=8)
    axes[0].legend(fontsize=7, frameon=False)
    save_figure(figure, path)


def picture(path, columns, runner):
    """A row of originals, then one per setting: the same three, three and two objects of the sets."""
    names = [(kind, f"{kind}-{i:06d}.stl") for kind, count in zip(SETS, (3, 3, 2)) for i in range(count)]
    rows = []
    for place, setting in enumerate([None, *columns]):
        row = runner.out / "picture" / str(place)
        shutil.rmtree(row, ignore_errors=True)
        row.mkdir(parents=True)
        for number, (kind, name) in enumerate(names):
            source = runner.folder(setting or columns[0], kind) / ("after" if setting else "before") / name
            if source.exists():
                shutil.copy(source, row / f"{number}.stl")
        rows.append(row)
    call("sheet", *rows, "--pixels", 180, "--out", path)


def analytic(runner, objects, started, document=DOCUMENT, quick=""):
    """Writes the section into the document, and its pictures into images/ beside it."""
    images = document.parent / "images"
    images.mkdir(parents=True, exist_ok=True)
    random, rotation, search = random_settings(), rotation_settings(), search_settings()
    tables = [table(part, runner) for part in (random, rotation, search)]
    of_random = distributions("analytic_random", random[:3] + search, runner, images)
    of_rotation = distributions("analytic_rotation", rotation[1:7], runner, images)
    picture(images / "perturbed.png", [random[0], random[2], rotation[5], *search], runner)
    figure_1(images / "analytic_exhaustive.png", runner)
    write_section("analytic", f"""
## Sections VI-A and VI-B: analytic perturbations

`scripts/reproduce analytic{quick}`, commit {commit()}, {objects} objects a set, {(time.time() - started) / 60:.0f} minutes.

Every cell names cylinders / prisms / bottles. The reduction is that of mean graspability (kappa) from the originals to the
printable results, ± its 95 % interval over objects, equal random draws before and after; "broken" is the share without a
printable result, which is left out of the other columns. Turn, Hausdorff distance (of the diagonal) and volume are means over
objects; the turn is against the mesh that the algorithm began on (rotation: the decimated one). Cylinders and prisms are made as
in the paper; **the bottles are our own surfaces of revolution, not ShapeNet's**. All objects went through a 32^3 SDF.

### Exhaustive perturbation of a dodecahedron (IV-A, figure 1)

![Antipodal face pairs against iterations, five seeds](images/analytic_exhaustive.png)

36 faces, step 0.1 % of the diagonal, 64 iterations or until no pair has phi below the friction cone. The paper does not say its cone.
With the metric's own (27 degrees) the pairs below the cone fall while others join: faces turned apart by less than 53 degrees still oppose each other.

### Random perturbation (IV-B, VI-A)

{tables[0]}

### Antipodal rotation (IV-C, VI-B)

"1 x": as many iterations as faces, as in the paper.

{tables[1]}

### Search (not in the paper)

{tables[2]}

![Rows of objects, originals first](images/perturbed.png)

From above: originals, random at alpha 10 and 20, rotation at beta 0.075 with 10 x iterations, search at alpha 10 and 20.

Random perturbation and search, then antipodal rotation (`antigrasp figure 3`; in every row the object whose change is nearest to the median):

{of_random}

{of_rotation}
""", document)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="scripts/reproduce")
    parser.add_argument("what", choices=("analytic", "readings", "search"))
    parser.add_argument("--objects", type=int, help=f"objects a set (100; --quick: {QUICK_OBJECTS}; readings: 40; search: 20)")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the runs (runs/analytic)")
    parser.add_argument("--quick", action="store_true",
                        help=f"analytic: {QUICK_OBJECTS} objects a set, ten minutes on two cores, into a page of its own")
    arguments = parser.parse_args(arguments)
    if arguments.quick and arguments.what != "analytic":
        parser.error("--quick is for analytic")
    settings = {"analytic": random_settings() + rotation_settings() + search_settings(),
                "readings": reading_settings(), "search": search_variants()}[arguments.what]
    usual = {"analytic": QUICK_OBJECTS if arguments.quick else 100, "readings": 40, "search": 20}[arguments.what]
    objects = arguments.objects or usual
    started = time.time()
    runner = Runner((arguments.out or pathlib.Path("runs") / arguments.what) / str(objects), objects, settings)
    for kind in SETS:
        runner.prior(kind)
    if arguments.what == "analytic":
        document = runner.out / "analytic.md" if arguments.quick else DOCUMENT
        analytic(runner, objects, started, document, " --quick" if arguments.quick else "")
        print(f"wrote {document}")
    else:
        print(table(settings, runner))


if __name__ == "__main__":
    main()
