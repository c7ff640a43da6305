"""examples/judge/antipodal_judge.py, alone on solids known on paper and behind `antigrasp evaluate --judge`."""
import csv
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)  # CTest counts and names it

JUDGE = pathlib.Path(__file__).parents[2] / "examples/judge/antipodal_judge.py"
BOX = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
BOX_FACES = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
             (1, 3, 7), (1, 7, 5)]
TETRAHEDRON = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
TETRAHEDRON_FACES = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]


def write_stl(path, corners, faces):
    with open(path, "wb") as file:
        file.write(b"\0" * 80 + struct.pack("<I", len(faces)))
        for face in faces:
            file.write(struct.pack("<3f", 0, 0, 0) + b"".join(struct.pack("<3f", *corners[i]) for i in face) + b"\0\0")


class AntipodalJudge(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        # 40 x 40 x 40, and 40 x 60 x 60: of the second one pair of faces is within 50 mm, 2 x 3600 of 2 x 3600 + 4 x 2400.
        write_stl(self.path / "cube.stl", [tuple(40 * c for c in p) for p in BOX], BOX_FACES)
        write_stl(self.path / "plate.stl", [(40 * x, 60 * y, 60 * z) for x, y, z in BOX], BOX_FACES)
        write_stl(self.path / "tetrahedron.stl", [tuple(20 * c for c in p) for p in TETRAHEDRON], TETRAHEDRON_FACES)
        self.names = ["cube", "plate", "tetrahedron"]

    def tearDown(self):
        self.folder.cleanup()

    def expect(self, scores):
        self.assertEqual(scores[0], 1)
        self.assertAlmostEqual(scores[1], 7200 / 16800, delta=0.2)  # 64 points: 3 deviations
        self.assertEqual(scores[2], 0)

    def test_says_what_is_known_on_paper(self):
        lines = [json.dumps({"id": 7 + i, "name": name, "mesh": str(self.path / (name + ".stl")), "metres_per_unit": 0.001})
                 for i, name in enumerate(self.names)]
        said = subprocess.run(["/usr/bin/python3", str(JUDGE)], input="\n".join(lines) + "\n", capture_output=True, text=True,
                              check=True).stdout.splitlines()
        answers = [json.loads(line) for line in said]
        self.assertEqual([answer["id"] for answer in answers], [7, 8, 9])
        self.expect([answer["score"] for answer in answers])

    def test_scores_behind_evaluate(self):
        out = self.path / "scores.csv"
        subprocess.run([os.environ["ANTIGRASP_BINARY"], "evaluate", *(str(self.path / (n + ".stl")) for n in self.names),
                        "--units", "mm", "--true-size", "--num-grasps", "5", "--judge", f"/usr/bin/python3 '{JUDGE}'", "--out",
                        str(out)], check=True, capture_output=True)
        with open(out, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["judge_status"] for row in rows], ["ok"] * 3)
        self.expect([float(row["judge"]) for row in rows])


if __name__ == "__main__":
    unittest.main()
