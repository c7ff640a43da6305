"""Steps of two builds of bench_training in turn in one run: bench/training_versions.py OLD NEW [WIDTH [ROUNDS [BUSY]]]. OLD and NEW are commands. A row a
number of threads and whether another program, the shell command BUSY ("" = no such rows), keeps a core busy meanwhile: seconds of a step of both on the wall
and of the processor (medians over rounds), the median over rounds of their ratio, above 1 = NEW is faster, and how much faster NEW is on two threads than on
one."""
import os
import shlex
import signal
import statistics
import subprocess
import sys

PROGRAMS = sys.argv[1:3]
WIDTH = sys.argv[3] if len(sys.argv) > 3 else "16"
ROUNDS = int(sys.argv[4]) if len(sys.argv) > 4 else 9
BUSY = sys.argv[5] if len(sys.argv) > 5 else "exec taskset -c 1 sh -c 'while :; do :; done'"


class Steps:
    def __init__(self, program, threads):
        command = [*shlex.split(program), "answer", WIDTH, "1", threads]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        if self.process.stdout.readline() != "ready\n":
            sys.exit(f"{' '.join(command)}: not ready")

    def seconds(self):
        """Of the second step in a row: the first finds another program's data in the caches."""
        for _ in range(2):
            self.process.stdin.write("\n")
            self.process.stdin.flush()
            answer = self.process.stdout.readline()
        return tuple(map(float, answer.split()))


def busy_core():
    return subprocess.Popen(["sh", "-c", BUSY], start_new_session=True)


steps = {(which, threads): Steps(PROGRAMS[which], threads) for which in (0, 1) for threads in ("1", "2")}
kinds = (False, True) if BUSY else (False,)
took = {(key, busy): [] for key in steps for busy in kinds}
for number in range(ROUNDS):
    for busy in kinds:
        other = busy_core() if busy else None
        for key in list(steps)[:: 1 if number % 2 == 0 else -1]:
            took[key, busy].append(steps[key].seconds())
        if other:
            os.killpg(other.pid, signal.SIGKILL)
            other.wait()


def walls(which, threads, busy):
    return [wall for wall, _ in took[(which, threads), busy]]


def middle_ratio(over, under):
    return statistics.median(a / b for a, b in zip(over, under))


print(f"width {WIDTH}, {ROUNDS} rounds\n| threads | busy core | old, s | new, s | times as fast | old, processor s | new, processor s | new: of one thread |")
print("| --- | --- | --- | --- | --- | --- | --- | --- |")
for busy in kinds:
    for threads in ("1", "2"):
        old, new = walls(0, threads, busy), walls(1, threads, busy)
        processor = [statistics.median(cpu for _, cpu in took[(which, threads), busy]) for which in (0, 1)]
        gain = [middle_ratio(walls(which, "1", busy), walls(which, threads, busy)) for which in (0, 1)]
        print(f"| {threads} | {'yes' if busy else 'no'} | {statistics.median(old):.4g} | {statistics.median(new):.4g} | {middle_ratio(old, new):.2f} "
              f"| {processor[0]:.4g} | {processor[1]:.4g} | {gain[1]:.2f} (old {gain[0]:.2f}) |")
