"""antigrasp.load and train give the bytes and numbers of the program."""
import filecmp
import os
import pathlib
import subprocess
import sys
import unittest

from support import BINARY, Files, column, numpy

import antigrasp

try:
    antigrasp.networks  # pylint: disable=pointless-statement
except antigrasp.Error as error:
    print(f"skipped: {error}")
    sys.exit(77)

ROOT = pathlib.Path(__file__).parents[2]
# Nothing is trained and little is sampled.
SMALL = {"cem.mode": "latent", "cem.episodes": 2, "cem.samples": 12, "cem.keep": 4, "cem.prior_scored": 8, "prior.count": 16,
         "metric.num_grasps": 20, "metric.num_draws": 3, "cem.compared": 8}


def flags(settings):
    return [f"{key}={str(value).lower() if isinstance(value, bool) else value}" for key, value in settings.items()]


class Networks(Files):
    def test_samples_are_the_file_of_the_program_to_the_byte(self):
        self.run_program("sample", "cylinders-prior", "--count", 3, "--seed", 7, "--out", "s.h5")
        networks = antigrasp.load("cylinders-prior")
        samples = networks.sample(3, seed=7)
        samples.save(self.folder / "own.h5")
        written = antigrasp.datasets.read(self.folder / "s.h5")
        numpy.testing.assert_array_equal(samples.values, written.values)
        self.assertEqual((samples.names, samples.truncation), (written.names, written.truncation))
        self.assertEqual(samples.provenance, written.provenance)
        self.assertTrue(filecmp.cmp(self.folder / "s.h5", self.folder / "own.h5", shallow=False))
        numpy.testing.assert_array_equal(networks.sample(1, seed=7, first=2).values[0], samples.values[2])
        self.assertEqual(networks.sample(1, first=2).names, ["sample-000002"])
        self.assertTrue(pathlib.Path(networks.path).name.startswith("cylinders-prior"))

    def test_names_that_are_none_are_refused_in_the_words_of_the_program(self):
        with self.assertRaises(antigrasp.InputError) as raised:
            antigrasp.load("spheres-prior")
        self.assertEqual(str(raised.exception), self.refusal("sample", "spheres-prior", "--out", "s.h5"))
        self.assertIn("cylinders-prior", antigrasp.networks.pretrained())
        with self.assertRaisesRegex(antigrasp.InputError, "^count = 0, first = 0 "):
            antigrasp.load("cylinders-prior").sample(0)


class Train(Files):
    def test_episodes_are_those_of_the_program(self):
        self.run_program("train", "--from", "cylinders-prior", "--set", *flags(SMALL), "--out", "run")
        run = antigrasp.train(settings=SMALL, start="cylinders-prior")
        episodes = list(run)
        self.assertEqual([episode.number for episode in episodes], [0, 1, 2])
        rows = self.rows("run/statistics.csv")
        self.assertEqual(len(run.statistics), len(rows))
        for own, row in zip(run.statistics, rows):
            numpy.testing.assert_array_equal(list(own.values()), [float(text) for text in row.values()])
        for episode in episodes:
            scores = self.rows(f"run/episode_{episode.number}/scores.csv")
            own = [f"{score!r}" if score == score else "" for score in episode.scores.tolist()]
            self.assertEqual([float(one or "nan") for one in own if one],
                             [float(row["graspability"]) for row in scores if row["graspability"]])
            self.assertEqual(len(episode.samples), 12)
        self.assertEqual(list(run), [])  # it has ended
        run.save(self.folder / "own.pt")
        self.assertEqual(antigrasp.load(self.folder / "own.pt").sample(2).values.shape, (2, 32, 32, 32))

    def test_a_function_of_ones_own_judges(self):
        seen, told = [], []

        def height(mesh):
            seen.append(mesh.name)
            return None if len(seen) % 5 == 0 else float(mesh.bounds[1, 2] - mesh.bounds[0, 2])

        run = antigrasp.train(settings=SMALL | {"cem.episodes": 1}, start="cylinders-prior", judge=height,
                              progress=lambda *what: told.append(what))
        first = next(run)
        scored = numpy.flatnonzero(~numpy.isnan(first.scores))
        self.assertGreaterEqual(12 - len(scored), 2)  # a fifth has no score
        self.assertGreater(first.scores[scored].min(), 0)
        lowest = scored[numpy.argsort(first.scores[scored], kind="stable")[:4]]
        numpy.testing.assert_array_equal(first.elites, numpy.sort(lowest))
        mesh = first.samples.meshes()[scored[0]]
        self.assertAlmostEqual(mesh.bounds[1, 2] - mesh.bounds[0, 2], first.scores[scored[0]])
        self.assertGreater(len(seen), 8)
        self.assertTrue(any("scoring" in what and done == of for what, done, of in told), told[:3])

    def test_what_a_judge_raises_leaves_the_loop_and_the_run_goes_on(self):
        calls = []

        def judge(mesh):
            calls.append(mesh)
            if len(calls) == 12:  # of the first episode: eight of the prior set come before
                raise LookupError("not this one")
            return mesh.volume

        run = antigrasp.train(settings=SMALL | {"cem.episodes": 0}, start="cylinders-prior", judge=judge)
        with self.assertRaisesRegex(LookupError, "not this one"):
            next(run)
        again = next(run)
        straight = next(antigrasp.train(settings=SMALL | {"cem.episodes": 0}, start="cylinders-prior",
                                        judge=lambda mesh: mesh.volume))
        numpy.testing.assert_array_equal(again.scores, straight.scores)

    def test_settings_are_refused_in_the_words_of_the_program(self):
        for settings in ({"cem.keeps": 3}, {"cem.keep": -1}, {"cem.keep": 30, "cem.samples": 24}):
            with self.subTest(settings), self.assertRaises(antigrasp.InputError) as raised:
                antigrasp.train(settings=settings)
            self.assertEqual(str(raised.exception), self.refusal("train", "--set", *flags(settings), "--out", "run"))
        with self.assertRaisesRegex(antigrasp.InputError, "^cem.control = true "):
            antigrasp.train(settings=SMALL | {"cem.control": True}, start="cylinders-prior")

    def test_a_step_is_trained_when_there_are_steps(self):
        run = antigrasp.train(ROOT / "configs/smoke.toml", {"cem.control": False, "cem.episodes": 0})
        self.run_program("train", ROOT / "configs/smoke.toml", "--set", "cem.control=false", "cem.episodes=0", "--out", "run")
        row = self.rows("run/statistics.csv")[-1]
        self.assertEqual(next(run).statistics["graspability"], float(row["graspability"]))


class Kernels(unittest.TestCase):
    def test_kernels_of_openblas_that_are_not_the_programs_are_warned_of(self):
        script = """
import warnings, numpy, antigrasp
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    kernels = antigrasp.networks._blas_kernels()
print([str(one.message).count(kernels) for one in said], kernels in ("", "Haswell"))
"""
        environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_CORETYPE"}
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, env=environment)
        self.assertIn(done.stdout, ("[] True\n", "[1] False\n"))

    def test_libtorch_is_told_to_take_the_kernels_of_avx2_when_it_is_loaded_and_not_before(self):
        script = """
import os, antigrasp
libc = __import__("ctypes").CDLL(None); libc.getenv.restype = __import__("ctypes").c_char_p
before = libc.getenv(b"ATEN_CPU_CAPABILITY")
antigrasp.networks
print(before, libc.getenv(b"ATEN_CPU_CAPABILITY"))
"""
        environment = {name: value for name, value in os.environ.items() if name != "ATEN_CPU_CAPABILITY"}
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, env=environment)
        self.assertIn(done.stdout, ("None b'avx2'\n", "None None\n"))


if __name__ == "__main__":
    unittest.main()
