"""Grids as NumPy's arrays, both ways: written by the binary in ANTIGRASP_BINARY and read by NumPy, and the other way round."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("skipped: NumPy is not installed")
    sys.exit(77)  # CTest counts and names it

BINARY = os.environ["ANTIGRASP_BINARY"]


def ball(n, radius, inside=1.0, unit=1.0):
    """Distances to a ball off the middle of the unit cube, in 1/unit of its sides, order z y x."""
    at = (numpy.arange(n) + 0.5) / n - 0.5
    z, y, x = numpy.meshgrid(at, at, at, indexing="ij")
    return (inside / unit * (radius - numpy.sqrt((x - .1)**2 + y**2 + (z + .05)**2))).astype(numpy.float32)


class Numpy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def call(self, *words):
        return subprocess.run([BINARY, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def run_well(self, *words):
        done = self.call(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refused(self, *words):
        done = self.call(*words)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_numpy_reads_what_dataset_make_writes(self):
        seed = 2**53 + 1  # that a float64 does not hold
        for name in ("a.npy", "a.npz"):
            self.run_well("dataset", "make", "cylinders", "--count", "3", "--seed", str(seed), "--out", name)
        grids = numpy.load(self.path("a.npy"))
        self.assertEqual((grids.shape, grids.dtype.str), ((3, 32, 32, 32), "<f4"))
        for grid in grids:  # a solid inside the cube
            self.assertGreater(grid.max(), 0)
            self.assertLess(grid[0, 0, 0], -0.2)
        with numpy.load(self.path("a.npz"), allow_pickle=False) as file:
            self.assertTrue((file["sdf"] == grids).all())
            self.assertEqual([str(name) for name in file["names"]], [f"cylinders-{i:06d}" for i in range(3)])
            said = {name: file[name].tolist() for name in file.files if name not in ("sdf", "names")}
        self.assertEqual(said, {
            "format": "antigrasp.sdf", "sign": "positive inside", "unit": "side of the unit cube",
            "kind": "cylinders", "seed": seed, "spacing": 1 / 32, "origin": 3 * [-0.484375],
            "truncation": 0.0, "provenance": f"prior set cylinders, seed {seed}, count 3"})

    def test_both_become_an_sdf_file_and_are_read_wherever_one_is(self):
        self.run_well("dataset", "make", "prisms", "--count", "2", "--out", "a.h5")
        self.run_well("dataset", "import", "a.h5", "--out", "a.npz")
        self.run_well("dataset", "import", "a.npz", "--out", "b.npy")
        self.run_well("dataset", "import", "b.npy", "--out", "b.h5")
        self.assertIn("NumPy's archive", self.run_well("info", "a.npz"))
        self.assertIn("2 of 32^3", self.run_well("info", "b.npy"))
        for name in ("a.h5", "a.npz", "b.npy", "b.h5"):
            self.run_well("remesh", name, "--out", name[0] + "_" + name[2:])
        tables = [self.text(folder + "/remesh.csv") for folder in ("a_h5", "a_npz")]
        self.assertEqual(*tables)
        tables = [self.text(folder + "/remesh.csv") for folder in ("b_npy", "b_h5")]
        self.assertEqual(*tables)
        self.assertIn("b-000001,ok,", tables[0])

    def test_an_array_that_is_negative_inside_is_turned_where_that_is_said(self):
        numpy.save(self.path("sdf.npy"), numpy.stack([ball(16, .3, -1), ball(16, .2, -1)]))
        message = self.refused("remesh", "sdf.npy", "--out", "m")
        self.assertIn("--sign negative-inside", message)
        self.assertIn("--sign negative-inside", self.refused("dataset", "import", "sdf.npy", "--out", "x.npz"))
        self.assertEqual(os.listdir(self.folder), ["sdf.npy"])
        self.run_well("dataset", "import", "sdf.npy", "--sign", "negative-inside", "--out", "x.npz")
        with numpy.load(self.path("x.npz")) as file:
            self.assertTrue((file["sdf"][0] == ball(16, .3)).all())
            self.assertTrue((file["sdf"][1] == ball(16, .2)).all())
        self.assertIn("expected none: the file says",
                      self.refused("dataset", "import", "x.npz", "--sign", "negative-inside", "--out", "y.h5"))

    def test_distances_in_voxels_need_their_spacing(self):
        numpy.save(self.path("voxels.npy"), ball(16, .3, 1, 1 / 16).astype(numpy.float64))
        message = self.refused("dataset", "import", "voxels.npy", "--out", "x.npy")
        self.assertRegex(message, r"values that change by 1[56]")
        self.assertIn("--spacing", message)
        self.run_well("dataset", "import", "voxels.npy", "--spacing", "1", "--out", "x.npy")
        self.assertLess(abs(numpy.load(self.path("x.npy"))[0] - ball(16, .3)).max(), 1e-6)

    def test_a_compressed_archive_of_one_array_is_read(self):
        numpy.savez_compressed(self.path("one.npz"), distances=ball(16, .3))
        self.run_well("dataset", "import", "one.npz", "--out", "x.npy")
        self.assertTrue((numpy.load(self.path("x.npy"))[0] == ball(16, .3)).all())

    def test_exact_distances_to_remeshed_shapes(self):
        self.run_well("dataset", "make", "bottles", "--count", "2", "--out", "a.h5")
        self.run_well("remesh", "a.h5", "--out", "m", "--grids", "m.npz")
        self.run_well("dataset", "import", "a.h5", "--out", "a.npy")
        with numpy.load(self.path("m.npz")) as file:
            self.assertLess(abs(file["sdf"] - numpy.load(self.path("a.npy"))).max(), 1 / 64)  # half a cell
            self.assertEqual(float(file["truncation"]), 0.0)

    def test_foreign_arrays_are_refused_by_name(self):
        grid = ball(8, .3)
        cases = {"Fortran order": numpy.asfortranarray(grid), "big-endian": grid.astype(">f4"),
                 "'<i4'": grid.astype(numpy.int32), "several fields": numpy.zeros((2, 2, 2), [("a", "<f4")]),
                 "Python objects": numpy.full((2, 2, 2), None), "shape [8, 64]": grid.reshape(8, 64)}
        for part, array in cases.items():
            numpy.save(self.path("a.npy"), array)
            self.assertIn(part, self.refused("info", "a.npy"))
        numpy.savez(self.path("b.npz"), one=grid, two=grid)
        self.assertIn("one named sdf", self.refused("info", "b.npz"))
        numpy.savez_compressed(self.path("c.npz"), sdf=numpy.zeros((800, 32, 32, 32), numpy.float32))
        self.assertIn("hundred times", self.refused("info", "c.npz"))

    def test_what_is_no_number_or_inside_at_its_border_is_left_out_and_reported(self):
        grids = numpy.stack([ball(8, .3), ball(8, .3), ball(8, .3, -1)])
        grids[1, 3, 4, 5] = numpy.nan
        numpy.save(self.path("a.npy"), grids)
        said = self.run_well("dataset", "import", "a.npy", "--out", "b.npz", "--report", "r.csv")
        self.assertIn("1 shapes (1 accepted, 0 repaired, 2 refused)", said)
        report = self.text("r.csv")
        self.assertIn("\"a.npy, a-000001\",refused,values that are no numbers", report)
        self.assertIn("\"a.npy, a-000002\",refused,inside at the border: another --sign?", report)
        with numpy.load(self.path("b.npz")) as file:
            self.assertEqual([str(name) for name in file["names"]], ["a-000000"])


if __name__ == "__main__":
    unittest.main()
