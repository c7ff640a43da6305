"""Torments the program and stops at the first fault. Called by scripts/soak."""
import argparse
import os
import pathlib
import random
import shlex
import shutil
import signal
import subprocess
import sys
import time

from reproduce_document import commit, write_section
from soak_bench import LIMIT_S, TRAIN, Bench, Fault, files_of, refuses_well, same_bytes, whole_or_absent
from soak_damage import corpus, damaged

DOCUMENT = pathlib.Path("docs/reliability.md")
FAKETIME = next(iter(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1")), None)
SKIPPED = "left out: "


def killed(bench, process, after, how=signal.SIGKILL):
    """Whether the signal met the process alive."""
    try:
        process.wait(timeout=after)
        process.communicate()
        return False
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, how)
        code, _, err = bench.finish(process)
        # Before `train` listens for Ctrl-C (LibTorch loads for half a second) the signal ends it: 130 to a shell too.
        if how == signal.SIGINT and code not in (0, -signal.SIGINT):
            refuses_well(code, err, allowed=(130,))
        return True


def train_again_and_again(bench, rng, how, name):
    """Stops a run up to six times, then lets it end."""
    out = bench.scratch("run")
    for _ in range(rng.randint(1, 6)):
        command = [*TRAIN, "--out", out, "--or-resume"]
        if killed(bench, bench.start(*command), rng.uniform(0, 1.1) * bench.seconds["train"], how):
            bench.count(name)
    bench.must(*TRAIN, "--out", out, "--or-resume")
    same_bytes(out, bench.reference / "train")


def kill_train(bench, rng):
    train_again_and_again(bench, rng, signal.SIGKILL, "kills of training")


def interrupt_train(bench, rng):
    train_again_and_again(bench, rng, signal.SIGINT, "interrupts of training")


def kill_writer(bench, rng):
    """A command killed in the middle leaves whole files or none; called again it ends as if nothing had been."""
    name, command = rng.choice(sorted(bench.writers().items()))
    out = bench.scratch(name)
    for _ in range(rng.randint(1, 3)):
        if killed(bench, bench.start(*command, out), rng.uniform(0, 1.1) * bench.seconds[name]):
            bench.count("kills of other writers")
        whole_or_absent(out, bench.reference / name)
    bench.must(*command, out)
    same_bytes(out, bench.reference / name)


def damage(bench, rng):
    """A damaged file is read or refused in a line; nothing crashes, hangs or eats the memory."""
    source, commands = rng.choice(bench.corpus)
    command = rng.choice(commands)
    if isinstance(source, tuple):
        victim = bench.scratch("folder")
        shutil.copytree(source[0], victim)
        file = victim / source[1]
    else:
        victim = file = bench.scratch(source.name)
        shutil.copy(source, file)
    file.write_bytes(damaged(file.read_bytes(), rng))
    words = [str(victim) if w == "{}" else str(victim.parent / "out") if w == "{out}" else w for w in command]
    process = bench.start(*words)
    if words[0] == "train":  # what is left of a configuration may ask for days
        try:
            code, _, err = bench.finish(process, 20)
        except Fault:
            bench.count("damaged files read")
            return
    else:
        code, _, err = bench.finish(process)
    refuses_well(code, err)
    bench.count("damaged files refused" if code else "damaged files read")


def mounted(bench, size):
    """A small disk of its own, or None where that needs rights we do not have."""
    disk = bench.folder / "disk"
    subprocess.run(["umount", "-q", disk], capture_output=True)
    disk.mkdir(exist_ok=True)
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk], capture_output=True)
    return disk if made.returncode == 0 else None


def remount(disk, how):
    subprocess.run(["mount", "-o", f"remount,{how}", disk], check=True)


def full_disk(bench, rng):
    """On a disk too small the command says so; with room again it ends as if nothing had been."""
    names = sorted(bench.writers()) + ["train"] * 4
    name = rng.choice(names)
    command = [*TRAIN, "--or-resume", "--out"] if name == "train" else bench.writers()[name]
    needed = sum(map(len, files_of(bench.reference / name).values()))
    disk = mounted(bench, max(4096, int(needed * rng.uniform(0.05, 0.9))) // 4096 * 4096)
    if not disk:
        return bench.count(SKIPPED + "full disk (needs root)")
    try:
        code, _, err = bench.run(*command, disk / name)
        refuses_well(code, err, allowed=(0, 1, 2))
        if code:
            bench.count("full disks met")
            if name != "train":
                whole_or_absent(disk / name, bench.reference / name)
        remount(disk, "size=1g")
        if name != "train":
            for path in disk.iterdir():
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        bench.must(*command, disk / name)
        same_bytes(disk / name, bench.reference / name)
    finally:
        subprocess.run(["umount", "-q", disk], capture_output=True)


def read_only(bench, rng):
    """A folder that cannot be written to is named, at once or when the writing begins."""
    name, command = rng.choice(sorted(bench.writers().items()) + [("train", [*TRAIN, "--out"])])
    disk = mounted(bench, "1m")
    if not disk:
        return bench.count(SKIPPED + "read-only folder (needs root)")
    try:
        remount(disk, "ro")
        code, _, err = bench.run(*command, disk / name)
        refuses_well(code, err, allowed=(1, 2))
        if str(disk) not in err:
            raise Fault(f"the message does not name {disk}\n{err}")
        bench.count("read-only folders met")
    finally:
        subprocess.run(["umount", "-q", disk], capture_output=True)


def clock(bench, rng):
    """The time of day jumps by days, back and forth, while a run trains."""
    if not FAKETIME:
        return bench.count(SKIPPED + "clock (needs libfaketime)")
    out = bench.scratch("run")
    stamp = out.parent / "clock"
    stamp.write_text("+0")
    environment = {**os.environ, "LD_PRELOAD": str(FAKETIME), "FAKETIME_TIMESTAMP_FILE": str(stamp), "FAKETIME_NO_CACHE": "1",
                   "FAKETIME_DONT_FAKE_MONOTONIC": str(rng.randint(0, 1))}
    process = bench.start(*TRAIN, "--out", out, env=environment)
    ends = time.monotonic() + LIMIT_S
    while process.poll() is None and time.monotonic() < ends:
        time.sleep(rng.uniform(0.1, 1.5))
        part = stamp.with_suffix(".part")
        part.write_text(f"{rng.choice('+-')}{rng.randint(1, 400)}d")
        part.replace(stamp)
        bench.count("jumps of the clock")
    code, _, err = bench.finish(process)
    if code:
        raise Fault(f"exit {code} after jumps of the clock\n{err[-1500:]}")
    same_bytes(out, bench.reference / "train")


def one_core(bench, rng):
    """All threads of a run are held on one core, then let go, again and again."""
    cores = os.sched_getaffinity(0)
    if len(cores) < 2:
        return bench.count(SKIPPED + "core taken away (has one)")
    out = bench.scratch("run")
    process = bench.start(*TRAIN, "--out", out)
    ends = time.monotonic() + LIMIT_S
    while process.poll() is None and time.monotonic() < ends:
        for allowed in ({min(cores)}, cores):
            for thread in pathlib.Path(f"/proc/{process.pid}/task").glob("*"):
                try:
                    os.sched_setaffinity(int(thread.name), allowed)
                except OSError:
                    pass  # the thread has ended
            bench.count("cores taken away or given back")
            time.sleep(rng.uniform(0.1, 1.5))
    code, _, err = bench.finish(process)
    if code:
        raise Fault(f"exit {code} with a core taken away\n{err[-1500:]}")
    same_bytes(out, bench.reference / "train")


# How often each comes up among the others.
KINDS = {"kill-train": (kill_train, 3), "interrupt-train": (interrupt_train, 1), "kill-writer": (kill_writer, 8), "damage": (damage, 60),
         "full-disk": (full_disk, 5), "read-only": (read_only, 2), "clock": (clock, 1), "one-core": (one_core, 1)}


def trial(bench, kind, seed):
    begun = time.monotonic()
    try:
        KINDS[kind][0](bench, random.Random(f"{kind}:{seed}"))
    except Fault as fault:
        sys.exit(f"\nFAULT in {kind}:{seed}: {fault}\nits files are in {bench.folder / 'trial'}; again: scripts/soak --repeat {kind}:{seed}")
    bench.count(f"trials of {kind}")
    bench.count(f"seconds of {kind}", time.monotonic() - begun)


def show(bench, ends, last=False):
    left = max(0, ends - time.monotonic())
    faults = ", ".join(f"{number} {what}" for what, number in bench.counts.items() if not what.startswith(("trials", "seconds")))
    text = f"{left / 60:.0f} min left: {faults}"
    if sys.stderr.isatty():
        print("\r" + text[: shutil.get_terminal_size().columns - 1], end="\n" if last else "", file=sys.stderr, flush=True)
    else:
        print(text, file=sys.stderr, flush=True)


def table(bench, minutes):
    rows = [f"| {what} | {number} |" for what, number in sorted(bench.counts.items()) if not what.startswith(("trials", "seconds"))]
    return "\n".join([f"`scripts/soak --report {minutes:g}` at {commit()}, {len(os.sched_getaffinity(0))} cores: no fault.", "",
                      "| what | how often |", "| --- | --- |", *rows])


def main():
    parser = argparse.ArgumentParser(prog="scripts/soak", description=__doc__)
    parser.add_argument("minutes", nargs="?", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS), help="comma-separated: " + ", ".join(KINDS))
    parser.add_argument("--repeat", metavar="KIND:SEED")
    parser.add_argument("--report", action="store_true")
    parser.add_argument("--folder", default="build/soak", type=pathlib.Path)
    arguments = parser.parse_args()
    kinds = arguments.kinds.split(",")
    if unknown := set(kinds) - KINDS.keys():
        parser.error(f"unknown kind {', '.join(sorted(unknown))}, expected some of {', '.join(KINDS)}")
    bench = Bench(arguments.folder)
    print("undisturbed runs to compare with", file=sys.stderr)
    bench.prepare()
    bench.corpus = corpus(bench)
    if arguments.repeat:
        kind, seed = arguments.repeat.split(":")
        return trial(bench, kind, seed)
    rng = random.Random(arguments.seed)
    begun = said = time.monotonic()
    ends = begun + 60 * arguments.minutes
    weights = [KINDS[kind][1] for kind in kinds]
    while time.monotonic() < ends:
        trial(bench, rng.choices(kinds, weights)[0], str(rng.randrange(10**9)))
        if time.monotonic() - said > (1 if sys.stderr.isatty() else 60):
            said = time.monotonic()
            show(bench, ends)
    show(bench, ends, last=True)
    text = table(bench, arguments.minutes)
    print(text)
    if arguments.report:
        write_section("soak", text, DOCUMENT)


if __name__ == "__main__":
    main()
