"""What each setting of the networks and their training does to episode 0. Called by scripts/reproduce."""
import argparse
import pathlib

from reproduce_document import commit, write_section
from reproduce_runs import (COMPARED, CONFIG, RESULTS, SURFACE_COLUMNS, compare, kappa, kappas, keep, rows_of, shown,
                            surface_cells, surfaces, train)

DOCUMENT = pathlib.Path("docs/training.md")
KIND = "cylinders"
UPDATES = 1500
COMMON = [f"prior.kind={KIND}", "cem.episodes=0", f"cem.prior_iterations={UPDATES}", "cem.samples=500", "cem.keep=100", "cem.control=false",
          "cem.prior_scored=500"]
VARIANTS = {
    "as it is": [],
    "raw distances": ["model.truncation=0", "model.raw_scale=2"],
    "no spectral norm": ["model.spectral_norm=false"],
    "five discriminator steps": ["gan.discriminator_steps=5"],
    "no average of the weights": ["gan.ema=1e-6"],
    "shifts (DiffAugment)": ["gan.augment=shifts"],
    "flips (DiffAugment)": ["gan.augment=flips"],
    "residual blocks in the generator": ["model.block=residual_generator"],
    "shapes judged one by one": ["model.pack=1"],
    "no output blur": ["model.output_blur=false"],
    "no batch norm": ["model.batch_norm=false"],
}


def results_of(variant):
    return RESULTS / "ablation" / variant.replace(" ", "-")


def document():
    columns = ("variant", "rejected", "kappa / prior", *SURFACE_COLUMNS, "near-duplicates")
    lines = [f"| {' | '.join(columns)} |", "| --- " * len(columns) + "|"]
    for variant in VARIANTS:
        rows, seen = rows_of(results_of(variant)), surfaces(results_of(variant), 0)
        if 0 not in rows:
            continue
        prior = kappa(kappas(results_of(variant))[False, 0], "prior")
        duplicates = f"{seen['near_duplicates'][0]:.0%}" if seen else "-"
        lines.append(f"| {variant} | {1 - int(rows[0]['ok']) / int(rows[0]['samples']):.1%} | {shown(prior)} "
                     f"| {surface_cells(seen)} | {duplicates} |")
    table = "\n".join(lines)
    write_section("ablation", f"""
## One setting at a time

`scripts/reproduce ablation`, written at commit {commit()}: episode 0 of cylinders with {CONFIG}, {UPDATES} updates, one setting changed in each
row. Surfaces: {COMPARED} samples against {COMPARED} prior shapes held out ([similarity.md](similarity.md)). One seed.

{table}
""", DOCUMENT)
    print(f"wrote {DOCUMENT}")


def main():
    parser = argparse.ArgumentParser(prog="scripts/reproduce ablation")
    parser.add_argument("--only", choices=list(VARIANTS), help="one variant; several calls may run side by side")
    parser.add_argument("--report", action="store_true", help="train nothing; write what there is into the document")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/ablation"), help="folder of the runs")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for variant, settings in VARIANTS.items():
        folder = arguments.out / variant.replace(" ", "-")
        if not arguments.report and arguments.only in (None, variant):
            train(variant, folder, COMMON + settings)
        if 0 in rows_of(folder) and (arguments.report or not arguments.only):
            compare(folder, 0, KIND, arguments.out)
            keep(folder, results_of(variant))
    if arguments.report or not arguments.only:
        document()


if __name__ == "__main__":
    main()
