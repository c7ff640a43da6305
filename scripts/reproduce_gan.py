"""Sections VI-C and VI-D with the binary antigrasp: runs, tables, figures. Called by scripts/reproduce."""
import argparse
import pathlib

from reproduce_document import DOCUMENT, IMAGES, call, commit, write_section
from reproduce_runs import CONFIG, RESULTS, SURFACE_COLUMNS, compare, kappa, kappas, keep, rows_of, shown, surface_cells, surfaces, train


WIDE = "configs/reproduction_wide.toml"
SOLIDS = "configs/solids.toml"
BOTTLES = "configs/reproduction_bottles.toml"
FOLDED = "configs/reproduction_bottles_folded.toml"
# Bottles: networks with batch normalisation are folded and trained on by these, one after the other, and at last by FOLDED itself.
FOLDED_BEFORE = [[f"gan.batch={batch}", f"gan.learning_rate_g={rate_g}", f"gan.learning_rate_d={rate_d}",
                  f"cem.prior_iterations={updates}", f"run.seed={seed}"]
                 for batch, rate_g, rate_d, updates, seed in ((64, 2e-4, 2e-4, 2500, 1), (32, 1e-4, 1.5e-4, 3000, 1),
                                                              (64, 1.5e-4, 2e-4, 2300, 1), (64, 1.5e-4, 2e-4, 4500, 11))]
NETWORKS_ONLY = ["cem.episodes=0", "cem.control=false"]


class Run:
    """A CEM + GAN run of the paper: the set, its resampling iterations and the reduction it reports, %."""

    def __init__(self, name, kind, episodes, paper, settings=(), config=CONFIG, start=None, unfolded=None):
        self.name, self.kind, self.episodes, self.paper, self.ships = name, kind, episodes, paper, name == kind
        self.settings, self.config, self.start = [f"prior.kind={kind}", f"cem.episodes={episodes}", *settings], config, start
        self.unfolded = unfolded  # configuration whose networks this one trains on, without their batch normalisation

    def networks(self, arguments):
        """Flags that say what the run begins with: nothing, networks that ship, or new ones, trained here."""
        if not self.start or (arguments.from_scratch and not self.unfolded):
            return []
        if not arguments.from_scratch:
            return ["--from", self.start]
        folder, networks = arguments.out / f"{self.name}-unfolded", arguments.out / f"{self.name}-folded.pt"
        device = ["--device", arguments.device]
        train(f"{self.name}: networks with batch normalisation", folder, NETWORKS_ONLY, extra=device, config=self.unfolded)
        if not networks.exists():
            call("generator", folder, "--fold-batch-norm", "--out", networks)
        for stage, settings in enumerate(FOLDED_BEFORE, 1):
            folder = arguments.out / f"{self.name}-folded-{stage}"
            train(f"{self.name}: folded networks, stage {stage} of {len(FOLDED_BEFORE) + 1}", folder, [*NETWORKS_ONLY, *settings],
                  extra=["--from", networks, "--fine-tune", *device], config=self.config)
            networks = folder / "checkpoint.pt"
        return ["--from", networks, "--fine-tune"]


# The paper's loop: the least graspable of all, networks retrained on them.
SOLIDS_LOOP = ["cem.variant=paper", "gan.lr_decay_fraction=0"]
# As bottles-solids learn (docs/training.md), but for the rates' fall and how long.
TURNED = ["model.form=turned", "model.parts=6", "gan.batch=64", "gan.gradient_penalty=1", "gan.learning_rate_g=5e-4", "gan.learning_rate_d=1e-3"]

RUNS = [Run("cylinders", "cylinders", 3, 22),
        Run("prisms", "prisms", 4, 36, config=WIDE, start="prisms-prior"),
        Run("bottles", "bottles", 5, 17, config=FOLDED, start="bottles-prior", unfolded=BOTTLES),
        Run("cylinders-solids", "cylinders", 3, 22, ["model.form=cylinders", *SOLIDS_LOOP], config=SOLIDS, start="cylinders-solids"),
        Run("prisms-solids", "prisms", 4, 36, SOLIDS_LOOP, config=SOLIDS, start="prisms-solids"),
        Run("bottles-solids", "bottles", 5, 17, [*TURNED, *SOLIDS_LOOP], config=SOLIDS, start="bottles-solids"),
        Run("cylinders-no-spectral-norm", "cylinders", 5, 83, ["model.spectral_norm=false"])]


def rejected(row):
    reasons = [(int(row[r]), r.replace("_", " ")) for r in ("touches_border", "disjoint", "self_intersecting", "empty",
                                                           "gaps", "non_manifold", "non_orientable", "non_finite")]
    total = int(row["samples"]) - int(row["ok"])
    text = ", ".join(f"{count} {reason}" for count, reason in reasons if count)
    return f"{100 * total / int(row['samples']):.1f} %" + (f" ({text})" if text else "")


def stage_table(run, results):
    rows, control = rows_of(results), rows_of(results / "control")
    columns = ("stage", "rejected", "kappa / prior", "kappa / episode 0", "kappa / control", *SURFACE_COLUMNS)
    lines = [f"| {' | '.join(columns)} |", "| --- " * len(columns) + "|"]
    found = kappas(results)
    stages = [("", results, rows, e) for e in sorted(rows) if e >= 0]
    if run.episodes in control:
        stages.append(("control, ", results / "control", control, run.episodes))
    for label, where, table, episode in stages:
        by = [shown(kappa(found[table is control, episode], reference)) for reference in ("prior", "episode_0", "control")]
        lines.append(f"| {label}episode {episode} | {rejected(table[episode])} | {' | '.join(by)} "
                     f"| {surface_cells(surfaces(where, episode))} |")
    first = surfaces(results, 0)
    if first:
        own = {"diversity": "1", "Vendi score": f"{first['vendi'][1]:.0f}", "roughness, degrees": f"{first['roughness'][1]:.1f}"}
        cells = " | ".join(own.get(column, "-") for column in SURFACE_COLUMNS)
        lines.insert(2, f"| prior set | {rejected(rows[-1])} | 1 | - | - | {cells} |")
    return "\n".join(lines)


def reduction(run, results):
    """One sentence: how far kappa fell, beside the paper's number."""
    last, found = max(rows_of(results)), []
    row = kappas(results)[False, last]
    for name, reference in (("the prior set", "prior"), ("episode 0", "episode_0"), ("the control", "control")):
        if last > 0 and kappa(row, reference):
            value, half_width = kappa(row, reference)
            found.append(f"{100 * (1 - value):.0f} ±{100 * half_width:.0f} % against {name}")
    return f"After {last} resampling iterations kappa is lower by {', '.join(found)} (the paper: {run.paper} %)."


def pretrained(runs):
    """The networks that ship: of the prior set and of the last episode, float16."""
    folder = pathlib.Path("checkpoints/pretrained")
    folder.mkdir(parents=True, exist_ok=True)
    for run, runs_folder in runs:
        last = max(rows_of(runs_folder), default=-1)
        if run.ships and last == run.episodes:
            for episode, name in ((0, "prior"), (last, "adversarial"))[1 if run.start else 0:]:
                call("generator", runs_folder / f"episode_{episode}/checkpoint.pt", "--out", folder / f"{run.name}-{name}.pt")


def refresh(run, folder, out):
    """Measures what a run has sampled and keeps the numbers and pictures of it."""
    for episode in sorted(e for e in rows_of(folder) if e >= 0):
        compare(folder, episode, run.kind, out)
    compare(folder / "control", run.episodes, run.kind, out)
    keep(folder, RESULTS / "gan" / run.name)
    call("figure", 4, folder, "--out", IMAGES / f"gan_{run.name}.png")


def document(run):
    """A section of its own, so that each stays when another set is run elsewhere."""
    results = RESULTS / "gan" / run.name
    start = f", from the networks `{run.start}`" if run.start else ""
    write_section(f"gan {run.name}", f"""
### {run.name}

Written at commit {commit()}, [{run.config}](../{run.config}){start}. {reduction(run, results)}

{stage_table(run, results)}

![Graspability and samples of {run.name}](images/gan_{run.name}.png)

`antigrasp figure 4`: from above the prior set, then every episode; the first usable samples of each, nothing picked.
""")
    print(f"wrote {run.name} into {DOCUMENT}")


def main():
    parser = argparse.ArgumentParser(prog="scripts/reproduce gan")
    parser.add_argument("--only", choices=[run.name for run in RUNS], help="one run; several calls may run side by side")
    parser.add_argument("--report", action="store_true", help="train nothing; write what there is into the document")
    parser.add_argument("--from-scratch", action="store_true", help="train episode 0 of every set: hours on a CPU")
    parser.add_argument("--device", default="cpu", help="of the networks: cpu, cuda")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/gan"), help="folder of the runs")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for run in RUNS:
        if not arguments.report and arguments.only in (None, run.name):
            train(f"{run.name}: {run.episodes} resampling iterations and their control", arguments.out / run.name, run.settings,
                  extra=[*run.networks(arguments), "--device", arguments.device], config=run.config)
    if arguments.report or not arguments.only:
        runs = [(run, arguments.out / run.name) for run in RUNS if rows_of(arguments.out / run.name)]
        for run, folder in runs:
            refresh(run, folder, arguments.out)
            document(run)
        pretrained(runs)


if __name__ == "__main__":
    main()
