"""What a control beside its run saves: bench/beside.py ANTIGRASP ROUNDS CONFIG [--set KEY=VALUE ...].
The whole run with the control in a process of its own and with the control after it, in turn: seconds by the clock, processor seconds of all
processes, medians, and how many times as fast. On a machine with nothing else to do: the second process takes what would be idle."""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def run(beside):
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.argv[1], "train", *sys.argv[3:], *([] if beside else ["--control-after"]), "--set", "cem.control=true", "--out", os.path.join(folder, "run")]
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr[-500:])
        clock, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    took = {way: [] for way in (True, False)}
    for _ in range(int(sys.argv[2])):
        for way in took:
            took[way].append(run(way))
            print(f"{'beside' if way else 'after'}: {took[way][-1][0]:.1f} s, processor {took[way][-1][1]:.1f} s", flush=True)
    clock, used = ({way: statistics.median(one[k] for one in took[way]) for way in took} for k in (0, 1))
    print(f"after {clock[False]:.1f} s ({used[False]:.1f} s of processor time), beside {clock[True]:.1f} s ({used[True]:.1f} s): "
          f"{clock[False] / clock[True]:.2f} times as fast")


main()
