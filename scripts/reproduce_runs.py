"""Training runs behind scripts/reproduce: starting them, and reading what they wrote."""
import csv
import subprocess
import sys

import numpy as np

from reproduce_document import BINARY, call

CONFIG = "configs/reproduction.toml"
COMPARED = 200  # objects a side of the comparison with shapes that were held out
SAMPLE_SEED = 1000


def train(label, folder, settings, extra=()):
    """Runs or goes on; the program shows its own progress. Ctrl-C leaves a run that goes on the next time."""
    flags = [flag for setting in settings for flag in ("--set", setting)]
    print(label, flush=True)
    code = subprocess.run([BINARY, "train", CONFIG, "--or-resume", "--out", folder, *extra, *flags]).returncode
    if code:
        sys.exit(code)


def rows_of(folder):
    file = folder / "statistics.csv"
    return {int(r["stage"]): r for r in csv.DictReader(open(file))} if file.exists() else {}


def ratio(row, reference):
    """Mean graspability by a reference's, with its 95 % half width (delta method, independent means)."""
    a, b = float(row["graspability"]), float(reference["graspability"])
    da, db = float(row["half_width_95"]), float(reference["half_width_95"])
    return a / b, a / b * np.hypot(da / a, db / b)


def shown(value):
    return f"{value[0]:.2f} ±{value[1]:.2f}"


def held_out(kind, out, count, seed):
    file = out / f"{kind}-{seed}-{count}.h5"
    if not file.exists():
        call("dataset", "make", kind, "--seed", seed, "--count", count, "--out", file)
    return file


def surfaces(folder, episode, kind, out):
    """The comparison of an episode's samples with held-out shapes, on their surfaces: {measure: (samples, reference)}."""
    result = folder / f"episode_{episode}" / "compare.csv"
    if not result.exists():
        samples = out / "samples.h5"
        print(f"comparing {folder}, episode {episode}", flush=True)
        call("sample", folder / f"episode_{episode}/checkpoint.pt", "--count", int(1.6 * COMPARED), "--seed", SAMPLE_SEED, "--out",
             samples)
        call("compare", samples, held_out(kind, out, COMPARED, 2), "--train", folder / "prior.h5", "--count", COMPARED, "--out",
             result)
    return {r["measure"]: (r["samples"], r["reference"]) for r in csv.DictReader(open(result))}
