"""Runs as jobs of several processes, started by every launcher that is at hand: the files are those of one process.
job_test.py ANTIGRASP SMOKE_CONFIG CASE; exit code 77 where what the case needs is missing. The case `kills` is no test:
20 random ranks are killed at random times, and the run resumed by another number of processes each time."""
import filecmp
import os
import pathlib
import random
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


def killed(folder):
    """A rank is killed; the others end, and a job of another size goes on to the same bytes."""
    one, out = alone(folder), folder / "killed"
    job = ranks(folder, 3, lambda rank: call(out, "--set", "cem.checkpoint_every=5"))
    saved = out / "checkpoint.pt"
    while not saved.exists():
        assert job[0].poll() is None, job[0].stderr.read()
        time.sleep(0.02)
    job[2].send_signal(signal.SIGKILL)
    begin = time.monotonic()
    texts = [process.communicate()[1] for process in job[:2]]
    assert time.monotonic() - begin < 60
    assert [process.returncode for process in job[:2]] == [1, 1], texts
    assert "(rank 0 on " in texts[0] and "is gone" in texts[0], texts[0]
    # cem.checkpoint_every is in the configuration; everything else of the run is the same.
    subprocess.run([PROGRAM, "train", "--resume", str(out), "--processes", "2"], check=True, env=environment(), capture_output=True)
    for name in ("episode_1/scores.csv", "statistics.csv", "episode_1/losses.csv"):
        assert filecmp.cmp(one / name, out / name, shallow=False), name


def kills(folder):
    chance, out, one = random.Random(7), folder / "killed", folder / "alone"
    longer = ("--set", "cem.checkpoint_every=5", "cem.prior_iterations=200", "cem.iterations=100")
    subprocess.run(call(one, *longer), check=True, env=environment(), capture_output=True)
    done = 0
    while done < 20:
        size = chance.randint(2, 4)
        saved = (out / "checkpoint.pt").exists()
        job = ranks(folder, size, lambda rank: [PROGRAM, "train", "--resume", str(out)] if saved else call(out, *longer))
        time.sleep(chance.uniform(1.0, 6.0))
        victim = chance.randrange(size)
        if job[victim].poll() is None:
            job[victim].kill()
            done += 1
        begin = time.monotonic()
        codes = []
        for process in job:
            try:
                codes.append(process.wait(timeout=60))
            except subprocess.TimeoutExpired:  # killed before anybody had heard of it: the others wait for ten minutes
                process.kill()
                codes.append(process.wait())
        print(f"{done}: rank {victim} of {size} killed, the others ended after {time.monotonic() - begin:.1f} s: {codes}", flush=True)
        if not any(codes):
            assert done > 0, "the run ended before a kill"
            break
    subprocess.run([PROGRAM, "train", "--resume", str(out)], check=True, env=environment(), capture_output=True)
    expect_equal(one, out)
    print(f"{done} kills; the files are those of an undisturbed run")


def killed_at_the_door(folder):
    """Rank 1 of 3 is killed while it waits for rank 2: rank 0 does not wait for ever."""
    job = ranks(folder, 2, lambda rank: call(folder / "never"), WORLD_SIZE=3)
    time.sleep(3)
    job[1].kill()
    text = job[0].communicate(timeout=60)[1]
    assert job[0].returncode == 1 and "rank 1 is gone" in text, text


def other_settings(folder):
    job = ranks(folder, 2, lambda rank: call(folder / "never", "--set", f"cem.keep={8 - rank}"))
    texts = [process.communicate()[1] for process in job]
    assert [process.returncode for process in job] == [2, 2], texts
    assert "rank 1 has cem.keep = 7" in texts[0] and "what rank 0 has: cem.keep = 8" in texts[0], texts[0]
    assert not (folder / "never").exists()


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
    waits = ranks(folder, 1, lambda rank: call(folder / "waits"), WORLD_SIZE=2)[0]
    time.sleep(3)
    waits.send_signal(signal.SIGINT)
    assert waits.wait(timeout=20) == 130


with tempfile.TemporaryDirectory() as temporary:
    {f.__name__: f for f in (processes, refined, by_environment, mpirun, torchrun, killed, kills, killed_at_the_door,
                                other_settings, interrupted)}[CASE](
        pathlib.Path(temporary))
