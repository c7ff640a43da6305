"""STL and 3MF as the program named on the command line meets them before a print: admesh or prusa-slicer. Written by the
binary in ANTIGRASP_BINARY."""
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

READER = sys.argv.pop(1)
if not shutil.which(READER):
    print(f"skipped: {READER} is not installed")
    sys.exit(77)  # CTest counts and names it

BINARY = os.environ["ANTIGRASP_BINARY"]


def facets(path):
    """The corners of a binary STL file."""
    with open(path, "rb") as file:
        count, = struct.unpack("<80xI", file.read(84))
        return [struct.unpack("<12x9fxx", file.read(50)) for _ in range(count)]


def volume(path):
    total = 0.0
    for ax, ay, az, bx, by, bz, cx, cy, cz in facets(path):
        total += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    return total / 6


class Printer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        for words in (["dataset", "make", "bottles", "--count", "2", "--seed", "3", "--out", "b.h5"],
                      ["export", "b.h5", "--size-mm", "60", "--out", "stl"],
                      ["export", "b.h5", "--size-mm", "60", "--format", "3mf", "--out", "3mf"]):
            subprocess.run([BINARY, *words], cwd=cls.folder, check=True, capture_output=True)
        cls.stl = [os.path.join(cls.folder, "stl", f"bottles-00000{i}.stl") for i in range(2)]
        cls.plate = os.path.join(cls.folder, "3mf", "plate.3mf")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_well(self, *words):
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


@unittest.skipUnless(READER == "admesh", "of another reader")
class Admesh(Printer):
    def test_stl_needs_no_repair_and_has_our_volume(self):
        for path in self.stl:
            text = self.run_well("admesh", path)
            number = lambda name: float(re.search(name + r"\s*:\s*([-+.0-9e]+)", text).group(1))
            self.assertEqual(number("Number of facets"), len(facets(path)))
            self.assertEqual(number("Number of parts"), 1)
            for fault in ("Facets with 1 disconnected edge", "Total disconnected facets", "Degenerate facets",
                          "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
                          "Normals fixed"):
                self.assertEqual(number(fault), 0, fault)
            self.assertLess(abs(number("Volume") / volume(path) - 1), 1e-5)


@unittest.skipUnless(READER == "prusa-slicer", "of another reader")
class PrusaSlicer(Printer):
    def info(self, path):
        """What the slicer says of each object in the file."""
        text = self.run_well("prusa-slicer", "--info", path)
        blocks = re.split(r"^\[\S+\]$", text, flags=re.MULTILINE)[1:]
        return [dict(re.findall(r"^(\w+) =\s+(\S+)$", block, re.MULTILINE)) for block in blocks]

    def test_both_files_hold_one_part_an_object_of_our_volume_in_millimetres(self):
        said = [self.info(path)[0] for path in self.stl]
        plate = self.info(self.plate)
        self.assertEqual((len(plate), [len(self.info(path)) for path in self.stl]), (2, [1, 1]))
        for path, of_stl, of_3mf in zip(self.stl, said, plate):
            for about in (of_stl, of_3mf):
                self.assertEqual((about["manifold"], about["number_of_parts"]), ("yes", "1"))
                self.assertEqual(int(about["number_of_facets"]), len(facets(path)))
                self.assertLess(abs(float(about["volume"]) / volume(path) - 1), 1e-5)
                self.assertLess(abs(float(about["size_z"]) - 60), 1e-5)
                self.assertEqual(float(about["min_z"]), 0)

    def test_both_files_are_sliced_to_the_same_length_of_filament(self):
        used = []
        for paths in (self.stl, [self.plate]):
            millimetres = 0.0
            for i, path in enumerate(paths):
                self.run_well("prusa-slicer", "--export-gcode", "--skirts", "0", "--output", f"{i}.gcode", path)
                with open(os.path.join(self.folder, f"{i}.gcode"), encoding="utf-8") as file:
                    text = file.read()
                self.assertGreater(len(re.findall(r"^G1 .*E", text, re.MULTILINE)), 1000)
                self.assertEqual(max(float(z) for z in re.findall(r"^;Z:(\S+)", text, re.MULTILINE)) > 59, True)
                millimetres += float(re.search(r"^; filament used \[mm\] = (\S+)", text, re.MULTILINE).group(1))
            used.append(millimetres)
        self.assertLess(abs(used[0] / used[1] - 1), 0.01)  # each alone retracts less


if __name__ == "__main__":
    unittest.main()
