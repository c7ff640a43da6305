"""A set that `antigrasp dataset pair` wrote, read by Python's csv and a reader of OBJ that is not ours, as docs/formats.md
("Pairs of objects") says."""
import csv
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

DOCUMENT = (pathlib.Path(__file__).parents[2] / "docs/formats.md").read_text(encoding="utf-8")


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def read_obj(path):
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return vertices, faces


def volume(vertices, faces):
    """By the divergence theorem."""
    total = 0.0
    for i, j, k in faces:
        (a, b, c), (d, e, f), (g, h, m) = vertices[i], vertices[j], vertices[k]
        total += (a * (e * m - f * h) - b * (d * m - f * g) + c * (d * h - e * g)) / 6
    return total


def documented(table):
    """The names in the first column of the table under its heading."""
    section = DOCUMENT[DOCUMENT.index("## Pairs of objects"):]
    section = section[:section.index("\n## ", 4)]
    part = section[section.index(f"Columns of {table}"):].split("\n\n")[1]
    names = []
    for line in part.splitlines()[2:]:
        names += re.findall(r"`([^`]*)`", line.split("|")[1])
    return [name for cell in names for name in cell.split(", ")]


class Pairs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        folder = pathlib.Path(cls.temporary.name)

        def call(*words):
            subprocess.run([os.environ["ANTIGRASP_BINARY"], *words], cwd=folder, check=True, capture_output=True)

        call("dataset", "make", "prisms", "--count", "5", "--seed", "3", "--out", "p.h5")
        call("perturb", "random", "p.h5", "--out", "changed", "--num-grasps", "5", "--num-draws", "1", "--iterations", "50")
        call("dataset", "pair", "changed/before", "changed/after", "--out", "set", "--num-grasps", "5", "--draws", "2",
             "--num-draws", "2", "--train", "0.6", "--val", "0.2", "--license", "CC-BY-4.0")
        cls.set = folder / "set"
        cls.objects = rows(cls.set / "objects.csv")

    def test_columns_are_those_of_the_document(self):
        self.assertEqual(list(self.objects[0]), documented("`objects.csv`"))
        for side in ("before", "after"):
            self.assertEqual(list(rows(self.set / f"grasps_{side}.csv")[0]), documented("`grasps_before.csv`"))

    def test_meshes_are_closed_solids_of_the_volume_that_the_table_says(self):
        self.assertEqual(len(self.objects), 10)
        for row in self.objects:
            self.assertEqual(row["status"], "ok")
            vertices, faces = read_obj(self.set / row["mesh"])
            self.assertEqual(len(faces), int(row["triangles"]))
            edges = [(f[i], f[(i + 1) % 3]) for f in faces for i in range(3)]
            self.assertEqual(len(set(edges)), len(edges))
            self.assertEqual(set(edges), {(b, a) for a, b in edges})
            self.assertAlmostEqual(volume(vertices, faces) / float(row["volume"]), 1, 9)

    def test_a_split_holds_whole_pairs(self):
        split = {}
        for row in self.objects:
            self.assertEqual(split.setdefault(row["object"], row["split"]), row["split"])
        self.assertEqual(sorted(split.values()), ["test", "train", "train", "train", "val"])
        for side in ("before", "after"):
            for grasp in rows(self.set / f"grasps_{side}.csv"):
                self.assertEqual(grasp["split"], split[grasp["object"]])

    def test_the_label_of_an_object_is_the_mean_of_its_grasps(self):
        for side in ("before", "after"):
            held = {}
            for grasp in rows(self.set / f"grasps_{side}.csv"):
                held.setdefault(grasp["object"], []).append(float(grasp["held"]))
            for row in self.objects:
                if row["side"] == side and row["object"] in held:
                    mean = sum(held[row["object"]]) / len(held[row["object"]])
                    self.assertAlmostEqual(float(row["held"]), mean, 12)

    def test_grasps_lie_in_their_meshes(self):
        for side in ("before", "after"):
            mesh = {row["object"]: row["mesh"] for row in self.objects if row["side"] == side}
            for grasp in rows(self.set / f"grasps_{side}.csv"):
                vertices, _ = read_obj(self.set / mesh[grasp["object"]])
                for axis, name in enumerate("xyz"):
                    values = [vertex[axis] for vertex in vertices]
                    self.assertLessEqual(min(values), float(grasp[f"center_{name}"]))
                    self.assertGreaterEqual(max(values), float(grasp[f"center_{name}"]))

    def test_the_datasheet_states_judges_splits_and_licence(self):
        text = (self.set / "datasheet.md").read_text()
        for words in ("## Judges", "5 pairs (", "3 train", "## Licence\n\nCC-BY-4.0", "No robot ran"):
            self.assertIn(words, text)


if __name__ == "__main__":
    unittest.main()
