"""What scripts/reproduce_judge.py runs and writes, against answers on paper."""
import pathlib
import tempfile
import unittest

import scripts_path  # noqa: F401

import reproduce_judge

HEAD = "protocol,masses,friction,stage,grasps,objects,held,held_half_width,held_before,pairs,difference,difference_half_width\n"


class Judge(unittest.TestCase):
    def study(self, out):
        return reproduce_judge.Study(pathlib.Path(out), 3, 20, (0.25, 0.5), (5, 12), ("prisms",))

    def test_every_call_of_the_binary_makes_something_of_its_own(self):
        jobs = self.study("out").jobs()
        made = {job.target for job in jobs if job.arguments[0] == "perturb"}
        tried = [job.target for job in jobs if job.arguments[0] == "trial"]
        # On the judge and on the metric at two distances and two frictions, and two others once.
        self.assertEqual(len(made), 2 * 2 * 2 + 2)
        self.assertEqual(len(tried), len(set(tried)))
        self.assertEqual(len(tried), 2 * (2 + 2 + 2))

    def test_a_judgement_is_not_by_the_draws_of_the_search(self):
        for job in self.study("out").jobs():
            if job.arguments[0] == "trial":
                self.assertEqual(job.arguments[job.arguments.index("--seed") + 1], 2)
            if job.arguments[0] == "perturb":
                self.assertNotIn("--seed", job.arguments)

    def test_rows_are_those_of_equal_mass_and_no_number_is_a_dash(self):
        with tempfile.TemporaryDirectory() as temporary:
            table = pathlib.Path(temporary) / "means.csv"
            table.write_text(HEAD + "six-ways,own,0.25,1 g,all,3,1,1,1,3,1,1\nsix-ways,equal,0.25,1 g,all,3,40.25,5,70,3,-29.75,6.04\n"
                             "six-ways,equal,0.25,,candidates kept,3,1.5,0.2,9,,,\n")
            rows = reproduce_judge.read_means(table)
            perturbed = pathlib.Path(temporary) / "perturb.csv"
            perturbed.write_text("object,status,normal_mean_deg\na,ok,10\nb,ok,21\nc,no_grasps,\n")
            turned = reproduce_judge.mean_turn(perturbed)
        shape = {"hausdorff_pct": "4.96", "volume_pct": "7", "reduction_pct": ""}
        row = {"held": rows["1 g", "all"], "kept": rows["", "candidates kept"], "shape": shape, "turned": turned}
        self.assertEqual(reproduce_judge.table_line("prisms", "search, 5 %", row),
                         "| prisms | search, 5 % | 5.0 | 16 | 7.0 | - | 70.0 | 40.2 | -29.8 +-6.0 | 9.0 -> 1.5 |")


if __name__ == "__main__":
    unittest.main()
