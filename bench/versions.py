"""Two builds of antigrasp in turn in one run: bench/versions.py OLD NEW [ROUNDS [OBJECTS]]. Scoring on one thread, cylinders, prisms and
bottles; a search on some of them; two sets compared at 1,024 and 4,096 points. A row a piece of work: processor seconds of both (medians over rounds) and
the median over rounds of their ratio, above 1 = NEW is faster. `objects` is the time of scoring alone that the tables of scores have: of every object the
least of all rounds, since a busy machine only adds, and the median ratio over objects. Each program makes its own sets (format and names may have changed),
of the same shapes."""
import csv
import os
import resource
import statistics
import subprocess
import sys
import tempfile

PROGRAMS = [os.path.abspath(path) for path in sys.argv[1:3]]
ROUNDS = int(sys.argv[3]) if len(sys.argv) > 3 else 3
OBJECTS = int(sys.argv[4]) if len(sys.argv) > 4 else 300
KINDS = ("cylinders", "prisms", "bottles")


def processor_seconds(call, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(call, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(call)}: {done.stderr.splitlines()[-1] if done.stderr else done.returncode}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def make_sets(program, folder):
    for kind in KINDS:
        for count, name in ((OBJECTS, kind), (max(OBJECTS // 30, 2), f"few-{kind}")):
            processor_seconds([program, "dataset", "make", kind, "--count", str(count), "--seed", "11", "--out", f"{name}.h5"], folder)


WORK = {f"evaluate {kind}": ["evaluate", f"{kind}.h5", "--threads", "1", "--out", f"{kind}.csv"] for kind in KINDS}
WORK["perturb search"] = ["perturb", "search", "few-cylinders.h5", "--threads", "1", "--out", "search-ROUND"]
for points in (1024, 4096):
    WORK[f"compare {points}"] = ["compare", "cylinders.h5", "bottles.h5", "--points", str(points), "--threads", "1"]


def words_of(program, words, number):
    """Without what older programs do not have: distances with normals."""
    plain = ["--normals", "0"] if words[0] == "compare" and "--normals" in helps[program] else []
    return [program, *(word.replace("ROUND", str(number)) for word in words), *plain]


def scoring(folder, kind):
    with open(os.path.join(folder, f"{kind}.csv"), encoding="utf-8") as file:
        return [float(row["seconds"]) for row in csv.DictReader(file)]


def row(name, old, new, ratio):
    print(f"| {name} | {old:.4g} | {new:.4g} | {ratio:.2f} |", flush=True)


helps = {program: subprocess.run([program, "compare", "--help"], capture_output=True, text=True).stdout for program in PROGRAMS}
with tempfile.TemporaryDirectory() as top:
    folders = [os.path.join(top, name) for name in ("old", "new")]
    for program, folder in zip(PROGRAMS, folders):
        os.mkdir(folder)
        make_sets(program, folder)
    took = {name: ([], []) for name in WORK}
    objects = {kind: (None, None) for kind in KINDS}
    for number in range(ROUNDS):
        for name, words in WORK.items():
            for which, (program, folder) in enumerate(zip(PROGRAMS, folders)):
                took[name][which].append(processor_seconds(words_of(program, words, number), folder))
        for kind in KINDS:
            fresh = [scoring(folder, kind) for folder in folders]
            objects[kind] = [now if least is None else list(map(min, least, now)) for least, now in zip(objects[kind], fresh)]
    print("| | old, s | new, s | times as fast |\n| --- | --- | --- | --- |")
    for name, (old, new) in took.items():
        row(name, statistics.median(old), statistics.median(new), statistics.median(a / b for a, b in zip(old, new)))
    for kind, (old, new) in objects.items():
        row(f"objects: {kind}", sum(old), sum(new), statistics.median(a / b for a, b in zip(old, new) if b > 0))
