"""What scripts/reproduce_perturb.py makes of perturb.csv, against answers on paper."""
import math
import unittest

from scripts_path import markdown_rows

import reproduce_perturb


def row(before, after, status="ok", dexnet=None, **more):
    return {"status": status, "graspability_before": str(before), "graspability_after": str(after), "dexnet": dexnet,
            "normal_max_deg": "", "hausdorff_pct": "", "volume_change_pct": "", **more}


class Perturb(unittest.TestCase):
    def test_a_reduction_is_positive_when_graspability_falls_and_paired(self):
        # Means 2 and 1.3: 65 % are left. Residuals (0.5 - 0.65) / 2 and (2.1 - 1.95) / 2 are -+0.075; their
        # deviation is 0.075 sqrt 2, that of their mean 0.075.
        percent, half = reproduce_perturb.reduction([1, 3], [0.5, 2.1])
        self.assertAlmostEqual(percent, 35, 12)
        self.assertAlmostEqual(half, 196 * 0.075, 12)
        self.assertAlmostEqual(reproduce_perturb.reduction([1, 2], [1.5, 3])[0], -50, 12)
        self.assertTrue(math.isnan(reproduce_perturb.reduction([1], [2])[1]))

    def test_failed_objects_and_missing_numbers_are_left_out(self):
        rows = [row(1, 2, normal_max_deg="5"), row(3, "nan", status="after: open", normal_max_deg="7"), row(4, 5)]
        self.assertEqual(reproduce_perturb.numbers(rows, "graspability_before"), [1, 4])
        self.assertEqual(reproduce_perturb.row_numbers(rows, "normal_max_deg"), [5])

    def test_both_noises_have_their_own_numbers(self):
        dexnet = [{"baseline": "4", "graspability": "1"}, {"baseline": "4", "graspability": "1"}, {"baseline": "4", "graspability": ""}]
        (own, _), (other, _) = reproduce_perturb.reductions([row(2, 1, dexnet=d) for d in dexnet])
        self.assertAlmostEqual(own, 50, 12)
        self.assertAlmostEqual(other, 75, 12)

    def test_a_table_has_every_number_under_its_heading_and_a_set_in_its_place(self):
        self.assertEqual(reproduce_perturb.SETS, ("cylinders", "prisms", "bottles"))

        class Hand:
            def result(self, setting, kind):
                k = reproduce_perturb.SETS.index(kind) + 1
                good = row(10, 10 - k, dexnet={"baseline": "10", "graspability": str(5 - k)}, normal_max_deg=str(20 * k),
                           hausdorff_pct=str(0.1 * k), volume_change_pct="-4")
                grown = {**good, "volume_change_pct": "5"}
                return [row("", "", status="after: open")] * k + ([good, grown, good, grown] if k < 3 else [good])

        setting = reproduce_perturb.Setting("alpha 10", "random --alpha 10", 0.6, "32 / 12 / 32")
        self.assertEqual(setting.folder, "random-alpha-10")
        self.assertEqual(markdown_rows(reproduce_perturb.table([setting], Hand())), [{
            "setting": "alpha 10", "paper": "32 / 12 / 32", "ours, %": "10 ±0 / 20 ±0 / -",
            "at Dex-Net's noise, %": "60 ±0 / 70 ±0 / -", "largest turn of a normal": "20 / 40 / -",
            "broken, %": "20 / 33 / 75", "Hausdorff, %": "0.1 / 0.2 / -", "volume, %": "4.5 / 4.5 / -"}])


if __name__ == "__main__":
    unittest.main()
