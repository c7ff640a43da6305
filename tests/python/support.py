"""What the tests of the Python package share: a lopsided block, and the program to compare with."""
import csv
import io
import os
import pathlib
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
FACES = numpy.array([[0, 3, 2], [0, 2, 1], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7],
                     [2, 7, 6], [3, 0, 4], [3, 4, 7]])


def corners(x=60.0, y=40.0, z=25.0):
    """Of a block with the origin in a corner."""
    return numpy.array([[i, j, k] for k in (0, z) for i, j in ((0, 0), (x, 0), (x, y), (0, y))])


def obj(vertices, faces=FACES):
    return "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()) + "".join(
        f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces.tolist())


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "block.obj").write_text(obj(corners()))
        self.block = str(self.folder / "block.obj")

    def run_program(self, *arguments):
        return subprocess.run([BINARY, *map(str, arguments)], check=True, capture_output=True, text=True,
                              cwd=self.folder).stdout

    def refusal(self, *arguments):
        """The line that the program says without its name."""
        done = subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr.strip().removeprefix("antigrasp: ")

    def rows(self, table):
        """Of a file of the folder, or of a text."""
        text = table if "\n" in table else (self.folder / table).read_text()
        return list(csv.DictReader(io.StringIO(text)))


def vectors(rows, *names):
    """[rows, len(names), 3] of the columns name + x, y, z."""
    return numpy.array([[[float(row[name + axis]) for axis in "xyz"] for name in names] for row in rows])


def column(rows, name):
    return numpy.array([float(row[name]) for row in rows])
