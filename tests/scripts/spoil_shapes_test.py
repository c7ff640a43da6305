"""scripts/spoil_shapes.py: what it does to the grids of an SDF file. Skipped without h5py and numpy."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from scripts_path import ROOT

try:
    import h5py
    import numpy
except ImportError:
    h5py = None


def spoil(*args):
    return subprocess.run([ROOT / "scripts" / "spoil_shapes.py", *map(str, args)], capture_output=True, text=True)


@unittest.skipIf(h5py is None, "needs h5py and numpy")
class SpoilShapes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.dir = pathlib.Path(cls.folder.name)
        subprocess.run([os.environ["ANTIGRASP_BINARY"], "dataset", "make", "prisms", "--count", "2", "--out", cls.dir / "p.h5"],
                       check=True, capture_output=True)
        cls.exact = cls.grids("p.h5")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def grids(cls, name):
        with h5py.File(cls.dir / name) as file:
            return file["sdf"][:].astype(float)

    def test_noise_has_the_asked_deviation_and_no_mean_and_follows_its_seed(self):
        for name, seed in (("a.h5", 1), ("b.h5", 1), ("c.h5", 2)):
            self.assertEqual(spoil(self.dir / "p.h5", self.dir / name, "--noise", 2, "--seed", seed).returncode, 0)
        difference = self.grids("a.h5") - self.exact
        self.assertAlmostEqual(difference.std() * 32, 0.02, delta=0.0003)  # cells; 65,536 draws
        self.assertAlmostEqual(difference.mean() * 32, 0.0, delta=0.0003)
        self.assertEqual((self.dir / "a.h5").read_bytes(), (self.dir / "b.h5").read_bytes())
        self.assertGreater(abs(self.grids("a.h5") - self.grids("c.h5")).max(), 0)

    def test_blur_is_that_of_a_gauss_bell_and_keeps_planes(self):
        with h5py.File(self.dir / "p.h5") as file, h5py.File(self.dir / "impulse.h5", "w") as copy:
            for name in file:
                file.copy(name, copy)
            copy.attrs.update(file.attrs)
            grid = numpy.zeros((32, 32, 32))
            grid[16, 16, 16] = 1
            copy["sdf"][0] = grid
            copy["sdf"][1] = numpy.broadcast_to(numpy.arange(32.0), (32, 32, 32))
        self.assertEqual(spoil(self.dir / "impulse.h5", self.dir / "d.h5", "--blur", 1).returncode, 0)
        impulse, plane = self.grids("d.h5")
        self.assertAlmostEqual(impulse.sum(), 1, places=5)
        self.assertAlmostEqual(impulse[16, 16, 17] / impulse[16, 16, 16], numpy.exp(-0.5), places=5)
        self.assertAlmostEqual(impulse[15, 17, 18] / impulse[16, 16, 16], numpy.exp(-3), places=5)
        numpy.testing.assert_allclose(plane[8:24, 8:24, 8:24], numpy.broadcast_to(numpy.arange(8.0, 24), (16, 16, 16)), atol=1e-5)

    def test_refuses_what_is_not_there_and_what_is(self):
        for args in ((self.dir / "none.h5", self.dir / "e.h5"), (self.dir / "p.h5", self.dir / "p.h5"),
                     (self.dir / "p.h5", self.dir / "e.h5", "--noise", -1)):
            outcome = spoil(*args)
            self.assertEqual(outcome.returncode, 2, outcome.stderr)
            self.assertNotIn("Traceback", outcome.stderr)
        self.assertFalse((self.dir / "e.h5").exists())


if __name__ == "__main__":
    unittest.main()
