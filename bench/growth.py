"""What the time of every command grows with: bench/growth.py PROGRAM [ONLY]. Each row is a command and one of its measures, which takes a value and then
eight times as much while all else stays: processor seconds of both (the least of three calls), peak memory of both, and the power of the measure that the
times follow, less what the smallest possible call takes. Rows whose command begins with ONLY alone, if given."""
import math
import os
import resource
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(sys.argv[1])
ONLY = sys.argv[2] if len(sys.argv) > 2 else ""
TIMES = 8
# Command, measure, its first value, what the smallest call has instead.
ROWS = [
    ("dataset make cylinders --count N --out OUT.h5", "objects", 100, 1),
    ("dataset import SETN --out OUT.h5", "objects", 12, 1),
    ("evaluate SETN --out OUT.csv", "objects", 12, 1),
    ("evaluate SET12 --num-grasps N --out OUT.csv", "grasps", 50, 1),
    ("evaluate SET12 --num-draws N --out OUT.csv", "draws", 12, 1),
    ("evaluate SET12 --metric settled --num-grasps N --out OUT.csv", "grasps", 25, 1),
    ("compare SET96 SETN", "objects of one set", 12, 1),
    ("compare SET12 SET12B --points N", "points", 512, 1),
    ("perturb search SETN --steps 4 --out OUT", "objects", 1, 0),
    ("perturb search SET1 --steps N --out OUT", "steps", 4, 1),
    ("perturb random SETN --out OUT", "objects", 2, 1),
    ("trial SETN --num-grasps 2 --draws 2 --replays 0 --out OUT.csv", "objects", 4, 1),
    ("trial SET1 --num-grasps N --draws 2 --replays 0 --out OUT.csv", "grasps", 4, 1),
    ("trial SET1 --num-grasps 4 --draws N --replays 0 --out OUT.csv", "draws", 2, 1),
    ("poses SETN --out OUT.csv", "objects", 12, 1),
    ("remesh GRIDSN.h5 --out OUT", "grids", 12, 1),
    ("export SETN --out OUT", "objects", 12, 1),
    ("bundle SETN --out OUT", "objects", 1, 0),
    ("sheet SETN --out OUT.png", "objects", 12, 1),
    ("report SETN --out OUT.html", "objects", 12, 1),
    ("sample prisms-solids --count N --out OUT.h5", "grids", 100, 1),
    ("sample cylinders-prior --count N --out OUT.h5", "grids", 100, 1),
]


def call(words, folder):
    """Processor seconds and peak memory in MB of one call."""
    with open(os.path.join(folder, "said"), "w", encoding="utf-8") as said:
        process = subprocess.Popen([PROGRAM, *words], cwd=folder, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        with open(os.path.join(folder, "said"), encoding="utf-8") as said:
            sys.exit(f"{' '.join(words)}: {said.read().splitlines()[-1:]}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000


class Sets:
    """Meshes, grids: made when a row asks for so many."""

    def __init__(self, folder):
        self.folder, self.calls = folder, 0

    def word(self, word, value):
        self.calls += 1
        word = word.replace("OUT", f"out-{self.calls}")
        if word == "N":
            return str(value)
        if word.startswith("SET"):
            second = word.endswith("B")
            count = value if word == "SETN" else int(word.strip("SETB"))
            return self.meshes(count, 12 if second else 11)
        if word.startswith("GRIDS"):
            return self.grids(value, 11)
        return word

    def grids(self, count, seed):
        name = f"grids-{count}-{seed}.h5"
        if not os.path.exists(os.path.join(self.folder, name)):
            call(["dataset", "make", "prisms", "--count", str(count), "--seed", str(seed), "--out", name], self.folder)
        return name

    def meshes(self, count, seed):
        name = f"meshes-{count}-{seed}"
        if not os.path.exists(os.path.join(self.folder, name)):
            call(["remesh", self.grids(count, seed), "--out", name], self.folder)
        return name


def least(sets, command, value):
    tries = [call([sets.word(word, value) for word in command.split()], sets.folder) for _ in range(3)]
    return min(seconds for seconds, _ in tries), max(memory for _, memory in tries)


def main():
    print(f"| command | grows with | N, s, MB | {TIMES} N, s, MB | power |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        sets = Sets(folder)
        for command, measure, first, smallest in ROWS:
            if not command.startswith(ONLY):
                continue
            base = least(sets, command, smallest)[0] if smallest else 0.0
            low, high = least(sets, command, first), least(sets, command, TIMES * first)
            power = math.log((high[0] - base) / max(low[0] - base, 1e-3)) / math.log(TIMES)
            print(f"| `{command}` | {measure} | {first}: {low[0]:.2f} s, {low[1]:.0f} | {high[0]:.2f} s, {high[1]:.0f} | {power:.2f} |", flush=True)


main()
