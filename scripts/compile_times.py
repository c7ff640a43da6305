#!/usr/bin/env python3
"""compile_times.py [--every N] FOLDER...: what compiling the target antigrasp takes of the processor, in seconds.

FOLDER is a configured build folder of a commit, e.g. build/release. Every compile command of every folder runs once,
alone and without a cache, folders in turns, so that what else the machine does weighs on all alike. --every N: only
every Nth source. Prints FOLDER, SOURCES, SECONDS and the ratio to the first folder; nothing is linked.
"""
import argparse
import resource
import shlex
import subprocess
import sys


def compile_commands(folder):
    """What ninja would run to compile: (precompiled headers, sources), each without a launcher such as ccache."""
    said = subprocess.run(["ninja", "-C", folder, "-t", "commands", "antigrasp"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    headers, sources = [], []
    for line in said.splitlines():
        words = shlex.split(line)
        if "-c" not in words or "-o" not in words:
            continue
        compiler = next(i for i, word in enumerate(words) if word.endswith(("c++", "g++", "clang++")))
        (headers if words[words.index("-o") + 1].endswith(".gch") else sources).append(words[compiler:])
    return headers, sources


def seconds(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("folders", nargs="+", metavar="FOLDER")
    flags = parser.parse_args()
    headers, sources = zip(*map(compile_commands, flags.folders))
    totals = [sum(seconds(command, folder) for command in own) for own, folder in zip(headers, flags.folders)]
    counts = [len(own) for own in sources]
    turns = sorted((i / count, k, i) for k, count in enumerate(counts) for i in range(0, count, flags.every))
    for _, k, i in turns:
        totals[k] += seconds(sources[k][i], flags.folders[k]) * flags.every
    for folder, count, total in zip(flags.folders, counts, totals):
        print(f"{folder} {count} {total:.0f} {total / totals[0]:.2f}")


if __name__ == "__main__":
    sys.exit(main())
