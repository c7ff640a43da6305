"""antigrasp.perturb, trial, compare and datasets give the digits and bytes of the program."""
import filecmp
import math
import unittest

from support import FACES, Files, corners, numpy, obj

import antigrasp
from antigrasp import InputError, Mesh, Metric, ShapeSet, datasets, perturb

QUICK = ["--num-grasps", "20", "--num-draws", "3"]
METRIC = Metric(num_grasps=20, num_draws=3)


def same(number, text):
    return math.isnan(number) if text in ("", "nan") else number == float(text)


class Perturb(Files):
    def assert_rows(self, results, table):
        rows = self.rows(table)
        self.assertEqual(len(results), len(rows))
        for result, row in zip(results, rows):
            self.assertEqual((result.name, result.status), (row.pop("object"), row.pop("status")))
            row.pop("judge", None)
            self.assertEqual(set(row), set(result.as_dict()))
            for name, text in row.items():
                self.assertTrue(same(getattr(result, name), text), f"{name}: {getattr(result, name)} and {text}")

    def test_every_method_gives_the_row_of_the_program(self):
        for method, options, flags in ((perturb.random, {"alpha": 15, "iterations": 300}, ["--alpha", "15", "--iterations", "300"]),
                                       (perturb.rotation, {"beta": .1, "max_faces": 0}, ["--beta", "0.1", "--max-faces", "0"]),
                                       (perturb.exhaustive, {"iterations": 3}, ["--iterations", "3"]),
                                       (perturb.search, {"alpha": 10, "steps": 5}, ["--alpha", "10", "--steps", "5"])):
            name = method.__name__
            with self.subTest(name):
                self.run_program("perturb", name, "block.obj", *flags, *QUICK, "--seed", 3, "--out", name)
                result = method(self.block, METRIC, seed=3, **options)
                self.assert_rows([result], f"{name}/perturb.csv")
                self.assertEqual(result.mesh is None, result.status != "ok")

    def test_the_meshes_are_those_that_the_program_writes(self):
        self.run_program("perturb", "random", "block.obj", "--iterations", 300, *QUICK, "--out", "out")
        result = perturb.random(self.block, METRIC, iterations=300)
        for mesh, side in ((result.before, "before"), (result.mesh, "after")):
            written = Mesh(str(self.folder / "out" / side / "block.stl"))
            # STL knows no order of vertices: corner by corner.
            numpy.testing.assert_array_equal(mesh.vertices[mesh.faces], written.vertices[written.faces])
        self.assertFalse(numpy.array_equal(result.before.vertices, result.mesh.vertices))

    def test_what_is_no_solid_has_a_status_and_no_mesh(self):
        bowl = Mesh(corners(), FACES[1:], name="bowl")
        good, bad = perturb.random([self.block, bowl], METRIC, iterations=10)
        self.assertEqual((good.status, bad.status), ("ok", "before: open: 3 boundary edges"))
        self.assertIsNone(bad.mesh)

    def test_a_search_on_a_function_of_ones_own_lowers_it(self):
        asked = []

        def size(mesh):
            asked.append(mesh.name)
            return mesh.volume

        result = perturb.search(self.block, METRIC, objective=size, hausdorff=5, starts=1, descent_steps=5, generations=3)
        self.assertEqual((result.status, result.judge), ("ok", "python:size"))
        self.assertAlmostEqual(result.judge_before, 60000)
        self.assertLess(result.judge_after, 60000)
        self.assertAlmostEqual(result.judge_after, result.mesh.volume)
        self.assertLessEqual(result.hausdorff_pct, 5)
        self.assertGreater(len(asked), 10)

    def test_what_a_function_raises_ends_the_search(self):
        def judge(mesh):
            raise LookupError("no " + mesh.name)

        with self.assertRaisesRegex(LookupError, "^'?no "):
            perturb.search(self.block, METRIC, objective=judge, starts=1, descent_steps=2, generations=1)
        with self.assertRaisesRegex(InputError, r"^the judge <lambda> said 'hard' \(.*\): expected a number or None$"):
            perturb.search(self.block, METRIC, objective=lambda mesh: "hard", starts=1, descent_steps=2, generations=1)

    def test_options_are_refused_by_their_name(self):
        for call, line in (
                (lambda: perturb.random(self.block, alfa=3),
                 "no option alfa (perturb.random): expected a known option; the nearest is alpha"),
                (lambda: perturb.search(self.block, hausdorff=3),
                 "the search on epsilon has no such thing (hausdorff=3): expected --objective settled, or another judge"),
                (lambda: perturb.shape("cube", 80),
                 "phi = 80 (--phi): expected at most 70.5288 degrees, the regular tetrahedron's: no closed solid has more"),
                (lambda: perturb.shape("ball", 8),
                 "no solid ball (perturb.shape): expected cube, tetrahedron, octahedron, cuboctahedron, dodecahedron or "
                 "icosahedron")):
            with self.subTest(line), self.assertRaises(InputError) as raised:
                call()
            self.assertEqual(str(raised.exception), line)
        with self.assertRaises(InputError) as raised:
            perturb.shape("cube", 40)
        self.assertEqual(str(raised.exception), self.refusal("shape", "cube", "--phi", 40, "--out", "cube.stl"))

    def test_a_cube_against_grippers_has_the_angle_that_was_asked_for(self):
        self.run_program("shape", "cube", "--phi", 15, "--out", "cube.stl")
        solid = perturb.shape("cube", phi=15)
        self.assertAlmostEqual(solid.antipodality, 15, places=4)
        written = Mesh(str(self.folder / "cube.stl"))
        numpy.testing.assert_array_equal(solid.mesh.vertices[solid.mesh.faces].astype(numpy.float32),
                                         written.vertices[written.faces])


class Trial(Files):
    def test_shares_and_executions_are_those_of_the_program(self):
        self.run_program("trial", "block.obj", "--num-grasps", 8, "--draws", 2, "--mass", "0.05", "--seed", 4, "--out", "tried")
        tried = antigrasp.trial(self.block, metric=Metric(num_grasps=8), seed=4, draws=2, mass=.05)
        row, = self.rows("tried/trials.csv")
        self.assertEqual((tried.name, tried.status), (row["object"], row["status"]))
        self.assertEqual((tried.held, *tried.interval), tuple(float(row["held" + end]) for end in ("", "_low", "_high")))
        self.assertEqual([stage[0] for stage in tried.stages.values()],
                         [float(row[name]) for name in ("held", "held_3_g", "held_8_g")])
        self.assertEqual((tried.mass, tried.grasps), (.05, int(row["grasps"])))
        self.assertEqual(tried.outcomes["slipped"], int(row["slipped"]))
        executions = self.rows("tried/executions.csv")
        self.assertEqual(list(tried.executions["outcome"]), [one["outcome"] for one in executions])
        for name in ("friction", "epsilon", "seconds"):
            self.assertEqual(list(tried.executions[name]), [float(one[name]) for one in executions])
        self.assertEqual(list(tried.executions["grasp"]), [int(one["grasp"]) for one in executions])

    def test_a_protocol_goes_before_the_default_friction_and_the_users_before_it(self):
        for metric, friction in ((Metric(num_grasps=2), .6), (Metric(num_grasps=2, friction=.2, friction_std=0), .2)):
            tried = antigrasp.trial(self.block, "dexgraspbench", metric, draws=1)
            self.assertAlmostEqual(float(tried.executions["friction"].mean()), friction, delta=.25 if friction == .6 else 0)

    def test_what_it_has_no_use_for_is_refused(self):
        for call, line in (
                (lambda: antigrasp.trial(self.block, series=2),
                 "protocol six-ways has no such thing (series=2): expected --draws, or --protocol paper"),
                (lambda: antigrasp.trial(self.block, "seven-ways"),
                 "no protocol seven-ways (trial): expected six-ways, paper, graspdatagen or dexgraspbench"),
                (lambda: antigrasp.trial(Mesh(corners(), FACES[1:], name="bowl")),
                 "no object could be tried; bowl: open: 3 boundary edges (trial): expected a closed solid that the gripper "
                 "reaches")):
            with self.subTest(line), self.assertRaises(InputError) as raised:
                call()
            self.assertEqual(str(raised.exception), line)


class Sets(Files):
    def test_a_made_set_is_the_file_of_the_program_to_the_byte(self):
        self.run_program("dataset", "make", "bottles", "--count", 5, "--seed", 9, "--resolution", 24, "--out", "made.h5")
        made = datasets.make("bottles", 5, seed=9, resolution=24)
        made.save(self.folder / "saved.h5")
        self.assertTrue(filecmp.cmp(self.folder / "made.h5", self.folder / "saved.h5", shallow=False))
        again = datasets.read(self.folder / "made.h5")
        numpy.testing.assert_array_equal(made.values, again.values)
        self.assertEqual((made.values.shape, made.names, made.kind, made.seed),
                         ((5, 24, 24, 24), again.names, "bottles", 9))
        numpy.testing.assert_array_equal(made[-1].values, made.values[4])
        self.assertFalse(made.values.flags.writeable)

    def test_meshes_of_a_set_score_as_the_program_scores_the_file(self):
        made = datasets.make("cylinders", 3)
        made.save(self.folder / "made.h5")
        rows = self.rows(self.run_program("evaluate", "made.h5", *QUICK))
        for meshes in (made.meshes(), antigrasp.read(self.folder / "made.h5")):
            scores = antigrasp.evaluate(meshes, METRIC)
            self.assertEqual([(score.name, score.graspability) for score in scores],
                             [(row["object"], float(row["graspability"])) for row in rows])

    def test_arrays_of_ones_own_become_a_set(self):
        values = datasets.make("prisms", 2, resolution=16).values
        mine = ShapeSet(values, kind="mine", side=30)
        mine.save(self.folder / "mine.h5")
        read = datasets.read(self.folder / "mine.h5")
        self.assertEqual((read.names, read.kind, read.side), (["mine-000000", "mine-000001"], "mine", 30))
        numpy.testing.assert_array_equal(read.values, values)
        small, large = ShapeSet(values).meshes()[0], mine.meshes()[0]
        numpy.testing.assert_allclose(large.vertices, 30 * small.vertices)
        for call, line in ((lambda: ShapeSet(values[0]), "values of shape (16, 16, 16) (ShapeSet): expected an array of shape "
                                                         "(N, n, n, n), N above 0, n in [2, 256]"),
                           (lambda: ShapeSet(values, names=["a"]), "1 names (ShapeSet): expected one a grid, 2"),
                           (lambda: datasets.make("cubes"),
                            "kind = cubes (datasets.make): expected cylinders, prisms or bottles"),
                           (lambda: datasets.make("prisms", 0),
                            "count = 0 (datasets.make): expected a whole number in [1, 1000000]")):
            with self.assertRaises(InputError) as raised:
                call()
            self.assertEqual(str(raised.exception), line)
        with self.assertRaises(IndexError):
            mine[2]

    def test_a_comparison_has_the_numbers_of_the_program(self):
        samples, reference = datasets.make("cylinders", 4), datasets.make("prisms", 5)
        samples.save(self.folder / "a.h5")
        reference.save(self.folder / "b.h5")
        self.run_program("compare", "a.h5", "b.h5", "--train", "b.h5", "--points", 200, "--out", "c.csv")
        rows = self.rows("c.csv")
        for given in ((samples, reference, reference), (samples.meshes(), reference.meshes(), reference.meshes()),
                      tuple(self.folder / name for name in ("a.h5", "b.h5", "b.h5"))):
            found = antigrasp.compare(*given, points=200).as_dict()
            self.assertEqual(list(found), [row["measure"] for row in rows])
            for row in rows:
                for number, side in zip(found[row["measure"]], ("samples", "reference")):
                    self.assertTrue(same(number, row[side]), row)


if __name__ == "__main__":
    unittest.main()
