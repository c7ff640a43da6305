"""antigrasp.evaluate, evaluate_grasps, epsilon and Metric give the digits of the program."""
import unittest
import warnings

from support import FACES, Files, column, corners, numpy, obj, vectors

import antigrasp
from antigrasp import InputError, Mesh, Metric

QUICK = ["--num-grasps", "20", "--num-draws", "3"]
SCORES = {"graspability": "graspability", "mean": "mean", "fraction_nonzero": "fraction_nonzero",
          "metres_per_unit": "metres_per_unit"}


def line_of(call):
    try:
        call()
    except InputError as error:
        return str(error)
    return None


class Evaluate(Files):
    def setUp(self):
        super().setUp()
        (self.folder / "tower.obj").write_text(obj(corners(30, 45, 70)))
        self.quick = Metric(num_grasps=20, num_draws=3)

    def assert_row(self, score, row):
        self.assertEqual((score.name, score.status), (row["object"], row["status"]))
        for name, attribute in SCORES.items():
            self.assertEqual(getattr(score, attribute), float(row[name]), name)
        self.assertEqual(score.interval, (float(row["ci_low"]), float(row["ci_high"])))
        self.assertEqual(len(score.grasps), int(row["num_grasps"]))

    def test_scores_and_grasps_are_those_of_the_program(self):
        self.run_program("evaluate", "block.obj", "tower.obj", *QUICK, "--seed", 7, "--out", "s.csv", "--grasps", "g.csv")
        scores = antigrasp.evaluate([self.block, self.folder / "tower.obj"], self.quick, seed=7)
        rows, grasps = self.rows("s.csv"), self.rows("g.csv")
        self.assertEqual(len(rows), 2)
        for score, row in zip(scores, rows):
            self.assert_row(score, row)
            own = [one for one in grasps if one["object"] == score.name]
            found = score.grasps
            numpy.testing.assert_array_equal(found.contacts, vectors(own, "p1", "p2"))
            numpy.testing.assert_array_equal(found.normals, vectors(own, "n1", "n2"))
            numpy.testing.assert_array_equal(found.axes, vectors(own, "axis_")[:, 0])
            numpy.testing.assert_array_equal(found.approaches, vectors(own, "approach_")[:, 0])
            numpy.testing.assert_array_equal(found.qualities, column(own, "robust_quality"))
            numpy.testing.assert_array_equal(found.widths, column(own, "width"))
            numpy.testing.assert_array_equal(found.candidates, column(own, "candidate"))

    def test_one_object_gets_as_many_grasps_as_of_the_program_and_the_digits_do_not_depend_on_threads(self):
        row, = self.rows(self.run_program("evaluate", "block.obj"))
        for threads in (1, 3):
            score = antigrasp.evaluate(self.block, threads=threads)
            self.assertEqual(len(score.grasps), 1000)
            self.assert_row(score, row)

    def test_presets_grippers_true_size_and_units_are_those_of_the_program(self):
        for metric, flags in ((Metric("settled", friction=.3), ["--preset", "settled", "--friction", "0.3"]),
                              (Metric(gripper="panda", noise="none", num_grasps=30),
                               ["--gripper", "panda", "--noise", "none", "--num-grasps", "30"]),
                              (Metric(true_size=True, units="mm", num_grasps=30),
                               ["--true-size", "--units", "mm", "--num-grasps", "30"])):
            with self.subTest(flags):
                row, = self.rows(self.run_program("evaluate", "block.obj", *flags))
                self.assert_row(antigrasp.evaluate(self.block, metric), row)

    def test_arrays_score_as_the_file_of_their_name(self):
        named = antigrasp.evaluate(Mesh(corners(), FACES, name="block.stl"), self.quick).graspability
        self.assertEqual(named, antigrasp.evaluate(self.block, self.quick).graspability)
        self.assertNotEqual(named, antigrasp.evaluate(Mesh(corners(), FACES), self.quick).graspability)

    def test_of_a_list_the_unusable_have_a_status_and_of_none_usable_it_says_why(self):
        bowl = Mesh(corners(), FACES[1:], name="bowl")
        good, bad = antigrasp.evaluate([self.block, bowl], self.quick)
        self.assertEqual((good.status, bad.status), ("ok", "open: 3 boundary edges"))
        self.assertTrue(numpy.isnan(bad.graspability))
        self.assertEqual(len(bad.grasps), 0)
        self.assertEqual(bad.grasps.contacts.shape, (0, 2, 3))
        self.assertEqual(line_of(lambda: antigrasp.evaluate(bowl)),
                         "no object scored; bowl: open: 3 boundary edges (evaluate): expected a closed solid")

    def test_grasps_outlive_their_score_and_lie_in_it(self):
        grasps = antigrasp.evaluate(self.block, self.quick).grasps
        contacts = grasps.contacts
        numpy.testing.assert_allclose(contacts.mean(axis=1), grasps.centers, atol=1e-12)
        poses = grasps.poses()
        numpy.testing.assert_array_equal(poses[:, :3, 1], grasps.axes)
        numpy.testing.assert_allclose(numpy.linalg.det(poses), 1)
        with self.assertRaises(ValueError):
            contacts[0] = 0

    def test_sizes_of_another_unit_are_warned_of_as_by_the_program(self):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            antigrasp.evaluate(self.block, Metric(true_size=True, num_grasps=5))
        self.assertTrue(any("60" in str(one.message) for one in said), [str(one.message) for one in said])


class GivenGrasps(Files):
    def test_sampled_grasps_score_the_same_again(self):
        metric = Metric(num_grasps=20)
        score = antigrasp.evaluate(self.block, metric, seed=3)
        again = antigrasp.evaluate_grasps(self.block, score.grasps, metric=metric, seed=3)
        self.assertEqual(again.statuses, ["ok"] * 20)
        numpy.testing.assert_array_equal(again.qualities, score.grasps.qualities)
        self.assertTrue(again.reachable.all())

    def test_poses_are_scored_as_the_rows_of_a_table(self):
        # Across y; the same way, but slipping; beside the block.
        centers = numpy.array([[30, 20, 12], [30, 20, 12], [300, 20, 12.]])
        axes = numpy.array([[0, 1, 0], [1, 1, 0], [0, 1., 0]])
        table = "center_x,center_y,center_z,axis_x,axis_y,axis_z\n" + "".join(
            ",".join(map(repr, row)) + "\n" for row in numpy.hstack([centers, axes]).tolist())
        (self.folder / "mine.csv").write_text(table)
        rows = self.rows(self.run_program("evaluate", "block.obj", "--grasps-in", "mine.csv", "--true-size", "--units", "mm"))
        metric = Metric(true_size=True, units="mm")
        scores = antigrasp.evaluate_grasps(self.block, (centers, axes), metric=metric)
        self.assertEqual(scores.statuses, [row["status"] for row in rows])
        self.assertEqual(scores.statuses[0], "ok")
        self.assertEqual(scores.statuses[2], "misses")
        numpy.testing.assert_array_equal(scores.epsilons, column(rows, "epsilon"))
        numpy.testing.assert_array_equal(scores.qualities, column(rows, "robust_quality"))
        self.assertAlmostEqual(scores.widths[0], .04)
        self.assertTrue(numpy.isnan(scores.widths[2]))
        in_metres = antigrasp.evaluate_grasps(self.block, (.001 * centers, axes), metric=metric, frame="metres")
        numpy.testing.assert_allclose(in_metres.qualities, scores.qualities, rtol=1e-9)

    def test_matrices_hold_approach_axis_and_center_in_their_columns(self):
        metric = Metric(true_size=True, units="mm")
        pose = numpy.array([[[0, 0, 1, 30], [0, 1, 0, 20], [-1, 0, 0, 20], [0, 0, 0, 1.]]])  # from above, across y
        down = antigrasp.evaluate_grasps(self.block, pose, metric=metric)
        self.assertEqual((down.statuses, down.reachable.tolist()), (["ok"], [True]))
        self.assertAlmostEqual(down.widths[0], .04)  # the block's extent along y
        pose[0, :3, 0] *= -1  # through the block from below: the palm is in it
        pose[0, :3, 2] *= -1
        self.assertEqual(antigrasp.evaluate_grasps(self.block, pose, metric=metric).reachable.tolist(), [True])

    def test_other_shapes_are_refused(self):
        for poses, line in ((numpy.zeros((2, 3, 4)), "poses of shape (2, 3, 4) (evaluate_grasps): expected Grasps, an array "
                                                     "(N, 4, 4) of poses, or (centers, axes) with arrays (N, 3)"),
                            ((numpy.zeros((2, 3)), numpy.zeros((1, 3))),
                             "1 axes (evaluate_grasps): expected as many as centers, 2")):
            self.assertEqual(line_of(lambda: antigrasp.evaluate_grasps(self.block, poses)), line)
        self.assertEqual(line_of(lambda: antigrasp.evaluate_grasps(self.block, numpy.eye(4)[None], frame="inch")),
                         "frame = 'inch' (evaluate_grasps): expected 'mesh' or 'metres'")


class Epsilon(Files):
    def contacts(self):
        """Of two grasps: across 40 mm, a little askew; one whose contacts do not face each other."""
        points = numpy.array([[[.001, -.02, 0], [0, .02, .002]], [[.01, -.02, 0], [-.01, .02, 0]]])
        normals = numpy.array([[[0, -1, 0], [0, 1, .1]], [[0, -1, 0], [0, -1, 0.]]])
        return points, normals

    def table(self, points, normals, com, **more):
        names = [f"{kind}{jaw}{axis}" for kind in "pn" for jaw in "12" for axis in "xyz"] + ["comx", "comy", "comz", *more]
        lines = [",".join(names)]
        for i, (p, n) in enumerate(zip(points, normals)):
            values = [*p.ravel(), *n.ravel(), *com, *(column[i] for column in more.values())]
            lines.append(",".join(repr(float(value)) for value in values))
        (self.folder / "contacts.csv").write_text("\n".join(lines) + "\n")

    def program(self, *flags):
        return column(self.rows(self.run_program("quality", "contacts.csv", *flags)), "epsilon")

    def test_it_is_that_of_the_program_row_by_row(self):
        points, normals = self.contacts()
        com = [.001, .002, .003]
        self.table(points, normals, com)
        found = antigrasp.epsilon(points, normals, com)
        numpy.testing.assert_array_equal(found, self.program())
        self.assertGreater(found[0], 0)
        self.assertEqual(found[1], 0)

    def test_frictions_and_constants_are_those_of_the_program(self):
        points, normals = self.contacts()
        points[1], normals[1] = points[0], normals[0]
        self.table(points, normals, [0, 0, 0], friction_coef=[.3, .9])
        found = antigrasp.epsilon(points, normals, [0, 0, 0], [.3, .9], cone_edges=6, torsion="none", torque_scale=50)
        numpy.testing.assert_array_equal(found, self.program("--cone-edges", 6, "--torsion", "none", "--torque-scale", 50))
        found = antigrasp.epsilon(points, normals, [0, 0, 0], [.3, .9])
        self.assertNotEqual(found[0], found[1])
        self.assertEqual(found[0], antigrasp.epsilon(points[0], normals[0], [0, 0, 0], .3))

    def test_every_grasp_has_its_own_centre_of_mass_when_there_are_as_many(self):
        points, normals = self.contacts()
        points[1], normals[1] = points[0], normals[0]
        coms = numpy.array([[0, 0, 0], [.02, 0, 0]])
        found = antigrasp.epsilon(points, normals, coms)
        self.assertEqual(found.tolist(), [antigrasp.epsilon(points[0], normals[0], com) for com in coms])
        self.assertNotEqual(found[0], found[1])

    def test_a_jaw_that_slips_gives_no_force(self):
        points, normals = self.contacts()
        closing = numpy.array([[[0, 1, 0], [0, -1, 0]], [[1, 0, 0], [-1, 0, 0.]]])
        points[1], normals[1] = points[0], normals[0]
        self.table(points, normals, [0, 0, 0], **{f"in{jaw}{axis}": closing[:, jaw - 1, i]
                                                  for jaw in (1, 2) for i, axis in enumerate("xyz")})
        found = antigrasp.epsilon(points, normals, [0, 0, 0], closing=closing)
        numpy.testing.assert_array_equal(found, self.program())
        self.assertGreater(found[0], 0)
        self.assertEqual(found[1], 0)

    def test_any_shape_in_front_and_any_order_in_memory_give_that_shape_and_the_same_numbers(self):
        points, normals = self.contacts()
        flat = antigrasp.epsilon(points, normals, [0, 0, 0])
        grid = antigrasp.epsilon(points[:, None].repeat(3, 1), normals[:, None].repeat(3, 1), numpy.zeros((2, 3, 3)))
        numpy.testing.assert_array_equal(grid, flat[:, None].repeat(3, 1))
        strided = numpy.asfortranarray(points)
        numpy.testing.assert_array_equal(antigrasp.epsilon(strided, normals, [0, 0, 0]), flat)
        self.assertIsInstance(antigrasp.epsilon(points[0], normals[0], [0, 0, 0]), float)
        self.assertEqual(antigrasp.epsilon(points[:0], normals[:0], [0, 0, 0]).shape, (0,))

    def test_many_rows_on_any_number_of_threads_are_the_rows_one_by_one(self):
        points, normals = self.contacts()
        shift = numpy.linspace(-.01, .01, 5000)[:, None, None] * [1, 0, .3]
        points, normals = points[0] + shift, normals[:1].repeat(5000, 0)
        one, three = (antigrasp.epsilon(points, normals, [0, 0, 0], threads=threads) for threads in (1, 3))
        numpy.testing.assert_array_equal(one, three)
        for i in (0, 1023, 1024, 4999):
            self.assertEqual(one[i], antigrasp.epsilon(points[i], normals[i], [0, 0, 0]))
        self.assertGreater(len(set(one)), 2000)

    def test_the_first_bad_row_is_named(self):
        points, normals = self.contacts()
        wrong = normals.copy()
        wrong[1, 1] = 0
        infinite = points.copy()
        infinite[1, 0, 2] = numpy.inf
        for call, line in (
                (lambda: antigrasp.epsilon(points, wrong, [0, 0, 0]),
                 "normals[1] (epsilon): expected finite directions that are not zero"),
                (lambda: antigrasp.epsilon(infinite, normals, [0, 0, 0]), "points[1] (epsilon): expected finite numbers"),
                (lambda: antigrasp.epsilon(points, normals, [0, 0, 0], [.5, -1]),
                 "friction[1] (epsilon): expected numbers in [0, 10]"),
                (lambda: antigrasp.epsilon(points, normals[:1], [0, 0, 0]),
                 "normals of shape (1, 2, 3) (epsilon): expected that of points: (2, 2, 3)"),
                (lambda: antigrasp.epsilon(points, normals, [0, 0]),
                 "com of shape (2,) (epsilon): expected that of points: (3,)"),
                (lambda: antigrasp.epsilon(points, normals, [0, 0, 0], cone_edge=8),
                 "no option cone_edge (epsilon): expected a known option; the nearest is cone_edges")):
            self.assertEqual(line_of(call), line)


class Constants(Files):
    def test_they_are_attributes_and_what_the_program_writes_beside_scores(self):
        metric = Metric(gripper="panda", friction=.3, num_grasps=20, adaptive=True)
        self.run_program("evaluate", "block.obj", "--gripper", "panda", "--friction", "0.3", "--num-grasps", "20",
                         "--adaptive", "--seed", "5", "--out", "s.csv")
        self.assertEqual(metric.toml(5), (self.folder / "s.csv.metric.toml").read_text())
        self.assertEqual((metric.friction, metric.num_grasps, metric.adaptive, metric.collision), (.3, 20, True, "gripper"))
        self.assertEqual(metric.as_dict()["gripper_palm_width"], metric.gripper_palm_width)
        self.assertEqual(eval(repr(metric)).as_dict(), metric.as_dict())  # pylint: disable=eval-used
        with self.assertRaises(AttributeError):
            metric.frictions

    def test_slips_are_refused_by_their_keyword(self):
        for constants, line in (
                ({"frction": .3}, "no option frction (Metric): expected a known option; the nearest is friction"),
                ({"friction": -1}, "metric.friction = -1 (Metric, friction): expected a number in [0, 10]"),
                ({"num_grasps": 2.5}, "metric.num_grasps = 2.5 (Metric, num_grasps): expected a whole number in [1, 1e+06]"),
                ({"collision": "jawss"}, "metric.collision = 'jawss' (Metric, collision): expected one of gripper, jaws"),
                ({"friction": [1]}, "friction = [1] (Metric): expected a number, True, False or a word"),
                ({"jaw_opening": .2},
                 "the palm is narrower than the open fingers: jaw_opening=0.2 (Metric): expected a palm of at least 0.22 m "
                 "(it has 0.08), the opening and two fingers; --gripper sets what belongs together")):
            with self.subTest(line):
                self.assertEqual(line_of(lambda: Metric(**constants)), line)

    def test_numbers_of_numpy_are_numbers(self):
        metric = Metric(friction=numpy.float64(.3), num_grasps=numpy.int64(7), adaptive=numpy.bool_(True))
        self.assertEqual((metric.friction, metric.num_grasps, metric.adaptive), (.3, 7, True))


if __name__ == "__main__":
    unittest.main()
