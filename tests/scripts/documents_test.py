"""Every call of antigrasp that README.md, docs/commands.md and docs/tour.md show, made in their order: it succeeds (or is refused) and
prints the lines shown, whatever the numbers in them. Sets are small, training and searches are short; the rest is as written."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from scripts_path import ROOT

BINARY = os.environ["ANTIGRASP_BINARY"]
SHORT = ["--set", "cem.episodes=1", "--set", "cem.samples=16", "--set", "cem.keep=4", "--set", "cem.control=false", "--set", "cem.iterations=2",
         "--set", "cem.checkpoint_every=2", "--set", "cem.prior_iterations=2", "--set", "metric.num_grasps=10",
         "--set", "metric.num_draws=3", "--set", "run.torch_threads=1"]

# Options that a call gets where it does not say them itself.
QUICK = {"search for a judge": {"--starts": 1, "--descent-steps": 20, "--generations": 2, "--num-grasps": 30},
         "search": {"--steps": 30}, "trial": {"--num-grasps": 20}, "bundle": {"--parts": 4}}


def examples(document):
    """(call, lines that it prints) of the indented examples, in their order."""
    calls, inside = [], False
    for line in (ROOT / document).read_text().split("\n"):
        if line.startswith("    $ "):
            calls.append((line[6:], []))
            inside = True
        elif line.startswith("    ") and calls and inside:
            calls[-1][1].append(line[4:])
        else:
            inside = False
    return calls


def shortened(words):
    """The call with few objects, and training of a few updates."""
    for flag, most in (("--count", 3), ("--per-stage", 3), ("--dpi", 60)):
        if flag in words:
            at = words.index(flag) + 1
            words[at] = str(min(int(words[at]), most))
    command = "search" if words[:2] == ["perturb", "search"] else words[0]
    command += " for a judge" if "--objective" in words else ""
    words += [str(word) for option in QUICK.get(command, {}).items() if option[0] not in words for word in option]
    if words[0] == "train" and "--resume" not in words:
        extra = list(SHORT)
        if not any(word.startswith("prior.file=") for word in words):
            extra += ["--set", "prior.count=24"]
        if any("paper.toml" in word for word in words):
            extra += ["--set", "model.width=8", "--set", "model.width_d=8", "--set", "gan.batch=4"]
        words += extra
    return words


def without_numbers(line):
    return re.sub(r"\s+", " ", re.sub(r"[-+]*\d[\d.,]*(e-?\d+)?", "#", line)).strip()


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = pathlib.Path(temporary.name)
        cls.folder = cls.place / "inputs"
        cls.folder.mkdir()
        (cls.folder / "configs").symlink_to(ROOT / "configs")
        cls.make_inputs()

    @staticmethod
    def run_call(folder, *words):
        return subprocess.run([BINARY, *map(str, words)], cwd=folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    @classmethod
    def must(cls, *words):
        done = cls.run_call(cls.folder, *words)
        assert done.returncode == 0, f"{words}: {done.stdout}"

    @classmethod
    def make_inputs(cls):
        """What the documents take for granted: a run, meshes and a table of the user's own."""
        cls.must(*shortened(["train", "configs/demo.toml", "--out", "runs/demo"]), "--set", "cem.episodes=3")
        for kind, name in (("bottles", "mugs"), ("cylinders", "held_out"), ("prisms", "parts")):
            cls.must("dataset", "make", kind, "--count", "3", "--seed", "5", "--out", f"{name}.h5")
        cls.must("remesh", "parts.h5", "--out", "parts")
        (cls.folder / "meshes").mkdir()
        for number, mesh in enumerate(sorted((cls.folder / "parts").glob("*.obj"))):
            mesh.rename(cls.folder / f"meshes/part-{number}.obj")
        cls.must("export", "meshes/part-0.obj", "--out", "stl")
        next((cls.folder / "stl").glob("*.stl")).rename(cls.folder / "mug.stl")
        cls.must("shape", "cube", "--phi", "15", "--out", "bevelled.stl")
        cls.must("perturb", "exhaustive", "bevelled.stl", "--history", "--iterations", "3", "--out", "exhaustive")
        cls.must("sample", "runs/demo", "--count", "3", "--out", "samples.h5")
        cls.must("dataset", "make", "cylinders", "--count", "3", "--seed", "6", "--out", "prior.h5")
        tour = dict(examples("docs/commands.md"))
        for table in ("cube.csv", "my_grasps.csv"):
            (cls.folder / table).write_text("\n".join(tour[f"cat {table}"]) + "\n")

    def check(self, document):
        calls = [(call, printed) for call, printed in examples(document) if call.startswith("antigrasp ")]
        self.assertGreater(len(calls), 5)
        folder = self.place / pathlib.Path(document).name  # a reader begins with either
        shutil.copytree(self.folder, folder, symlinks=True)
        for call, printed in calls:
            with self.subTest(document=document, call=call):
                done = self.run_call(folder, *shortened(shlex.split(call, comments=True)[1:]))
                refused = bool(printed) and printed[0].startswith("antigrasp: ")
                self.assertEqual(done.returncode, 2 if refused else 0, done.stdout)
                said = [without_numbers(line) for line in done.stdout.split("\n")]
                for line in printed:
                    self.assertIn(without_numbers(line), said)

    def test_the_calls_of_the_readme_and_of_the_tour_do_what_they_show(self):
        for document in ("README.md", "docs/commands.md", "docs/tour.md"):
            self.check(document)

    def test_every_command_is_in_the_tour(self):
        help_text = self.run_call(self.folder, "help").stdout
        listed = re.findall(r"^  ([a-z]+) ", help_text[help_text.index("Subcommands:"):], re.M)
        self.assertGreater(len(listed), 15)
        tour = (ROOT / "docs/commands.md").read_text()
        for command in listed:
            self.assertTrue(command == "help" or re.search(rf"antigrasp {command}\b", tour), command)


if __name__ == "__main__":
    unittest.main()
