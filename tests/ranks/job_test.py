"""Runs as jobs of several processes, started by every launcher that is at hand: the files are those of one process.
job_test.py ANTIGRASP SMOKE_CONFIG CASE; exit code 77 where what the case needs is missing. The case `kills` is no test:
20 random ranks are killed at random times, and the run resumed by another number of processes each time."""
import filecmp
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAM, CONFIG = (os.path.abspath(name) for name in sys.argv[1:3])
CASE = sys.argv[3]
SETTINGS = ["--set", "run.torch_threads=1", "run.threads=1", "gan.micro_batches=4", "cem.episodes=1", "cem.control=false",
            "cem.prior_iterations=20", "cem.samples=12", "cem.keep=4", "cem.prior_scored=4", "cem.compared=8", "prior.count=16",
            "metric.num_grasps=8", "metric.num_draws=3"]
# The time of day, versions and durations.
OTHERS = {"provenance.toml", "tensorboard"}


def call(out, *more):
    return [PROGRAM, "train", CONFIG, *SETTINGS, *more, "--out", str(out)]


def environment(**more):
    names = ("RANK", "WORLD_SIZE", "LOCAL_WORLD_SIZE", "MASTER_ADDR", "MASTER_PORT")
    return {**{k: v for k, v in os.environ.items() if k not in names}, **{k: str(v) for k, v in more.items()}}


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def listens(port):
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


def alone(folder):
    subprocess.run(call(folder / "alone"), check=True, env=environment(), capture_output=True)
    return folder / "alone"


def files(root):
    return {p.relative_to(root) for p in root.rglob("*") if p.is_file() and not OTHERS & set(p.relative_to(root).parts)}


def expect_equal(one, other):
    assert files(one) == files(other), files(one) ^ files(other)
    differ = [str(name) for name in files(one) if not filecmp.cmp(one / name, other / name, shallow=False)]
    assert not differ, differ


def ranks(folder, size, arguments, **variables):
    """A process a rank, as any launcher starts them."""
    shared = {"WORLD_SIZE": size, "LOCAL_WORLD_SIZE": size, "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": free_port(), **variables}
    return [subprocess.Popen(arguments(rank), env=environment(RANK=rank, **shared), cwd=folder, stderr=subprocess.PIPE,
                             stdout=subprocess.DEVNULL, text=True) for rank in range(size)]


def processes(folder):
    one = alone(folder)
    subprocess.run(call(folder / "of3", "--processes", "3"), check=True, env=environment(), capture_output=True)
    expect_equal(one, folder / "of3")


def refined(folder):
    """The prior set and the refining of elites are shared as well."""
    settings = ("--set", "cem.refine_steps=3", "metric.friction=0.25")
    for name, more in (("alone", ()), ("of2", ("--processes", "2"))):
        subprocess.run(call(folder / name, *settings, *more), check=True, env=environment(), capture_output=True)
    expect_equal(folder / "alone", folder / "of2")


def in_niches(folder):
    """Parts that compete by niche: what is judged a second time is a part of what was judged first."""
    settings = ("--set", "model.kind=solids", "model.parts=2", "cem.mode=latent", "cem.part_step=0.3", "cem.refine_steps=3",
                "cem.refine_niches=6", "cem.keep=12")
    for name, more in (("alone", ()), ("of2", ("--processes", "2"))):
        subprocess.run(call(folder / name, *settings, *more), check=True, env=environment(), capture_output=True)
    expect_equal(folder / "alone", folder / "of2")


def by_environment(folder):
    one = alone(folder)
    for process in ranks(folder, 8, lambda rank: call(folder / "eight")):  # twice as many as parts of a batch
        assert process.wait() == 0, process.stderr.read()
    expect_equal(one, folder / "eight")


def mpirun(folder):
    if not shutil.which("mpirun"):
        sys.exit(77)
    one = alone(folder)
    subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", *call(folder / "mpi")], check=True,
                   env=environment(MASTER_PORT=free_port()), capture_output=True)
    expect_equal(one, folder / "mpi")


def torchrun(folder):
    python = "/usr/bin/python3"
    if subprocess.run([python, "-c", "import torch.distributed.run"], capture_output=True).returncode != 0:
        sys.exit(77)
    one = alone(folder)
    # -r 1 -t 1: the default of LibTorch 1.13 fails under Python 3.11.
    subprocess.run([python, "-m", "torch.distributed.run", "--standalone", "--no_python", "--nproc_per_node", "2", "-r", "1", "-t",
                    "1", *call(folder / "torchrun")], check=True, env=environment(), capture_output=True)
    expect_equal(one, folder / "torchrun")


def said(texts):
    """The lines of failures, of all ranks."""
    return [line for text in texts for line in text.splitlines() if line.startswith("antigrasp") and ": sent " not in line
            and ": waiting for " not in line]


def killed(folder):
    """A rank is killed; the others end, and a job of another size goes on to the same bytes."""
    one, out = alone(folder), folder / "killed"
    job = ranks(folder, 3, lambda rank: call(out, "--set", "cem.checkpoint_every=5"), ANTIGRASP_LOST_AFTER=6)
    saved = out / "checkpoint.pt"
    while not saved.exists():
        assert job[0].poll() is None, job[0].stderr.read()
        time.sleep(0.02)
    job[2].send_signal(signal.SIGKILL)
    begin = time.monotonic()
    texts = [process.communicate()[1] for process in job[:2]]
    assert time.monotonic() - begin < 60
    assert [process.returncode for process in job[:2]] == [1, 1], texts
    assert re.fullmatch(r"antigrasp \(rank 0 on .*\): rank 2 is gone: no sign of it for \d+ s; what was saved stays", *said(texts)), texts
    # cem.checkpoint_every is in the configuration; everything else of the run is the same.
    subprocess.run([PROGRAM, "train", "--resume", str(out), "--processes", "2"], check=True, env=environment(), capture_output=True)
    for name in ("episode_1/scores.csv", "statistics.csv", "episode_1/losses.csv"):
        assert filecmp.cmp(one / name, out / name, shallow=False), name


def worked(process):
    """Seconds of a processor."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def phase_of(run):
    if not (run / "prior_scores.csv").exists():
        return "prior set"
    return "episode 1" if (run / "episode_0" / "elites.h5").exists() else "episode 0"


def kills(folder):
    """A row of docs/cluster.md a kill: every third job is killed while it begins, which takes a second of a processor."""
    chance, out, one = random.Random(7), folder / "killed", folder / "alone"
    longer = ("--set", "cem.checkpoint_every=5", "cem.prior_iterations=150", "cem.iterations=100")
    subprocess.run(call(one, *longer), check=True, env=environment(), capture_output=True)
    done, size = 0, 3
    while done < 20:
        saved = (out / "checkpoint.pt").exists()
        early = done % 3 == 0
        when = chance.uniform(*((0.0, 1.0) if early else (1.0, 2.5)))
        victim = chance.randrange(size)
        job = ranks(folder, size, lambda rank: [PROGRAM, "train", "--resume", str(out)] if saved else call(out, *longer))
        while job[victim].poll() is None and worked(job[victim]) < when:
            time.sleep(0.01)
        if job[victim].poll() is not None:
            assert [process.wait() for process in job] == [0] * size, [process.communicate()[1] for process in job]
            expect_equal(one, out)
            print("the run came to its end, with the files of an undisturbed one; it begins anew", flush=True)
            shutil.rmtree(out)
            continue
        job[victim].kill()
        done, begin = done + 1, time.monotonic()
        texts = [process.communicate()[1] for process in job]
        took, codes = time.monotonic() - begin, [process.returncode for process in job]
        lines = said(texts)
        assert took < 60 and codes[victim] == -signal.SIGKILL and all(codes), (took, codes, texts)
        assert size == 1 or lines and all(f"rank {victim} " in line for line in lines), (victim, texts)
        line = lines[0].split("): ", 1)[1] if lines else ""
        phase, killed = "beginning" if early else phase_of(out), f"{victim} of {size}"
        size = chance.choice([n for n in (1, 2, 3) if n != size])
        print(f"| {done} | {killed} | {phase}, {when:.1f} s | {took:.1f} s | {line} | {size} |", flush=True)
    subprocess.run([PROGRAM, "train", "--resume", str(out)], check=True, env=environment(), capture_output=True)
    expect_equal(one, out)
    print(f"{done} kills; the files are those of an undisturbed run")


def killed_at_the_door(folder):
    """Who is killed before the others have heard of it, or while they wait for more, does not keep them, nor does one that stands still."""
    def job(size, started, **more):
        return ranks(folder, started, lambda rank: call(folder / "never"), WORLD_SIZE=size, ANTIGRASP_LOST_AFTER=6)

    early, door, leader, still = job(3, 3), job(3, 2), job(2, 2), job(2, 2)
    early[1].kill()
    leader[0].kill()
    time.sleep(3)
    door[1].kill()
    still[0].send_signal(signal.SIGSTOP)
    begin = time.monotonic()
    texts = [[process.communicate(timeout=50)[1] for process in group] for group in (early, door, leader, still[1:])]
    still[0].kill()
    still[0].wait()
    assert time.monotonic() - begin < 40
    assert [p.returncode for p in (*early, *door, *leader, still[1])] == [1, -9, 1, 1, -9, -9, 1, 1], texts
    lines = [said(group) for group in texts]
    assert [len(group) for group in lines] == [1, 1, 1, 1], texts
    assert re.search(r"\(rank 0 on .* waiting for rank 1 of 3 .*: nobody came for \d+ s", lines[0][0]), texts
    assert re.search(r"\(rank 0 on .* rank 1 is gone: no sign of it for \d+ s|waiting for rank (1, )?2 of 3", lines[1][0]), texts
    assert re.search(r"\(rank 1 on .* rank 0 does not answer at 127.0.0.1|rank 0 is gone", lines[2][0]), texts
    assert re.search(r"\(rank 1 on .* rank 0 is gone: no sign of it for \d+ s|rank 0 does not answer", lines[3][0]), texts


def other_settings(folder):
    """Other settings, and what all or one are refused for: a line of one rank, before anything is written."""
    never = folder / "never"

    def refusal(arguments, speaker):
        job = ranks(folder, 3, arguments)
        texts = [process.communicate()[1] for process in job]
        assert [process.returncode for process in job] == [2, 2, 2], texts
        lines = said(texts)
        assert len(lines) == 1 and lines[0] in texts[speaker] and not never.exists(), texts
        return lines[0].split("): ", 1)[1]

    assert refusal(lambda rank: call(never, "--set", f"cem.keep={8 - rank // 2}"), 0) == (
        "rank 2 has cem.keep = 7 (start of the job): expected what rank 0 has: cem.keep = 8")
    assert refusal(lambda rank: call(never, "--set", "gan.batch=0"), 0).startswith("gan.batch = 0 (--set): expected")
    assert refusal(lambda rank: call(never, "--no-such-option"), 0).startswith("no option --no-such-option")
    assert refusal(lambda rank: call(never, *(["--no-such-option"] if rank > 0 else [])), 1).startswith("no option --no-such-option")


def interrupted(folder):
    """Ctrl-C on rank 0 saves and ends all, also of a job that waits for a rank that never comes."""
    out = folder / "interrupted"
    job = ranks(folder, 2, lambda rank: call(out, "--set", "cem.iterations=100000"))
    while not (out / "episode_0" / "elites.h5").exists():
        assert job[0].poll() is None, job[0].stderr.read()
        time.sleep(0.05)
    job[0].send_signal(signal.SIGINT)
    texts = [process.communicate()[1] for process in job]
    assert [process.returncode for process in job] == [130, 0], texts
    assert (out / "checkpoint.pt").exists()
    port = free_port()
    waits = ranks(folder, 1, lambda rank: call(folder / "waits"), WORLD_SIZE=2, MASTER_PORT=port)[0]
    while not listens(port):
        assert waits.poll() is None, waits.stderr.read()
        time.sleep(0.05)
    waits.send_signal(signal.SIGINT)
    assert waits.wait(timeout=20) == 130


with tempfile.TemporaryDirectory() as temporary:
    {f.__name__: f for f in (processes, refined, in_niches, by_environment, mpirun, torchrun, killed, kills, killed_at_the_door,
                                other_settings, interrupted)}[CASE](
        pathlib.Path(temporary))
