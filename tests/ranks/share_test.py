"""Commands on meshes as jobs of several processes: the files and the text are those of one process, but for wall times.
share_test.py ANTIGRASP CASE"""
import csv
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAM, CASE = sys.argv[1:]
QUICK = ["--num-grasps", "6", "--num-draws", "3", "--max-attempts", "200"]
VARIABLES = ("RANK", "WORLD_SIZE", "LOCAL_WORLD_SIZE", "MASTER_ADDR", "MASTER_PORT")


def environment(**more):
    return {**{k: v for k, v in os.environ.items() if k not in VARIABLES}, **{k: str(v) for k, v in more.items()}}


def run(*arguments, **more):
    return subprocess.run([PROGRAM, *map(str, arguments)], env=environment(), capture_output=True, text=True, **more)


def ranks(size, arguments, **more):
    """A process a rank, as any launcher starts them. `arguments`: of a rank; `more` variables."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    shared = {"WORLD_SIZE": size, "LOCAL_WORLD_SIZE": size, "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": port, **more}
    return [subprocess.Popen([PROGRAM, *map(str, arguments(rank))], env=environment(RANK=rank, **shared), stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True) for rank in range(size)]


def objects(folder, count=9):
    """Prisms and cylinders, and a mesh that is none."""
    for kind in ("prisms", "cylinders"):
        run("dataset", "make", kind, "--count", (count + 1) // 2, "--resolution", 16, "--out", folder / f"{kind}.h5", check=True)
        run("remesh", folder / f"{kind}.h5", "--out", folder / "meshes" / kind, check=True)
    (folder / "meshes" / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    return folder / "meshes"


def without_times(path):
    """The bytes of a file, a table without its column of wall times."""
    if path.suffix != ".csv":
        return path.read_bytes()
    rows = list(csv.reader(path.open(newline="")))
    times = [i for i, name in enumerate(rows[0]) if name == "seconds"]
    return [[cell for i, cell in enumerate(row) if i not in times] for row in rows]


def expect_equal(one, other):
    files = [{p.relative_to(root) for p in root.rglob("*") if p.is_file()} for root in (one, other)]
    assert files[0] == files[1] and files[0], files
    differ = [str(name) for name in files[0] if without_times(one / name) != without_times(other / name)]
    assert not differ, differ


def same(folder, *arguments):
    """The command alone, of two processes and of three: OUT in the arguments is a folder of each."""
    texts = []
    for size in (1, 2, 3):
        out = folder / f"of{size}"
        out.mkdir(exist_ok=True)
        call = [str(a).replace("OUT", str(out)) for a in arguments] + (["--threads", "1", "--processes", size] if size > 1 else [])
        done = run(*call)
        if "built without MuJoCo" in done.stderr:
            sys.exit(77)
        assert done.returncode == 0, done.stderr
        said = [done.stdout, *re.findall(r"^\d+ candidate grasps: .*", done.stderr, re.M)]
        texts.append(re.sub(r"[0-9.]+ s of one thread", "", "\n".join(said).replace(str(out), "OUT")))
        if size > 1:
            assert "sent " in done.stderr and "(rank 1" not in done.stderr, done.stderr
            expect_equal(folder / "of1", out)
    assert texts[0] == texts[1] == texts[2], texts


def evaluate(folder):
    meshes = objects(folder)
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/scores.csv", "--grasps", "OUT/grasps.csv", "--baseline", meshes)
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/hardest.csv", "--hardest", 3)
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/scores.csv", "--grasps", "OUT/tried", "--grasp-format",
         "isaac", "--trial", "six-ways", "--draws", 2)
    given = folder / "given.csv"
    given.write_bytes((folder / "of1" / "grasps.csv").read_bytes())
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/given.csv", "--grasps-in", given, "--grasps", "OUT/given", "--grasp-format",
         "graspgen")


def judged(folder):
    """Each rank has a judge of its own."""
    meshes = objects(folder)
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/scores.csv", "--judge", "trial", "--draws", 2)
    judge = folder / "judge.py"
    judge.write_text("import json, os, sys\nopen(sys.argv[1] + '/' + str(os.getpid()), 'w')\n"
                     "assert not {'RANK', 'WORLD_SIZE'} & set(os.environ)\n"
                     "for line in sys.stdin:\n    asked = json.loads(line)\n"
                     "    print(json.dumps({'id': asked['id'], 'score': len(asked['name']) / 7}), flush=True)\n")
    (folder / "started").mkdir()
    same(folder, "evaluate", meshes, *QUICK, "--out", "OUT/program.csv", "--judge", f"python3 {judge} {folder}/started")
    assert len(list((folder / "started").iterdir())) > 3


def trial(folder):
    meshes = objects(folder, 5)
    same(folder, "trial", meshes, *QUICK, "--draws", 2, "--out", "OUT/trial")
    same(folder, "trial", meshes, "--baseline", meshes, *QUICK, "--draws", 1, "--friction", 0.4, "--out", "OUT/pairs")
    same(folder, "trial", meshes, *QUICK, "--engine", "model", "--series", 2, "--out", "OUT/model.csv")


def perturb(folder):
    meshes = objects(folder, 5)
    same(folder, "perturb", "random", meshes, *QUICK, "--iterations", 20, "--history", "--out", "OUT/random")
    same(folder, "perturb", "search", meshes, *QUICK, "--steps", 2, "--out", "OUT/search")


def dataset(folder):
    same(folder, "dataset", "make", "prisms", "--count", 40, "--resolution", 16, "--out", "OUT/set.h5")
    meshes = objects(folder)
    lines = next((meshes / "prisms").glob("*.obj")).read_text().splitlines()
    large = [" ".join(["v", *(str(100 * float(x)) for x in line.split()[1:4])]) if line.startswith("v ") else line for line in lines]
    (meshes / "large.obj").write_text("\n".join(large) + "\n")
    for scale in ("set", "each"):  # with an open one, and one that is too large for a set of one factor
        same(folder, "dataset", "import", meshes, "--scale", scale, "--resolution", 16, "--out", f"OUT/{scale}.h5", "--report", f"OUT/{scale}.csv")


def compare(folder):
    for kind, seed in (("prisms", 1), ("cylinders", 2), ("prisms", 3)):
        run("dataset", "make", kind, "--count", 12, "--seed", seed, "--resolution", 16, "--out", folder / f"{kind}{seed}.h5", check=True)
    sets = [folder / "prisms1.h5", folder / "cylinders2.h5"]
    same(folder, "compare", *sets, "--points", 64, "--train", folder / "prisms3.h5", "--out", "OUT/compared.csv")
    same(folder, "compare", *sets, "--points", 64, "--normals", 0)


def launchers(folder):
    """By the environment, threads of another number on every rank; the others show nothing."""
    meshes = objects(folder)
    call = ["evaluate", meshes, *QUICK]
    run(*call, "--out", folder / "one.csv", check=True)
    job = ranks(3, lambda rank: [*call, "--threads", rank + 1, "--out", folder / f"of{rank}.csv"])
    texts = [process.communicate() for process in job]
    assert [process.returncode for process in job] == [0, 0, 0], texts
    assert without_times(folder / "one.csv") == without_times(folder / "of0.csv")
    assert not (folder / "of1.csv").exists()
    assert texts[1] == texts[2] == ("", ""), texts


def refused(folder):
    """Other options, other files, and what one object or all are refused for: before anything is written, in a line of one rank."""
    meshes = objects(folder, 3)
    out = folder / "never.csv"

    def refusal(arguments, code):
        job = ranks(2, arguments)
        texts = [process.communicate()[1] for process in job]
        assert [process.returncode for process in job] == [code, code], texts
        lines = [line for text in texts for line in text.splitlines() if line.startswith("antigrasp (rank ")]
        assert len(lines) == 1 and not out.exists(), texts
        return lines[0].removeprefix("antigrasp (")

    assert refusal(lambda rank: ["evaluate", meshes, "--seed", 7 + rank, "--out", out], 2).endswith(
        "rank 1 has --seed 8 (start of the job): expected what rank 0 has: --seed 7")
    assert f"rank 1 has trial {meshes}/prisms" in refusal(lambda rank: ["trial", (meshes, meshes / "prisms")[rank], "--out", out], 2)
    damaged = folder / "damaged.h5"
    damaged.write_bytes((folder / "prisms.h5").read_bytes()[:-3000])
    for arguments in (["evaluate", damaged, *QUICK], ["evaluate", folder / "none"], ["evaluate", meshes, "--no-such-option"],
                      ["perturb", "random", meshes, "--alpha", "x"]):
        alone = run(*arguments, "--out", out)
        line = refusal(lambda rank: [*arguments, "--out", out], alone.returncode)
        assert line.startswith("rank 0 on ") and line.endswith(alone.stderr.removeprefix("antigrasp: ").strip()), (line, alone.stderr)
    # One that fails before it meets the others.
    line = refusal(lambda rank: ["evaluate", meshes, *(["--no-such-option"] if rank == 1 else []), "--out", out], 2)
    assert line.startswith("rank 1 on ") and "no option --no-such-option" in line, line
    assert not list(folder.glob("*.tmp*")), list(folder.iterdir())


def interrupted(folder):
    """Ctrl-C on rank 0 ends all; a trial keeps what it has, and a job of another size goes on to the same bytes."""
    meshes, out = objects(folder, 5), folder / "trial"
    call = ["trial", meshes, *QUICK, "--draws", 20]
    job = ranks(2, lambda rank: [*call, "--threads", 1, "--out", out])
    begin = time.monotonic()
    while not list(folder.glob("**/executions.csv*")) and not list(folder.glob("**/.*")):
        assert job[0].poll() is None and time.monotonic() - begin < 60, job[0].communicate()
        time.sleep(0.02)
    time.sleep(0.3)
    job[1].send_signal(signal.SIGINT)  # which it does not hear
    job[0].send_signal(signal.SIGINT)
    texts = [process.communicate() for process in job]
    assert [process.returncode for process in job] in ([130, 0], [0, 0]), texts
    run(*call, "--out", folder / "one", check=True)
    run(*call, "--processes", 3, "--out", out, *(["--overwrite"] if job[0].returncode == 0 else []), check=True)
    expect_equal(folder / "one", out)


def worked(process):
    """Seconds of a processor."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def killed(folder):
    """A rank that is gone ends the others when it has not been heard for some time, and nothing is half-written."""
    meshes, out = objects(folder), folder / "scores.csv"
    job = ranks(2, lambda rank: ["evaluate", meshes, "--num-grasps", 100000, "--max-attempts", 1000000, "--threads", 1, "--out", out],
                ANTIGRASP_LOST_AFTER=5)
    while worked(job[1]) < 3.0:  # the start takes one
        assert job[0].poll() is None, job[0].communicate()
        time.sleep(0.05)
    job[1].kill()
    begin = time.monotonic()
    text = job[0].communicate()[1]
    assert job[0].returncode == 1 and time.monotonic() - begin < 60, text
    assert re.search(r"\(rank 0 on .*\): rank 1 is gone: no sign of it for [5-9] s; what was saved stays", text) and not out.exists(), text


with tempfile.TemporaryDirectory() as temporary:
    cases = (evaluate, judged, trial, perturb, dataset, compare, launchers, refused, interrupted, killed)
    {f.__name__: f for f in cases}[CASE](pathlib.Path(temporary))
