"""Planted faults and the tests that notice them. Called by scripts/mutate."""
import argparse
import concurrent.futures
import os
import pathlib
import queue
import re
import shutil
import subprocess
import sys
import time

from reproduce_document import commit, write_section

MUTANTS = pathlib.Path("tests/mutants")
CLONES = pathlib.Path("build/mutate")
DOCUMENT = pathlib.Path("docs/testing.md")


class Mutant:
    """A patch whose head says what the fault breaks, which tests fit and, where it may survive, why."""

    def __init__(self, path):
        self.path, self.name, self.room = path.resolve(), path.stem, path.stem.split("-")[0]
        text = path.read_text()
        head = dict(re.findall(r"^(Breaks|Tests|Survives): (.+)$", text.split("\ndiff --git ")[0], re.M))
        if not {"Breaks", "Tests"} <= head.keys() or "\ndiff --git " not in text:
            sys.exit(f"{path}: expected the lines 'Breaks: ...' and 'Tests: ...', then the output of git diff")
        self.breaks, self.tests, self.excuse = head["Breaks"], head["Tests"], head.get("Survives")


class Clone:
    """The project at `revision` in a folder of its own, with a build that goes on from the one before."""

    def __init__(self, folder, revision, cores):
        self.folder, self.cores = folder.resolve(), cores
        if not (folder / ".git").exists():
            shutil.rmtree(folder, ignore_errors=True)
            subprocess.run(["git", "clone", "-q", "--shared", "--no-checkout", ".", folder], check=True)
        self.run("git", "fetch", "-q", pathlib.Path.cwd(), revision, check=True)
        self.run("git", "checkout", "-q", "--force", "--detach", revision, check=True)
        self.environment = {"CCACHE_BASEDIR": str(self.folder), "CCACHE_NOHASHDIR": "1",
                            "ANTIGRASP_BINARY": str(self.folder / "build/release/bin/antigrasp")}
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        configured = self.run("cmake", "--preset", "python", "-DANTIGRASP_TESTS=ON", *launcher)
        if configured.returncode:
            sys.exit(f"{folder}: cmake failed\n{configured.stdout[-2000:]}")

    def run(self, *command, check=False, folder="."):
        environment = {**os.environ, **getattr(self, "environment", {})}
        return subprocess.run(command, cwd=self.folder / folder, env=environment, check=check, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def build(self, tests, cores=None):
        """The output of a build of what the tests need that failed; None when it is built."""
        rooms = {"viewer"} if tests.startswith("viewer") else set(re.findall(r"[a-z]+(?=[|)a-z]*/)", tests))
        programs = {"viewer": "antigrasp", "scripts": "antigrasp", "package": "all", "layout": "antigrasp_core"}
        targets = sorted(programs.get(room, f"{room}_test") for room in rooms)
        done = self.run("cmake", "--build", "build/release", "-j", str(cores or self.cores), "--target", *targets)
        return done.stdout if done.returncode else None

    def first_failure(self, tests):
        """The name of a test that fails, "" when all pass. Stops at the first."""
        if tests.startswith("viewer"):
            return self.first_page_failure(tests.split()[1:])
        done = self.run("ctest", "--test-dir", "build/release", "-R", tests, "--stop-on-failure", "--no-tests=error", "-j", "1")
        failed = re.search(r"^\s*\d+ - (\S+) \((.*)\)", done.stdout, re.M)
        if done.returncode and not failed:
            sys.exit(f"ctest -R '{tests}': {done.stdout[-500:]}")
        return failed[1] if failed else ""

    def first_page_failure(self, files):
        if self.run("npx", "tsc", "--noEmit", folder="report/viewer").returncode:
            return "tsc"
        paths = [f"tests/{name}" for name in files] or sorted(
            str(p.relative_to(self.folder / "report/viewer")) for p in (self.folder / "report/viewer/tests").glob("*.test.mjs"))
        done = self.run("node", "--test", "--test-concurrency=1", *paths, folder="report/viewer")
        failed = re.search(r"^\s*(?:✖|not ok \d+ -) (?!failing tests)(?!tests/)(.+?)(?: \([\d.]+ms\))?$", done.stdout, re.M)
        return f"viewer: {failed[1] if failed else 'exit ' + str(done.returncode)}" if done.returncode else ""

    def judge(self, mutant):
        """(outcome, the test that noticed or what went wrong)"""
        applied = self.run("git", "apply", mutant.path)
        if applied.returncode:
            return "error", "does not apply: " + applied.stdout.strip().split("\n")[0]
        try:
            if self.build(mutant.tests) is not None:
                return "error", "does not compile"
            failure = self.first_failure(mutant.tests)
            return ("killed", failure) if failure else ("survived", mutant.excuse or "")
        finally:
            self.run("git", "checkout", "-q", "--force", ".", check=True)


def check(mutants):
    """Whether every patch can still be planted, without planting it."""
    bad = 0
    for mutant in mutants:
        applied = subprocess.run(["git", "apply", "--check", mutant.path], capture_output=True, text=True)
        if applied.returncode:
            bad += 1
            print(f"{mutant.name}: {applied.stderr.strip()}")
    print(f"{len(mutants) - bad} of {len(mutants)} planted faults apply")
    sys.exit(1 if bad else 0)


def working_tree():
    stash = subprocess.run(["git", "stash", "create"], capture_output=True, text=True, check=True).stdout.strip()
    return stash or "HEAD"


def build_without(clone, mutants):
    for tests in sorted({m.tests for m in mutants}):
        output = clone.build(tests, os.cpu_count())
        if output is not None:
            sys.exit(f"without a fault, what '{tests}' needs does not build: {output[-2000:]}")


def passes_without(clone, mutants):
    """Every fitting test must pass before a fault is planted, or its failure would say nothing."""
    for tests in sorted({m.tests for m in mutants}):
        failure = clone.first_failure(tests)
        if failure:
            sys.exit(f"without a fault, of '{tests}': {failure}")


def judge_all(mutants, clones):
    free, results, began = queue.SimpleQueue(), {}, time.time()
    for clone in clones:
        free.put(clone)

    def one(mutant):
        clone = free.get()
        try:
            return mutant, clone.judge(mutant)
        finally:
            free.put(clone)

    with concurrent.futures.ThreadPoolExecutor(len(clones)) as pool:
        for done in concurrent.futures.as_completed([pool.submit(one, m) for m in mutants]):
            mutant, (outcome, by) = done.result()
            results[mutant.name] = outcome, by
            left = (time.time() - began) / len(results) * (len(mutants) - len(results))
            print(f"{outcome:8} {mutant.name}: {by or 'nothing noticed'}   "
                  f"[{len(results)} of {len(mutants)}, {left / 60:.0f} minutes left]", flush=True)
    return results


def summary(mutants, results):
    killed = sum(outcome == "killed" for outcome, _ in results.values())
    return f"{killed} of {len(mutants)} planted faults noticed ({killed / len(mutants):.0%})"


def document(mutants, results):
    rows = ["| fault | what it breaks | noticed by |", "| --- | --- | --- |"]
    for mutant in mutants:
        outcome, by = results[mutant.name]
        rows.append(f"| {mutant.name} | {mutant.breaks} | {by if outcome == 'killed' else f'**{outcome}** {by}'} |".replace("\n", " "))
    table = "\n".join(rows)
    write_section("mutants", f"`scripts/mutate --report`, written at commit {commit()}: **{summary(mutants, results)}**.\n\n{table}", DOCUMENT)
    print(f"wrote {DOCUMENT}")


def main():
    parser = argparse.ArgumentParser(prog="scripts/mutate")
    parser.add_argument("names", nargs="*", help="beginnings of names of faults (all)")
    parser.add_argument("--jobs", type=int, default=1, help="scratch clones side by side")
    parser.add_argument("--report", action="store_true", help="write the table into docs/testing.md; of all faults only")
    parser.add_argument("--check", action="store_true", help="only say whether every fault can still be planted")
    arguments = parser.parse_args()
    mutants = [Mutant(path) for path in sorted(MUTANTS.glob("*.patch"))]
    mutants = [m for m in mutants if not arguments.names or m.name.startswith(tuple(arguments.names))]
    if not mutants or (arguments.report and arguments.names) or arguments.jobs < 1:
        parser.error("no fault of that name" if not mutants else "--report goes with every fault, --jobs with 1 or more")
    if arguments.check:
        check(mutants)
    revision, cores = working_tree(), max(1, os.cpu_count() // arguments.jobs)
    clones = [Clone(CLONES / str(i), revision, cores) for i in range(arguments.jobs)]
    print(f"{len(mutants)} faults; building, and running their tests without any", flush=True)
    for clone in clones:  # one after the other: the second finds its objects in the compiler cache
        build_without(clone, mutants)
    passes_without(clones[0], mutants)
    results = judge_all(mutants, clones)
    print(summary(mutants, results))
    if arguments.report:
        document(mutants, results)
    bad = [m.name for m in mutants if results[m.name][0] == "error" or (results[m.name][0] == "survived" and not m.excuse)]
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
