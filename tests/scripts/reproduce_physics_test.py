"""What scripts/reproduce_physics.py makes of trials.csv, against answers on paper and the binary's own comparison."""
import csv
import math
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import scripts_path  # noqa: F401

import reproduce_document
import reproduce_physics


def run(*arguments):
    return subprocess.run([reproduce_document.BINARY, *map(str, arguments)], capture_output=True, text=True)


def rows(**held):
    return {name: {"held": value} for name, value in held.items()}


class Physics(unittest.TestCase):
    def test_a_change_is_paired_by_name_and_over_objects_that_were_tried_on_both_sides(self):
        before = rows(a="0.5", b="1", c="0.25", lost="0.75", d="")
        after = rows(c="0.75", b="0.9", a="0.6", d="1", new="1")
        change, original = reproduce_physics.paired(before, after, "held")
        # Changes 10, -10 and 50: mean 50/3, variance (44.44 + 711.11 + 1111.11) / 2 = 933.33.
        self.assertEqual(change.count, 3)
        self.assertAlmostEqual(change.mean, 50 / 3, 12)
        self.assertAlmostEqual(change.half_width, 1.96 * math.sqrt(2800 / 9), 9)
        self.assertAlmostEqual(original.mean, 175 / 3, 12)

    def test_separate_trials_give_the_paired_interval_of_one_comparison(self):
        with tempfile.TemporaryDirectory() as temporary:
            place = pathlib.Path(temporary)
            for folder, phis in (("before", (0, 5, 10)), ("after", (10, 20, 28))):
                (place / folder).mkdir()
                for name, phi in zip("abc", phis):
                    run("shape", "cube", "--phi", phi, "--size-mm", 30, "--out", place / folder / f"{name}.stl")
            flags = ("--mm", "--friction", 0.3, "--num-grasps", 6, "--draws", 2, "--replays", 0)
            compared = run("trial", place / "after", "--baseline", place / "before", *flags, "--out", place / "both")
            if "MuJoCo" in compared.stderr and compared.returncode:
                self.skipTest("a build without MuJoCo")
            self.assertEqual(compared.returncode, 0, compared.stderr)
            with open(place / "both" / "means.csv", newline="") as file:
                found = {(row["masses"], row["stage"], row["grasps"]): row for row in csv.DictReader(file)}
            for masses, mass in reproduce_physics.MASSES.items():
                sides = []
                for side in ("before", "after"):
                    out = place / f"{side}-{masses}"
                    self.assertEqual(run("trial", place / side, *flags, *mass, "--out", out).returncode, 0)
                    sides.append(reproduce_physics.read_trials(out / "trials.csv"))
                for load, column in reproduce_physics.LOADS.items():
                    stage, grasps = {"best quarter": ("1 g", "top quarter"), "kept": ("", "candidates kept")}.get(load, (load, "all"))
                    row = found[masses, stage, grasps]
                    change, original = reproduce_physics.paired(*sides, column)
                    self.assertEqual(change.count, int(row["pairs"]))
                    for value, name in ((change.mean, "difference"), (change.half_width, "difference_half_width"),
                                        (original.mean, "held_before")):
                        self.assertAlmostEqual(value, float(row[name]), 9, (masses, load, name))
            self.assertNotEqual(float(found["own", "1 g", "all"]["difference"]), 0)

    def test_originals_are_tried_once_for_all_methods(self):
        study = reproduce_physics.Study(pathlib.Path("out"), 50, 8, 3, ("prisms",), ("sphere", "pad"))
        places = [job.arguments[1] for job in study.trials()]
        self.assertEqual(sum(place.name == "before" for place in places), 2 * 2 * 2)
        self.assertEqual(len(places), 8 * (1 + 5 + 2))
        self.assertEqual(len({job.target for job in study.jobs()}), len(study.jobs()))

    def test_originals_that_differ_between_methods_end_the_script(self):
        with tempfile.TemporaryDirectory() as temporary:
            study = reproduce_physics.Study(pathlib.Path(temporary), 1, 8, 3, ("prisms",), ("sphere",))
            for label, _ in reproduce_physics.METHODS:
                folder = study.perturbed("prisms", label) / "before"
                folder.mkdir(parents=True)
                (folder / "a.stl").write_text("same")
            reproduce_physics.require_same_originals(study)
            (study.perturbed("prisms", "random 20") / "before" / "a.stl").write_text("else")
            with self.assertRaises(SystemExit):
                reproduce_physics.require_same_originals(study)

    def test_a_second_call_makes_what_is_missing_and_says_how_long_it_takes(self):
        with tempfile.TemporaryDirectory() as temporary:
            made, said = [], []

            def job(name):
                target = pathlib.Path(temporary) / name / "made"
                return reproduce_physics.Job(target, 60.0, target)

            def call(target):
                made.append(target.parent.name)
                target.write_text("")

            with mock.patch.object(reproduce_physics, "call", call), \
                    mock.patch("builtins.print", lambda text, **_: said.append(text)):
                reproduce_physics.run_all([job("a"), job("b")])
                reproduce_physics.run_all([job("a"), job("b"), job("c")])
        self.assertEqual(made, ["a", "b", "c"])
        self.assertEqual(said[0], "2 of 2 calls to make, about 2 min on two cores")
        self.assertEqual(said[3], "1 of 3 calls to make, about 1 min on two cores")


if __name__ == "__main__":
    unittest.main()
