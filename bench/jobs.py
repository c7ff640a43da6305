"""What several processes gain on one machine, in turn in one run: bench/jobs.py ANTIGRASP [ROUNDS].
Prints seconds (medians) and ratios: 2,500 samples drawn and scored, an update at width 32 whose batch is 4 parts, and 500 objects
that `evaluate` scores."""
import os
import re
import statistics
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
ROUNDS = int(sys.argv[2]) if len(sys.argv) > 2 else 3
UPDATES = 8
QUIET = ["run.torch_threads=1", "cem.episodes=0", "cem.control=false", "cem.prior_scored=16"]
SCORING = ["--set", *QUIET, "prior.count=64", "cem.samples=2500", "cem.keep=200"]
TRAINING = ["--from-scratch", "--set", *QUIET, "model.width=32", "model.width_d=16", "gan.micro_batches=4", "cem.samples=16", "cem.keep=8",
            "prior.count=64", f"cem.prior_iterations={UPDATES}"]
# The ways: processes, threads each.
WAYS = {"one process, one thread": (1, 1), "two processes, one thread": (2, 1), "one process, two threads": (1, 2)}


def seconds(call, phase):
    """What the progress line of a phase says that it took."""
    text = subprocess.run(call, check=True, capture_output=True, text=True).stderr
    took = [line for line in re.split(r"[\r\n]", text) if phase in line and "took" in line]
    minutes, rest = re.search(r"took (?:(\d+)m )?([0-9.]+)s", took[-1]).groups()
    return 60 * int(minutes or 0) + float(rest)


def trained(settings):
    def call(folder, processes, threads):
        return [PROGRAM, "train", "configs/retrain.toml", *settings, f"run.threads={threads}", "--overwrite", "--processes", str(processes),
                "--out", os.path.join(folder, "run")]
    return call


def evaluated(folder, processes, threads):
    objects = os.path.join(folder, "objects.h5")
    if not os.path.exists(objects):
        subprocess.run([PROGRAM, "dataset", "make", "prisms", "--count", "500", "--out", objects], check=True, capture_output=True)
    return [PROGRAM, "evaluate", objects, "--threads", str(threads), "--out", os.path.join(folder, "scores.csv"), "--processes",
            str(processes)]


def compare(title, call, phase, scale):
    took = {way: [] for way in WAYS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(ROUNDS):
            for way, (processes, threads) in WAYS.items():
                took[way].append(seconds(call(folder, processes, threads), phase) / scale)
    medians = {way: statistics.median(values) for way, values in took.items()}
    one = medians["one process, one thread"]
    for way, value in medians.items():
        print(f"{title}: {way}: {value:.2f} s, ratio {one / value:.2f}", flush=True)


compare("500 objects evaluated", evaluated, "scoring", 1)
compare("2,500 samples scored", trained(SCORING), "episode 0: scoring", 1)
compare("an update of width 32", trained(TRAINING), "episode 0: training", UPDATES)
