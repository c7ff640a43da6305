"""SDF files are for other programs, too: written by the binary in ANTIGRASP_BINARY, read by h5py."""
import filecmp
import os
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import h5py
except ImportError:
    print("skipped: h5py is not installed")
    sys.exit(77)  # CTest counts and names it

BINARY = os.environ["ANTIGRASP_BINARY"]


def texts(attributes):
    """Strings of one fixed length come as bytes."""
    return {name: value.decode() if isinstance(value, bytes) else value
            for name, value in attributes.items()}


class SdfFile(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def make(self, name, *more):
        path = os.path.join(self.folder.name, name)
        subprocess.run(
            [BINARY, "dataset", "make", "cylinders", "--count", "3", "--out", path, *more],
            check=True, capture_output=True)
        return path

    def test_h5py_reads_attributes_names_and_grids(self):
        # A seed that a float64 does not hold.
        with h5py.File(self.make("a.h5", "--seed", str(2**53 + 1)), "r") as file:
            attributes = texts(file.attrs)
            self.assertEqual(attributes.pop("provenance"),
                             "prior set cylinders, seed 9007199254740993, count 3")
            self.assertEqual(list(attributes.pop("origin")), 3 * [-0.484375])
            self.assertEqual(attributes, {
                "format": "antigrasp.sdf", "version": 2, "kind": "cylinders", "seed": 2**53 + 1,
                "spacing": 1 / 32, "truncation": 0.0})
            sdf = file["sdf"]
            self.assertEqual(texts(sdf.attrs),
                             {"sign": "positive inside", "unit": "side of the unit cube"})
            self.assertEqual((sdf.shape, sdf.dtype.str, sdf.chunks),
                             ((3, 32, 32, 32), "<f4", (1, 32, 32, 32)))
            self.assertEqual([name.decode() for name in file["names"]],
                             [f"cylinders-{i:06d}" for i in range(3)])
            for grid in sdf:  # a solid inside the cube
                self.assertGreater(grid.max(), 0)
                self.assertLess(grid[0, 0, 0], -0.2)

    def test_the_bytes_do_not_depend_on_threads_and_time(self):
        paths = [self.make("1.h5", "--threads", "1")]
        time.sleep(1.1)  # HDF5 counts in seconds
        paths.append(self.make("2.h5", "--threads", "3"))
        self.assertTrue(filecmp.cmp(*paths, shallow=False))


if __name__ == "__main__":
    unittest.main()
