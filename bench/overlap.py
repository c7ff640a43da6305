"""Where a run of `train` leaves the second core idle: bench/overlap.py ANTIGRASP CONFIG [--set KEY=VALUE ...].
Looks 100 times a second how many threads of the process want a core and what they have used (/proc; other programs change neither), and prints for
every kind of phase the processor seconds, those that one thread alone used while no other wanted a core, and what two free cores would take: the
ones alone and half of the others. "before X" is what lies between phases: statistics, tables, sheets, checkpoints."""
import collections
import os
import re
import subprocess
import sys
import tempfile
import threading
import time

EVERY = 0.01


def look(pid):
    """Threads that run or could, and nanoseconds that all living threads have used."""
    wanting = used = 0
    for task in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{task}/stat", encoding="utf-8") as stat:
                wanting += stat.read().rsplit(")", 1)[1].split()[0] in "RD"
            with open(f"/proc/{pid}/task/{task}/schedstat", encoding="utf-8") as schedstat:
                used += int(schedstat.read().split()[0])
        except (FileNotFoundError, ProcessLookupError):
            pass
    return wanting, used


def watch(process, looks):
    while process.poll() is None:
        try:
            looks.append((time.monotonic(), *look(process.pid)))
        except FileNotFoundError:
            return
        time.sleep(EVERY)


def phases(lines):
    """(begin, end, kind) of what says how long it took."""
    found = []
    for line in lines:
        now = time.monotonic()
        took = re.search(r"(.*?)  \d+/\d+ .*took (?:(\d+)m )?([0-9.]+) ?s", line)
        if took:
            seconds = 60 * int(took[2] or 0) + float(took[3])
            found.append((now - seconds, now, re.sub(r"\d+", "N", re.sub(r"^.*episode \d+: ", "", took[1])).strip()))
    return found


def run(words):
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([*words, "--out", os.path.join(folder, "run")], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        looks = []
        watcher = threading.Thread(target=watch, args=(process, looks))
        watcher.start()
        known = phases(process.stderr)
        watcher.join()
        if process.returncode != 0:
            sys.exit(f"train: exit {process.returncode}")
    return known, looks


def main():
    known, looks = run([sys.argv[1], "train", *sys.argv[2:]])
    used, alone = collections.Counter(), collections.Counter()
    for (_, _, before), (at, wanting, after) in zip(looks, looks[1:]):
        kind = next((kind if start <= at else f"before {kind}" for start, stop, kind in known if at <= stop), "end")
        seconds = 1e-9 * max(0, after - before)
        used[kind] += seconds
        alone[kind] += seconds if wanting <= 1 else 0.0
    total = sum(used.values()), sum(alone.values())
    wall = 0.5 * sum(total)
    print("| phase | processor, s | alone, s | two free cores, s | alone, of the run |\n| --- | --- | --- | --- | --- |")
    for kind, both, one in [(kind, used[kind], alone[kind]) for kind, _ in used.most_common()] + [("all", *total)]:
        print(f"| {kind} | {both:.1f} | {one:.1f} | {0.5 * (both + one):.1f} | {100 * one / wall:.0f} % |")


main()
