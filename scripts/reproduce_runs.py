"""Training runs behind scripts/reproduce: starting them, and reading what they wrote."""
import csv
import pathlib
import shutil
import subprocess
import sys

from reproduce_document import BINARY, call, means

CONFIG = "configs/reproduction.toml"
COMPARED = 200  # objects a side of the comparison with shapes that were held out
SAMPLE_SEED = 1000
RESULTS = pathlib.Path("docs/results")  # the numbers behind the tables, kept when the runs are gone


def train(label, folder, settings, extra=(), config=CONFIG):
    """Runs or goes on; the program shows its own progress. Ctrl-C leaves a run that goes on the next time."""
    flags = [flag for setting in settings for flag in ("--set", setting)]
    print(label, flush=True)
    code = subprocess.run([BINARY, "train", config, "--or-resume", "--out", folder, *extra, *flags]).returncode
    if code:
        sys.exit(code)


def rows_of(folder):
    file = folder / "statistics.csv"
    return {int(r["stage"]): r for r in csv.DictReader(open(file))} if file.exists() else {}


def keep(folder, results):
    """Copies the tables of a run and its control beside the documents, under the same names."""
    for where, to in ((folder, results), (folder / "control", results / "control")):
        for file in [where / "statistics.csv", *where.glob("episode_*/compare.csv"), *where.glob("episode_*/qd.txt")]:
            if file.exists():
                target = to / file.relative_to(where)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, target)


def kappas(folder, control=None):
    """{(of the control, stage): what `info --csv` says of it}. `control`: another run instead of the folder's own."""
    flags = ("--control", control) if control else ()
    return {(row["control"] == "1", int(row["stage"])): row for row in means(folder, *flags)}


def kappa(row, reference):
    """(kappa, its half width) against "prior", "episode_0" or "control"; None where there is no such reference."""
    value = row[f"kappa_{reference}"]
    return (float(value), float(row[f"kappa_{reference}_half_width_95"])) if value else None


def shown(value):
    return f"{value[0]:.2f} ±{value[1]:.2f}" if value else "-"


def held_out(kind, out, count, seed):
    file = out / f"{kind}-{seed}-{count}.h5"
    if not file.exists():
        call("dataset", "make", kind, "--seed", seed, "--count", count, "--out", file)
    return file


def compare(folder, episode, kind, out):
    """Compares an episode's samples with held-out shapes on their surfaces, unless that is done."""
    result = folder / f"episode_{episode}" / "compare.csv"
    if result.exists() or not (result.parent / "scores.csv").exists():
        return
    samples = out / f"samples-{folder.name}-{episode}.h5"
    print(f"comparing {folder}, episode {episode}", flush=True)
    call("sample", folder / f"episode_{episode}/checkpoint.pt", "--count", int(1.6 * COMPARED), "--seed", SAMPLE_SEED, "--out", samples)
    call("compare", samples, held_out(kind, out, COMPARED, 2), "--count", COMPARED, "--out", result)
    samples.unlink()


def surfaces(results, episode):
    """What compare found: {measure: (of the samples, of the reference)}; empty where it was not run."""
    file = results / f"episode_{episode}" / "compare.csv"
    if not file.exists():
        return {}
    return {r["measure"]: (float(r["samples"] or "nan"), float(r["reference"] or "nan")) for r in csv.DictReader(open(file))}


# Column: (measure, format, whether as a share of the reference's). Runs of before a measure was taken have "-".
SURFACES = {"COV": ("coverage", ".0%", False), "1-NNA": ("nna", ".2f", False), "with normals": ("nna_normals", ".2f", False),
            "MMD": ("matching", ".3f", False), "near-duplicates": ("near_duplicates", ".0%", False), "diversity": ("diversity", ".2f", False),
            "Vendi score": ("vendi", ".0f", False), "roughness, degrees": ("roughness", ".1f", False),
            "flat edges, of the prior's": ("flat_share", ".2f", True), "creases, of the prior's": ("crease_share", ".2f", True)}
SURFACE_COLUMNS = tuple(SURFACES)


def surface_cells(measured):
    """The cells of SURFACE_COLUMNS."""

    def cell(measure, form, of_reference):
        if measure not in measured:
            return "-"
        samples, reference = measured[measure]
        return format(samples / reference if of_reference else samples, form)

    return " | ".join(cell(*column) for column in SURFACES.values())
