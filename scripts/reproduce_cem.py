"""Ways to choose and use elites, over ten episodes from the same networks. Called by scripts/reproduce."""
import argparse
import csv
import math
import pathlib

from reproduce_document import DOCUMENT, IMAGES, call, commit, pyplot, save_figure, write_section
from reproduce_runs import (COMPARED, CONFIG, RESULTS, SAMPLE_SEED, SURFACE_COLUMNS, compare, held_out, kappa, kappas, keep, rows_of, shown,
                            surface_cells, surfaces, train)

EPISODES = 10
KIND = "cylinders"
FRESH_NOISE = 77  # the seed of scores that choose nothing
# Equal evaluations, but for ways that move parts: every episode scores as many samples.
COMMON = [f"prior.kind={KIND}", f"cem.episodes={EPISODES}", "cem.samples=1000", "cem.keep=200", "cem.control=false", "cem.prior_scored=500"]
# All samples go on as themselves.
PARTS = ["cem.mode=latent", "cem.variant=diverse", "cem.spread=95", "cem.step=0.05", "cem.part_step=0.35", "cem.samples=400", "cem.keep=400"]


class Way:
    """How elites are chosen and used, and from which networks: those of a grid's nodes, or solids."""

    def __init__(self, label, colour, settings, solids=False):
        self.label, self.colour, self.solids = label, colour, solids
        self.start = "cylinders-solids" if solids else "cylinders-prior"
        self.config = "configs/solids.toml" if solids else CONFIG
        own = ["model.form=cylinders", "gan.lr_decay_fraction=0", "cem.iterations=200", "run.torch_threads=0"] if solids else ["cem.iterations=250"]
        self.settings = [*COMMON, *own, *settings]


WAYS = {
    "paper": Way("the least graspable of all (V-B)", "#b2182b", []),
    "stratified": Way("the least graspable of every cell of the prior", "#2166ac", ["cem.variant=stratified", "cem.cells=40"]),
    "latent": Way("fixed networks, z drawn around that of the least graspable", "#1b7837", ["cem.mode=latent"]),
    "latent stratified": Way("the same, the least graspable of every cell of the prior", "#7fbf7b",
                             ["cem.mode=latent", "cem.variant=stratified", "cem.cells=40"]),
    "control": Way("random ones", "0.5", ["cem.select=random"]),
    "solids paper": Way("as paper, with networks that draw solids", "#e08214", ["cem.variant=paper"], solids=True),
    "parts": Way("fixed networks of solids; the parts of all samples moved by 12 trials an episode", "#762a83",
                 [*PARTS, "cem.refine_steps=12"], solids=True),
    "parts in niches": Way("the same by 20 trials, which compete by niche: those of 200 shapes of the prior set, drawn anew in every episode", "#1b9e77",
                           [*PARTS, "cem.step=0.02", "cem.refine_steps=20", "cem.refine_niches=200"], solids=True),
    "parts control": Way("the same around random samples, which nothing moves", "0.75", [*PARTS, "cem.select=random"], solids=True),
}


def table(results):
    columns = ("elites", "episode", "kappa / prior", "kappa / control", "rejected", *SURFACE_COLUMNS, "to the nearest prior shape", "QD score")
    lines = [f"| {' | '.join(columns)} |", "| --- " * len(columns) + "|"]
    for way, folder in results.items():
        rows, by = rows_of(folder), kappas(folder, None if "control" in way else results.get("parts control" if WAYS[way].solids else "control"))
        for episode in sorted({0, EPISODES // 2, max(rows)} & set(rows)):
            row, seen = rows[episode], surfaces(folder, episode)
            prior, control = (shown(kappa(by[False, episode], reference)) for reference in ("prior", "control"))
            scored = folder / f"episode_{episode}" / "qd.txt"
            qd = f"{float(scored.read_text()):.2f}" if scored.exists() else "-"
            nearest = f"{seen['nearest_reference'][0]:.3f}" if seen else "-"
            lines.append(f"| {way} | {episode} | {prior} | {control} "
                         f"| {1 - int(row['ok']) / int(row['samples']):.0%} | {surface_cells(seen)} | {nearest} | {qd} |")
    return "\n".join(lines)


def curves(path, folders):
    """Kappa, coverage and what is rejected over episodes."""
    figure, axes = pyplot().subplots(1, 3, figsize=(11, 3.4))
    for way, folder in folders.items():
        rows, by = {e: r for e, r in rows_of(folder).items() if e >= 0}, kappas(folder)
        episodes, colour = sorted(rows), WAYS[way].colour
        values = [kappa(by[False, e], "prior") for e in episodes]
        axes[0].plot(episodes, [k for k, _ in values], color=colour, label=way)
        axes[0].fill_between(episodes, [k - h for k, h in values], [k + h for k, h in values], color=colour, alpha=0.2)
        axes[1].plot(episodes, [100 * float(rows[e]["coverage"]) for e in episodes], color=colour)
        axes[2].plot(episodes, [100 * (1 - int(rows[e]["ok"]) / int(rows[e]["samples"])) for e in episodes], color=colour)
    finish(figure, axes, path, "episode", ("kappa / prior set, 95 %", "COV by network values, %", "rejected, %"))


def front(path, folders):
    """Kappa over what is left of the set: a line a way, a dot an episode, the last one large."""
    figure, axes = pyplot().subplots(1, 3, figsize=(11, 3.4), sharey=True)
    for way, folder in folders.items():
        rows, by = {e: r for e, r in rows_of(folder).items() if e >= 0}, kappas(folder)
        episodes, colour = sorted(rows), WAYS[way].colour
        values = [kappa(by[False, e], "prior")[0] for e in episodes]
        for ax, column, scale in ((axes[0], "coverage", 100), (axes[1], "nna", 1), (axes[2], "duplicates", 100)):
            seen = [scale * float(rows[e][column]) for e in episodes]
            ax.plot(seen, values, color=colour, marker=".", markersize=4, linewidth=0.8, label=way)
            ax.plot(seen[-1:], values[-1:], color=colour, marker="o", markersize=7)
    finish(figure, axes, path, None, ("kappa over COV, %", "kappa over 1-NNA", "kappa over near-duplicates, %"))


def finish(figure, axes, path, label, titles):
    for ax, title in zip(axes, titles):
        ax.set_title(title, fontsize=9)
        if label:
            ax.set_xlabel(label, fontsize=8)
        ax.set_ylim(bottom=0)
        ax.tick_params(labelsize=8)
        ax.spines[["top", "right"]].set_visible(False)
    figure.legend(*axes[0].get_legend_handles_labels(), fontsize=7, frameon=False, loc="lower center", ncol=5)
    save_figure(figure, path, bottom=0.17)


def refresh(way, folder):
    for episode in {0, EPISODES // 2, max(rows_of(folder))}:
        compare(folder, episode, KIND, folder.parent)
        quality_diversity(folder, episode)
    keep(folder, results_of(way))


def quality_diversity(folder, episode):
    """QD score (Pugh et al. 2016) with noise that chose nothing: cells are those of shapes that were held out; a cell counts by how much less
    graspable than the prior set its least graspable sample is, an empty one not at all; the mean over cells, 0 to 1."""
    import h5py
    import numpy

    result = folder / f"episode_{episode}" / "qd.txt"
    if result.exists():
        return
    samples, scores = folder.parent / f"qd-{folder.name}.h5", folder.parent / f"qd-{folder.name}.csv"
    call("sample", folder / f"episode_{episode}/checkpoint.pt", "--count", 500, "--seed", SAMPLE_SEED + 1, "--out", samples)
    call("evaluate", samples, "--seed", FRESH_NOISE, "--out", scores)
    held = [numpy.clip(h5py.File(file)["sdf"][:].reshape(-1, 32**3).astype("f4"), -0.1, 0.1)
            for file in (held_out(KIND, folder.parent, COMPARED, 2), samples)]
    nearest = ((held[0] ** 2).sum(1) - 2 * held[1] @ held[0].T).argmin(1)
    rows = list(csv.DictReader(open(scores)))
    prior = [float(r["graspability"]) for r in csv.DictReader(open(folder / "prior_scores.csv")) if r["graspability"]]
    least = {}
    for row, cell in zip(rows, nearest):
        if row["status"] == "ok":
            least[cell] = min(least.get(cell, math.inf), float(row["graspability"]))
    worth = sum(max(0.0, 1 - value * len(prior) / sum(prior)) for value in least.values()) / COMPARED
    result.write_text(f"{worth:.4f}\n")
    for file in (samples, scores):
        file.unlink()


def results_of(way):
    return RESULTS / "cem" / way.replace(" ", "-")


def document():
    results = {way: results_of(way) for way in WAYS if rows_of(results_of(way))}
    curves(IMAGES / "cem_variants.png", results)
    front(IMAGES / "cem_front.png", results)
    ways = "\n".join(f"- **{way}**: {WAYS[way].label}" for way in results)
    write_section("cem", f"""
## Ways to choose elites, over ten episodes

`scripts/reproduce cem`, written at commit {commit()}. Cylinders, from the pretrained networks `cylinders-prior`, solids from `cylinders-solids`; 1,000 samples and 200 elites in every
episode, 250 updates where networks are retrained (solids: 200); where parts are moved 400 samples and 12 trials of each (in niches 20, and second looks). Surfaces: {COMPARED} samples against {COMPARED} prior shapes held out
([similarity.md](similarity.md)); the numbers are kept in [results/cem](results/cem).

{ways}

{table(results)}

![Kappa, coverage and rejection over ten episodes](images/cem_variants.png)

![Kappa over coverage, over 1-NNA and over near-duplicates](images/cem_front.png)

The front: a line a way, a dot an episode, the last one large; COV, 1-NNA and near-duplicates by network values, of 500 samples (parts: 400). Kappa low and what is beside it unchanged would be at the lower right of the left picture, at the lower left of
the others.
""")
    print(f"wrote {DOCUMENT}")


def main():
    parser = argparse.ArgumentParser(prog="scripts/reproduce cem")
    parser.add_argument("--only", choices=list(WAYS), help="one way; several calls may run side by side")
    parser.add_argument("--report", action="store_true", help="train nothing; write what there is into the document")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/cem"), help="folder of the runs")
    arguments = parser.parse_args()
    folders = {way: arguments.out / way.replace(" ", "-") for way in WAYS}
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, way in WAYS.items():
        if not arguments.report and arguments.only in (None, name):
            train(f"{name}: {way.label}", folders[name], way.settings, extra=["--from", way.start], config=way.config)
    if arguments.report or not arguments.only:
        for way, folder in folders.items():
            if rows_of(folder):
                refresh(way, folder)
        document()


if __name__ == "__main__":
    main()
