"""docs/formats.md says what the files hold: its code runs, and its lists of attributes and columns are those of files that
the binary in ANTIGRASP_BINARY writes."""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    print("skipped: h5py is not installed")
    sys.exit(77)  # CTest counts and names it

BINARY = os.environ["ANTIGRASP_BINARY"]
DOCUMENT = (pathlib.Path(__file__).parents[2] / "docs/formats.md").read_text(encoding="utf-8")
CUBE = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
GRASP = ("p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz\n"
         "-0.02,0,0,-1,0,0,0.02,0,0,1,0,0,0,0,0\n")
TRIAL = ["--engine", "model", "--series", "1", "--grasps-per-series", "1", "--executions", "1"]
QUICK = ["--num-grasps", "20", "--num-draws", "3"]


def section(title):
    """The text from the heading that begins with the title up to the next one of its rank or above."""
    begin = re.search(rf"^## {re.escape(title)}.*$", DOCUMENT, re.MULTILINE)
    end = re.search(r"^##? ", DOCUMENT[begin.end():], re.MULTILINE)
    return DOCUMENT[begin.start():begin.end() + end.start() if end else None]


def codes(text):
    return re.findall(r"`([^`]*)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))


def cell_names(text):
    return [name for code in codes(text) for name in code.split(", ")]


def listed_columns(text):
    """What a table "| column | meaning |" has in its first column."""
    rows = text[text.index("| column | meaning |"):].split("\n\n")[0].splitlines()[2:]
    return [name for row in rows for name in cell_names(row.split(" | ")[0])]


def expanded(names):
    """`p1*` is p1x p1y p1z, `axis_*` its three, `r00 ... r22` its nine."""
    for name in names:
        if name.endswith("*"):
            yield from (name[:-1] + axis for axis in "xyz")
        elif name == "r00 ... r22":
            yield from (f"r{row}{column}" for row in range(3) for column in range(3))
        else:
            yield name


def without_judge(columns):
    """Less those that only the search on a judge writes."""
    return [name for name in columns if not name.startswith("judge")]


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = pathlib.Path(cls.folder.name)
        (cls.path / "box.obj").write_text(CUBE)
        (cls.path / "open.obj").write_text(CUBE.rsplit("f", 1)[0])
        (cls.path / "contacts.csv").write_text(GRASP)
        cls.call("dataset", "make", "cylinders", "--count", "2", "--out", "batch.h5")
        cls.call("dataset", "import", "batch.h5", "--out", "set.npz")
        cls.call("evaluate", "batch.h5", "box.obj", "open.obj", "--out", "scores.csv", "--grasps", "grasps.csv", *QUICK)

    @classmethod
    def call(cls, *words):
        done = subprocess.run([BINARY, *words], cwd=cls.path, capture_output=True, text=True)
        if done.returncode:
            raise AssertionError(f"{words}: exit {done.returncode}\n{done.stderr}")

    def header(self, name):
        with open(self.path / name, newline="", encoding="utf-8") as file:
            return next(csv.reader(file))

    def test_its_python_runs_and_reads_what_the_files_hold(self):
        names = {}
        before = os.getcwd()
        os.chdir(self.path)
        try:
            for block in re.findall(r"```python\n(.*?)```", DOCUMENT, re.DOTALL):
                exec(block, names)
        finally:
            os.chdir(before)
        self.assertEqual(len(names["scores"]), 4)
        self.assertEqual(len(names["scored"]), 3)  # the open box has an empty cell
        self.assertEqual(str(names["scores"]["open.obj"]), "nan")
        self.assertGreater(names["mean"], 0)
        self.assertEqual(names["about"]["kind"], "cylinders")
        self.assertEqual(names["meaning"]["unit"], "side of the unit cube")
        self.assertEqual(names["names"], ["cylinders-000000", "cylinders-000001"])
        # Node (x, y, z) = (4, 8, 16) of 32: -0.5 + (2 i + 1) / 64.
        self.assertEqual(list(names["node"]), [-0.359375, -0.234375, 0.015625])
        self.assertEqual(names["solid"].shape, (32, 32, 32))
        self.call("dataset", "import", "mine.npz", "--out", "mine.h5")  # which the last one wrote
        with h5py.File(self.path / "mine.h5") as file:
            self.assertEqual([name.decode() for name in file["names"]], ["shape 0", "shape 1"])
            self.assertEqual(file.attrs["kind"], b"import")

    def test_an_sdf_file_has_the_listed_objects_and_attributes_and_no_others(self):
        rows = dict(re.findall(r"^\| `([^`]*)` \| (.*?) \|", section("SDF file"), re.MULTILINE))

        def held(path):
            with h5py.File(self.path / path) as file:
                yield from (f"@{name}" for name in file.attrs)
                for key in file:
                    yield from (f"/{key}", *(f"/{key}@{name}" for name in file[key].attrs))

        self.call("dataset", "import", "box.obj", "--out", "imported.h5")
        self.assertEqual(sorted(rows), sorted(held("imported.h5")))
        self.assertEqual(sorted(name for name, kind in rows.items() if "optional" not in kind), sorted(held("batch.h5")))

    def test_the_tables_have_the_listed_columns_and_no_others(self):
        self.call("perturb", "random", "batch.h5", "--iterations", "3", "--history", "--out", "p", *QUICK)
        self.call("export", "batch.h5", "--out", "e")
        self.assertEqual(without_judge(listed_columns(section("Perturbed objects"))), self.header("p/perturb.csv"))
        self.assertEqual(list(expanded(listed_columns(section("Print check")))), self.header("e/print.csv"))
        self.call("bundle", "box.obj", "open.obj", "--out", "b")
        self.assertEqual(list(expanded(listed_columns(section("Bundles")))), self.header("b/bundle.csv"))
        means = section("Means")
        self.assertEqual(without_judge(listed_columns(means[means.index("Of perturbed objects"):])), self.header("p/summary.csv"))

    def test_the_tables_of_a_trial_have_the_listed_columns_in_their_order(self):
        words = ["trial", "box.obj", "--num-grasps", "1", "--num-draws", "1", "--draws", "1", "--out", "t"]
        done = subprocess.run([BINARY, *words], cwd=self.path, capture_output=True, text=True)
        if "MuJoCo" in done.stderr and done.returncode:
            self.skipTest("a build without MuJoCo")
        self.assertEqual(done.returncode, 0, done.stderr)
        for table in ("trials.csv", "means.csv", "executions.csv"):
            listed = listed_columns(DOCUMENT[DOCUMENT.index(f"Columns of `{table}`:"):])
            self.assertEqual(listed, self.header(f"t/{table}"))

    def test_every_list_of_columns_in_a_sentence_is_that_of_a_file(self):
        self.call("remesh", "batch.h5", "--out", "m")
        self.call("perturb", "random", "batch.h5", "--iterations", "3", "--history", "--out", "h", *QUICK)
        self.call("dataset", "import", "box.obj", "--out", "i.h5", "--report", "i.csv")
        self.call("compare", "batch.h5", "batch.h5", "--out", "c.csv")
        self.call("poses", "box.obj", "--out", "poses.csv")
        self.call("trial", "box.obj", *TRIAL, "--num-draws", "1", "--out", "trial.csv")
        self.call("quality", "contacts.csv", "--out", "q.csv")
        lists = [list(expanded(re.split(", ?", code))) for code in codes(DOCUMENT)]
        for table in ("m/remesh.csv", "h/history.csv", "i.csv", "c.csv", "poses.csv", "trial.csv", "q.csv", "scores.csv"):
            header = self.header(table)
            # A list that goes on ("...") names columns that are there at some constants only.
            said = any(header == names or names[-1] == "..." and header == names[:len(header)] for names in lists)
            self.assertTrue(said, f"{table}: {', '.join(header)}")
        grasps = section("Scores")
        said = set(expanded(cell_names(grasps[grasps.index("`--grasps grasps.csv`"):])))
        self.assertEqual(set(self.header("grasps.csv")) - said, set())


if __name__ == "__main__":
    unittest.main()
