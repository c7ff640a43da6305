"""What scripts/reproduce_perturb.py makes of perturb.csv, against answers on paper."""
import pathlib
import tempfile
import unittest
from unittest import mock

from scripts_path import markdown_rows

import reproduce_document
import reproduce_perturb

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


def row(ok, reduction, half_width, turn="", hausdorff="", volume=""):
    return {"objects": "4", "ok": str(ok), "reduction_pct": reduction, "reduction_half_width_95": half_width, "normal_max_deg": turn,
            "hausdorff_pct": hausdorff, "volume_pct": volume}


class Perturb(unittest.TestCase):
    def test_the_means_are_those_that_the_binary_finds_in_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            # Means 2 and 1.3: 65 % are left. Residuals (0.5 - 0.65) / 2 and (2.1 - 1.95) / 2 are -+0.075; their
            # deviation is 0.075 sqrt 2, that of their mean 0.075.
            pathlib.Path(folder, "perturb.csv").write_text(
                "object,status,graspability_before,graspability_after,normal_max_deg,hausdorff_pct,volume_change_pct\n"
                "a,ok,1,0.5,5,0.5,-3\nb,after: open,9,,7,8,9\nc,ok,3,2.1,,1.5,4\n")
            found, = reproduce_document.means(folder)
        self.assertEqual((found["objects"], found["ok"], found["normal_max_deg"], found["hausdorff_pct"], found["volume_pct"]),
                         ("3", "2", "5", "1", "3.5"))
        self.assertAlmostEqual(float(found["reduction_pct"]), 35, 12)
        self.assertAlmostEqual(float(found["reduction_half_width_95"]), 195.996 * 0.075, 2)

    def test_a_table_has_every_number_under_its_heading_and_a_set_in_its_place(self):
        self.assertEqual(reproduce_perturb.SETS, ("cylinders", "prisms", "bottles"))

        class Hand:
            def result(self, setting, kind):
                k = reproduce_perturb.SETS.index(kind) + 1
                ok = 5 - k
                return (row(ok, str(10.2 * k), str(0.6 * k), "" if k == 2 else "20.4", str(0.11 * k), "4.46"),
                        row(ok, str(50.3 + k), str(2.7 + k)))

        setting = reproduce_perturb.Setting("alpha 10", "random --alpha 10", 0.6, "32 / 12 / 32")
        self.assertEqual(setting.folder, "random-alpha-10")
        self.assertEqual(markdown_rows(reproduce_perturb.table([setting], Hand())), [{
            "setting": "alpha 10", "paper": "32 / 12 / 32", "ours, %": "10 ±1 / 20 ±1 / -",
            "at Dex-Net's noise, %": "51 ±4 / 52 ±5 / -", "largest turn of a normal": "20 / - / -",
            "broken, %": "0 / 25 / 50", "Hausdorff, %": "0.1 / 0.2 / -", "volume, %": "4.5 / 4.5 / -"}])

    def test_the_quick_way_writes_a_page_and_pictures_of_its_own(self):
        published = {path: path.read_bytes() for path in DOCS.rglob("*") if path.is_file()}
        calls = []

        def call(*arguments):
            calls.append([str(argument) for argument in arguments])
            return ""

        with tempfile.TemporaryDirectory() as folder, \
                mock.patch.multiple(reproduce_perturb, call=call, table=lambda settings, runner: "A table.",
                                    figure_1=lambda path, runner: path.touch()):
            reproduce_perturb.main(["analytic", "--quick", "--out", folder])
            own = pathlib.Path(folder, "20")
            page = (own / "analytic.md").read_text()
            self.assertTrue((own / "images/analytic_exhaustive.png").exists())
        self.assertIn("`scripts/reproduce analytic --quick`, commit ", page)
        self.assertIn(", 20 objects a set, ", page)
        self.assertIn("(images/analytic_random_bottles.png)", page)
        makes = [line for line in calls if line[:2] == ["dataset", "make"]]
        self.assertEqual([line[2:5] for line in makes], [[kind, "--count", "20"] for kind in reproduce_perturb.SETS])
        pictures = [line[line.index("--out") + 1] for line in calls if line[0] in ("figure", "sheet")]
        self.assertEqual(len(pictures), 7)
        for path in pictures:
            self.assertEqual(pathlib.Path(path).parent, own / "images")
        self.assertEqual({path: path.read_bytes() for path in DOCS.rglob("*") if path.is_file()}, published)
        with self.assertRaises(SystemExit), mock.patch("sys.stderr"):
            reproduce_perturb.main(["readings", "--quick"])


if __name__ == "__main__":
    unittest.main()
