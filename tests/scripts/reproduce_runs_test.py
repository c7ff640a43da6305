"""What scripts/reproduce_runs.py and reproduce_document.py compute, against answers on paper."""
import pathlib
import tempfile
import unittest

from scripts_path import CELLS, write_compare, write_statistics

import reproduce_document
import reproduce_runs


class Runs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def test_kappa_is_what_the_binary_says_of_a_stage_and_a_reference(self):
        # 3 / 4; relative half widths 0.3 / 3 = 0.1 and 0.8 / 4 = 0.2 add in squares to the root of 0.05. By episode 0
        # 3 / 6, by the control's episode 2 3 / 5, both references without an error.
        write_statistics(self.folder, [{"stage": -1, "graspability": 4, "half_width_95": 0.8}, {"stage": 0, "graspability": 6},
                                       {"stage": 2, "graspability": 3, "half_width_95": 0.3}])
        write_statistics(self.folder / "control", [{"stage": 2, "graspability": 5}])
        write_statistics(self.folder / "other", [{"stage": 2, "graspability": 2}])
        found = reproduce_runs.kappas(self.folder)
        self.assertEqual(list(found), [(False, -1), (False, 0), (False, 2), (True, 2)])
        value, half = reproduce_runs.kappa(found[False, 2], "prior")
        self.assertAlmostEqual(value, 0.75, 15)
        self.assertAlmostEqual(half, 0.75 * 0.05 ** 0.5, 15)
        self.assertEqual(reproduce_runs.shown((value, half)), "0.75 ±0.17")
        self.assertEqual(reproduce_runs.shown(reproduce_runs.kappa(found[False, 2], "episode_0")), "0.50 ±0.05")
        self.assertEqual(reproduce_runs.shown(reproduce_runs.kappa(found[False, 2], "control")), "0.60 ±0.06")
        self.assertEqual(reproduce_runs.shown(reproduce_runs.kappa(found[True, 2], "control")), "-")
        beside = reproduce_runs.kappas(self.folder, self.folder / "other")
        self.assertEqual(reproduce_runs.shown(reproduce_runs.kappa(beside[False, 2], "control")), "1.50 ±0.15")

    def test_rows_are_found_by_their_stage(self):
        self.assertEqual(reproduce_runs.rows_of(self.folder), {})
        write_statistics(self.folder, [{"stage": -1, "graspability": 0.4}, {"stage": 0, "graspability": 0.3},
                                       {"stage": 2, "graspability": 0.1}])
        found = {stage: row["graspability"] for stage, row in reproduce_runs.rows_of(self.folder).items()}
        self.assertEqual(found, {-1: "0.4", 0: "0.3", 2: "0.1"})

    def test_every_measure_stands_under_its_heading(self):
        self.assertEqual(reproduce_runs.surfaces(self.folder, 3), {})
        write_compare(self.folder, 3)
        measured = reproduce_runs.surfaces(self.folder, 3)
        self.assertEqual(measured["vendi"], (44.4, 60.8))
        self.assertTrue(measured["coverage"][1] != measured["coverage"][1], "nan: not there")
        cells = reproduce_runs.surface_cells(measured).split(" | ")
        self.assertEqual(dict(zip(reproduce_runs.SURFACE_COLUMNS, cells)), CELLS)
        self.assertEqual(len(cells), len(CELLS))
        self.assertEqual(reproduce_runs.surface_cells({}).split(" | "), ["-"] * len(CELLS))
        for measure in ("nna_normals", "flat_share", "crease_share"):  # runs of before they were taken
            del measured[measure]
        self.assertEqual([cell for cell in reproduce_runs.surface_cells(measured).split(" | ") if cell == "-"], ["-"] * 3)

    def test_the_numbers_of_a_run_and_of_its_control_are_kept_apart(self):
        run, results = self.folder / "run", self.folder / "results"
        write_statistics(run, [{"stage": 0, "samples": 1}])
        write_statistics(run / "control", [{"stage": 0, "samples": 2}])
        write_compare(run, 1)
        (run / "episode_1/checkpoint.pt").write_text("large")
        reproduce_runs.keep(run, results)
        self.assertEqual(reproduce_runs.rows_of(results)[0]["samples"], "1")
        self.assertEqual(reproduce_runs.rows_of(results / "control")[0]["samples"], "2")
        self.assertEqual(sorted(str(p.relative_to(results)) for p in results.rglob("*") if p.is_file()),
                         ["control/statistics.csv", "episode_1/compare.csv", "statistics.csv"])

    def test_a_section_is_written_once_and_leaves_the_others_alone(self):
        document = self.folder / "d.md"
        for name, text in (("one", "\nfirst\n"), ("two", "second"), ("one", r"anew \1")):
            reproduce_document.write_section(name, text, document)
        self.assertEqual(document.read_text(), "# Reproduction\n\n<!-- begin one -->\nanew \\1\n<!-- end one -->\n\n"
                                               "<!-- begin two -->\nsecond\n<!-- end two -->\n")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["d.md"])


if __name__ == "__main__":
    unittest.main()
