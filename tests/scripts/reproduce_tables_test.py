"""The tables of scripts/reproduce gan, cem and ablation: every number under its heading, by hand-made results."""
import contextlib
import io
import pathlib
import tempfile
import unittest
from unittest import mock

from scripts_path import CELLS, markdown_rows, write_compare, write_statistics

import reproduce_ablation
import reproduce_cem
import reproduce_gan

NO_SURFACES = dict.fromkeys(CELLS, "-")
# Means 0.4, 0.2, 0.1, without an error but the last one's: its ratios have a half width of 12 %.
RUN = [{"stage": -1, "samples": 100, "ok": 100, "graspability": 0.4, "half_width_95": 0},
       {"stage": 0, "samples": 200, "ok": 190, "disjoint": 7, "touches_border": 3, "graspability": 0.2, "half_width_95": 0},
       {"stage": 2, "samples": 50, "ok": 40, "non_manifold": 9, "gaps": 1, "graspability": 0.1, "half_width_95": 0.012}]
CONTROL = [{"stage": 2, "samples": 80, "ok": 60, "empty": 20, "graspability": 0.25, "half_width_95": 0}]


class Tables(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.results = pathlib.Path(temporary.name) / "results"
        write_statistics(self.results, RUN)
        write_statistics(self.results / "control", CONTROL)
        write_compare(self.results, 0)
        self.run_2 = reproduce_gan.Run("r", "cylinders", 2, 22)

    def test_of_a_run_names_every_stage_with_its_references(self):
        rows = markdown_rows(reproduce_gan.stage_table(self.run_2, self.results))
        kappas = ("kappa / prior", "kappa / episode 0", "kappa / control")
        self.assertEqual(rows[0], {"stage": "prior set", "rejected": "0.0 %", **dict(zip(kappas, ("1", "-", "-"))), **NO_SURFACES,
                                   "diversity": "1", "Vendi score": "61", "roughness, degrees": "8.1"})
        self.assertEqual(rows[1], {"stage": "episode 0", "rejected": "5.0 % (3 touches border, 7 disjoint)",
                                   **dict(zip(kappas, ("0.50 ±0.00", "1.00 ±0.00", "-"))), **CELLS})
        self.assertEqual(rows[2], {"stage": "episode 2", "rejected": "20.0 % (1 gaps, 9 non manifold)",
                                   **dict(zip(kappas, ("0.25 ±0.03", "0.50 ±0.06", "0.40 ±0.05"))), **NO_SURFACES})
        self.assertEqual(rows[3], {"stage": "control, episode 2", "rejected": "25.0 % (20 empty)",
                                   **dict(zip(kappas, ("0.62 ±0.00", "1.25 ±0.00", "-"))), **NO_SURFACES})
        self.assertEqual(len(rows), 4)

    def test_of_a_run_compare_every_episode_with_the_same_one_of_the_control(self):
        write_statistics(self.results, [*RUN[:2], {"stage": 1, "samples": 9, "ok": 9, "graspability": 0.3, "half_width_95": 0}, RUN[2]])
        write_statistics(self.results / "control",
                         [{"stage": 1, "samples": 8, "ok": 8, "graspability": 0.6, "half_width_95": 0}, *CONTROL])
        rows = markdown_rows(reproduce_gan.stage_table(self.run_2, self.results))
        self.assertEqual([(row["stage"], row["kappa / control"]) for row in rows],
                         [("prior set", "-"), ("episode 0", "-"), ("episode 1", "0.50 ±0.00"), ("episode 2", "0.40 ±0.05"),
                          ("control, episode 2", "-")])

    def test_of_a_run_come_with_a_sentence_that_counts_losses_as_positive(self):
        self.assertEqual(reproduce_gan.reduction(self.run_2, self.results),
                         "After 2 resampling iterations kappa is lower by 75 ±3 % against the prior set, 50 ±6 % against episode 0, "
                         "60 ±5 % against the control (the paper: 22 %).")

    def test_of_the_ways_to_choose_elites_stand_beside_the_control(self):
        other = self.results.parent / "control-way"
        write_statistics(other, [RUN[0], {**RUN[1]}, {**CONTROL[0]}])
        (self.results / "episode_0/qd.txt").write_text("0.254\n")
        rows = markdown_rows(reproduce_cem.table({"paper": self.results, "control": other}))
        expected = [("paper", "0", "0.50 ±0.00", "-", "5%", CELLS, "0.041"),
                    ("paper", "2", "0.25 ±0.03", "0.40 ±0.05", "20%", NO_SURFACES, "-"),
                    ("control", "0", "0.50 ±0.00", "-", "5%", NO_SURFACES, "-"),
                    ("control", "2", "0.62 ±0.00", "-", "25%", NO_SURFACES, "-")]
        for row, (way, episode, prior, control, rejected, surfaces, nearest) in zip(rows, expected, strict=True):
            self.assertEqual(row, {"elites": way, "episode": episode, "kappa / prior": prior, "kappa / control": control,
                                   "rejected": rejected, **surfaces, "to the nearest prior shape": nearest,
                                   "QD score": "0.25" if (way, episode) == ("paper", "0") else "-"})

    def test_of_the_ablation_hold_one_row_a_variant_that_was_run(self):
        document = self.results.parent / "training.md"
        with mock.patch.object(reproduce_ablation, "DOCUMENT", document), \
                mock.patch.object(reproduce_ablation, "RESULTS", self.results.parent), \
                contextlib.redirect_stdout(io.StringIO()):
            folder = reproduce_ablation.results_of("no batch norm")
            self.assertEqual(folder, self.results.parent / "ablation/no-batch-norm")
            write_statistics(folder, RUN)
            write_compare(folder, 0)
            reproduce_ablation.document()
        table = [line for line in document.read_text().split("\n") if line.startswith("|")]
        self.assertEqual(markdown_rows("\n".join(table)),
                         [{"variant": "no batch norm", "rejected": "5.0%", "kappa / prior": "0.50 ±0.00", **CELLS,
                           "near-duplicates": "7%"}])


if __name__ == "__main__":
    unittest.main()
