"""Ways to choose and use elites, over ten episodes from the same networks. Called by scripts/reproduce."""
import argparse
import pathlib

from reproduce_document import DOCUMENT, IMAGES, commit, pyplot, save_figure, write_section
from reproduce_runs import (COMPARED, RESULTS, SURFACE_COLUMNS, compare, kappa, kappas, keep, rows_of, shown, surface_cells,
                            surfaces, train)

EPISODES = 10
KIND = "cylinders"
START = "cylinders-prior"
# Equal evaluations: every episode of every way scores as many samples.
COMMON = [f"prior.kind={KIND}", f"cem.episodes={EPISODES}", "cem.samples=1000", "cem.keep=200", "cem.iterations=250", "cem.control=false",
          "cem.prior_scored=500"]
WAYS = {
    "paper": ("the least graspable of all (V-B)", []),
    "stratified": ("the least graspable of every cell of the prior", ["cem.variant=stratified", "cem.cells=40"]),
    "latent": ("fixed networks, z drawn around that of the least graspable", ["cem.mode=latent"]),
    "latent stratified": ("the same, the least graspable of every cell of the prior",
                          ["cem.mode=latent", "cem.variant=stratified", "cem.cells=40"]),
    "control": ("random ones", ["cem.select=random"]),
}
COLOURS = {"paper": "#b2182b", "stratified": "#2166ac", "latent": "#1b7837", "latent stratified": "#7fbf7b", "control": "0.5"}


def table(results):
    columns = ("elites", "episode", "kappa / prior", "kappa / control", "rejected", *SURFACE_COLUMNS, "to the nearest prior shape")
    lines = [f"| {' | '.join(columns)} |", "| --- " * len(columns) + "|"]
    for way, folder in results.items():
        rows, by = rows_of(folder), kappas(folder, None if way == "control" else results.get("control"))
        for episode in sorted({0, EPISODES // 2, max(rows)} & set(rows)):
            row, seen = rows[episode], surfaces(folder, episode)
            prior, control = (shown(kappa(by[False, episode], reference)) for reference in ("prior", "control"))
            nearest = f"{seen['nearest_reference'][0]:.3f}" if seen else "-"
            lines.append(f"| {way} | {episode} | {prior} | {control} "
                         f"| {1 - int(row['ok']) / int(row['samples']):.0%} | {surface_cells(seen)} | {nearest} |")
    return "\n".join(lines)


def curves(path, folders):
    figure, axes = pyplot().subplots(1, 3, figsize=(10, 3))
    for way, folder in folders.items():
        rows, by = {e: r for e, r in rows_of(folder).items() if e >= 0}, kappas(folder)
        episodes = sorted(rows)
        values = [kappa(by[False, e], "prior") for e in episodes]
        axes[0].plot(episodes, [k for k, _ in values], color=COLOURS[way], label=way)
        axes[0].fill_between(episodes, [k - h for k, h in values], [k + h for k, h in values], color=COLOURS[way], alpha=0.2)
        axes[1].plot(episodes, [100 * float(rows[e]["coverage"]) for e in episodes], color=COLOURS[way])
        axes[2].plot(episodes, [100 * (1 - int(rows[e]["ok"]) / int(rows[e]["samples"])) for e in episodes], color=COLOURS[way])
    for ax, title in zip(axes, ("kappa / prior set, 95 %", "COV by network values, %", "rejected, %")):
        ax.set_title(title, fontsize=9)
        ax.set_xlabel("episode", fontsize=8)
        ax.set_ylim(bottom=0)
        ax.tick_params(labelsize=8)
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].legend(fontsize=8, frameon=False)
    save_figure(figure, path)


def refresh(way, folder):
    for episode in {0, EPISODES // 2, max(rows_of(folder))}:
        compare(folder, episode, KIND, folder.parent)
    keep(folder, results_of(way))


def results_of(way):
    return RESULTS / "cem" / way.replace(" ", "-")


def document():
    results = {way: results_of(way) for way in WAYS if rows_of(results_of(way))}
    curves(IMAGES / "cem_variants.png", results)
    ways = "\n".join(f"- **{way}**: {WAYS[way][0]}" for way in results)
    write_section("cem", f"""
## Ways to choose elites, over ten episodes

`scripts/reproduce cem`, written at commit {commit()}. Cylinders, all from the pretrained networks `{START}`; 1,000 samples and 200 elites in every
episode, 250 updates where networks are retrained. Surfaces: {COMPARED} samples against {COMPARED} prior shapes held out
([similarity.md](similarity.md)); the numbers are kept in [results/cem](results/cem).

{ways}

{table(results)}

![Kappa, coverage and rejection over ten episodes](images/cem_variants.png)
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
    for way, (label, settings) in WAYS.items():
        if not arguments.report and arguments.only in (None, way):
            train(f"{way}: {label}", folders[way], COMMON + settings, extra=["--from", START])
    if arguments.report or not arguments.only:
        for way, folder in folders.items():
            if rows_of(folder):
                refresh(way, folder)
        document()


if __name__ == "__main__":
    main()
