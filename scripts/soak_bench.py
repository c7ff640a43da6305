"""What the trials of scripts/soak share: the program, a folder to work in, the undisturbed results."""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from reproduce_document import BINARY

# A run of the smoke configuration with a checkpoint every fourth update.
TRAIN = ["train", "configs/smoke.toml", "--seed", "3"] + [
    f"--set={setting}" for setting in ("cem.prior_iterations=16", "cem.iterations=6", "cem.checkpoint_every=4",
                                       "cem.samples=16", "cem.keep=6", "cem.compared=8", "prior.count=24")]
# Of a run folder, these hold the time of day; the lock holds nothing.
WITH_TIME = ("provenance.toml", "tensorboard", ".lock")
LIMIT_S = 300
MEMORY = 12 << 30


class Fault(Exception):
    """What the program did and should not have done."""


class Bench:
    def __init__(self, folder):
        self.folder = folder.resolve()
        self.program = pathlib.Path(BINARY).resolve()
        self.counts = {}
        self.inputs = self.folder / "inputs"
        self.reference = self.folder / "reference"

    def count(self, what, number=1):
        self.counts[what] = self.counts.get(what, 0) + number

    def prepare(self):
        """Input files and the results of undisturbed runs; made once, by this program."""
        stamp = self.folder / "made-by.json"
        programs = [self.program, self.program.with_name("antigrasp-networks")]
        states = [program.stat() for program in programs if program.exists()]
        made_by = [str(self.program), *((state.st_size, state.st_mtime_ns) for state in states)]
        made_by = json.loads(json.dumps(made_by))
        if stamp.exists() and (kept := json.loads(stamp.read_text()))["program"] == made_by:
            self.seconds = kept["seconds"]
            return
        shutil.rmtree(self.folder, ignore_errors=True)
        self.inputs.mkdir(parents=True)
        self.reference.mkdir()
        self.must("dataset", "make", "cylinders", "--count", "12", "--out", self.inputs / "set.h5")
        self.must("remesh", self.inputs / "set.h5", "--out", self.inputs / "meshes", "--format", "stl")
        self.must("remesh", self.inputs / "set.h5", "--out", self.inputs / "others", "--format", "obj")
        self.seconds = {"train": self.must(*TRAIN, "--out", self.reference / "train")}
        for name, command in self.writers().items():
            self.seconds[name] = self.must(*command, self.reference / name)
        stamp.write_text(json.dumps({"program": made_by, "seconds": self.seconds}))

    def writers(self):
        """Every command that writes, without the path it writes to (the last argument)."""
        run, meshes, sdf = self.reference / "train", self.inputs / "meshes", self.inputs / "set.h5"
        return {
            "make.h5": ["dataset", "make", "bottles", "--count", "40", "--out"],
            "import.h5": ["dataset", "import", meshes, "--out"],
            "remesh": ["remesh", sdf, "--overwrite", "--out"],
            "sample.h5": ["sample", run / "checkpoint.pt", "--count", "24", "--out"],
            "generator.pt": ["generator", run / "checkpoint.pt", "--out"],
            "evaluate.csv": ["evaluate", meshes, "--out"],
            "grasps.csv": ["evaluate", sdf, "--grasps"],
            "poses.csv": ["poses", meshes, "--out"],
            "perturb": ["perturb", "random", meshes, "--overwrite", "--out"],
            "export": ["export", sdf, "--overwrite", "--out"],
            "compare.csv": ["compare", sdf, meshes, "--out"],
            "sheet.png": ["sheet", sdf, "--out"],
            "shape.stl": ["shape", "cuboctahedron", "--phi", "15", "--out"],
            "report.html": ["report", run, "--out"],
        }

    def start(self, *command, limits=True, **more):
        def limit():
            if limits:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            os.setpgrp()

        return subprocess.Popen([str(self.program), *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                stdin=subprocess.DEVNULL, text=True, errors="replace", preexec_fn=limit, **more)

    def finish(self, process, limit=LIMIT_S):
        """Exit status, standard output and standard error."""
        try:
            out, err = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            raise Fault(f"not done after {limit} s: {' '.join(map(str, process.args))}")
        return process.returncode, out, err

    def run(self, *command, limit=LIMIT_S, **more):
        return self.finish(self.start(*command, **more), limit)

    def must(self, *command, **more):
        begun = time.monotonic()
        code, _, err = self.run(*command, **more)
        if code:
            raise Fault(f"exit {code}: {' '.join(map(str, command))}\n{err[-1500:]}")
        return time.monotonic() - begun

    def scratch(self, name):
        path = self.folder / "trial"
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir()
        return path / name


def refuses_well(code, err, allowed=(0, 1, 2)):
    """Ends by itself, and says why when it fails: in a line, not in a stack."""
    if code not in allowed:
        raise Fault(f"exit {code}, expected one of {allowed}\n{err[-1500:]}")
    if code and not err.strip():
        raise Fault(f"exit {code} without a word")
    for word in ("terminate called", "Sanitizer", "CHECK failed", "std::", "c10::", "bad_alloc"):
        if word in err:
            raise Fault(f"'{word}' in the message\n{err[-1500:]}")


def timeless(path):
    """The bytes of a file; of a table without the seconds that its rows took."""
    data = path.read_bytes()
    header = data.split(b"\n", 1)[0].split(b",")
    if path.suffix != ".csv" or b"seconds" not in header:
        return data
    column = header.index(b"seconds")
    rows = [line.split(b",") for line in data.split(b"\n")]
    return b"\n".join(b",".join(cells[:column] + cells[column + 1:]) for cells in rows)


def files_of(path):
    """Relative name -> bytes, less what holds a time. A file's own name is ''."""
    if path.is_file():
        return {"": timeless(path)}
    return {str(p.relative_to(path)): timeless(p) for p in sorted(path.rglob("*"))
            if p.is_file() and not any(part in WITH_TIME for part in p.relative_to(path).parts)}


def same_bytes(path, reference):
    ours, theirs = files_of(path), files_of(reference)
    if ours.keys() != theirs.keys():
        raise Fault(f"{path}: files differ from an undisturbed run's: {sorted(ours.keys() ^ theirs.keys())}")
    for name, data in theirs.items():
        if ours[name] != data:
            raise Fault(f"{path / name}: other bytes than {reference / name}")


def whole_or_absent(path, reference):
    """What lies under its final name has its final bytes. Hidden files are a killed writer's leavings."""
    if not path.exists():
        return
    theirs = files_of(reference)
    for name, data in files_of(path).items():
        if any(part.startswith(".") for part in pathlib.PurePath(name).parts):
            continue
        if name not in theirs or theirs[name] != data:
            raise Fault(f"{path / name}: half-written")
