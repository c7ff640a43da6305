"""antigrasp.Mesh and Grid: arrays in and out, and what commands say of the same object."""
import gc
import types
import unittest
import warnings

from support import FACES, Files, column, corners, numpy, obj, vectors

import antigrasp
from antigrasp import Grid, InputError, Mesh


class Arrays(Files):
    def test_a_mesh_gives_its_arrays_back_as_views_that_nobody_can_change_and_that_keep_it_alive(self):
        mesh = Mesh(corners(), FACES)
        vertices = mesh.vertices
        numpy.testing.assert_array_equal(vertices, corners())
        numpy.testing.assert_array_equal(mesh.faces, FACES)
        self.assertTrue(numpy.shares_memory(vertices, mesh.vertices))
        self.assertEqual((vertices.dtype, mesh.faces.dtype), (numpy.float64, numpy.int32))
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1
        del mesh
        gc.collect()
        numpy.testing.assert_array_equal(vertices, corners())

    def test_arrays_of_any_order_and_type_a_file_and_what_has_vertices_and_faces_are_the_same_mesh(self):
        like_trimesh = types.SimpleNamespace(vertices=corners(), faces=FACES)
        backwards = corners()[:, ::-1].copy()[:, ::-1]  # not in C order
        for mesh in (Mesh(corners().astype(numpy.float32), FACES.astype(numpy.uint8)), Mesh(like_trimesh),
                     Mesh(backwards, numpy.asfortranarray(FACES)), Mesh(corners().tolist(), FACES.tolist()),
                     Mesh(self.block), Mesh(self.folder / "block.obj")):
            numpy.testing.assert_array_equal(mesh.vertices, corners())
            numpy.testing.assert_array_equal(mesh.faces, FACES)

    def test_a_block_is_what_paper_says(self):
        mesh = Mesh(corners(), FACES)
        self.assertAlmostEqual(mesh.volume, 60000)
        self.assertAlmostEqual(mesh.area, 9800)
        numpy.testing.assert_allclose(mesh.center_of_mass, [30, 20, 12.5])
        numpy.testing.assert_array_equal(mesh.bounds, [[0, 0, 0], [60, 40, 25]])
        report = mesh.inspect()
        self.assertTrue(report.is_solid and report.closed and report.outward)
        self.assertEqual((report.components, report.boundary_edges, report.problem), (1, 0, ""))
        report = Mesh(corners(), FACES[1:]).inspect()
        self.assertEqual((report.is_solid, report.boundary_edges), (False, 3))

    def test_names_are_those_of_files_or_as_given(self):
        self.assertEqual([Mesh(self.block).name, Mesh(corners(), FACES).name, Mesh(self.block, name="mug").name],
                         ["block.obj", "mesh", "mug"])

    def test_what_is_wrong_is_said_in_one_line(self):
        open_block = Mesh(corners(), FACES[1:], name="bowl")
        for wrong, line in (
                (lambda: Mesh(corners()[:, :2], FACES), "vertices of shape (8, 2) (mesh): expected an array of shape (V, 3)"),
                (lambda: Mesh(corners(), FACES + 1), "face 3 names vertex 8 (mesh): expected 0 to 7"),
                (lambda: Mesh(corners(), FACES - 1), "face 0 names vertex -1 (mesh): expected 0 to 7"),
                (lambda: Mesh(corners(), FACES * 1.0),
                 "faces of type float64 (mesh): expected whole numbers: places in the vertices, from 0"),
                (lambda: Mesh(corners() * numpy.nan, FACES), "vertex 0 is not finite (mesh): expected finite numbers"),
                (lambda: Mesh(corners(), FACES[:0]), "no faces (mesh): expected at least one"),
                (lambda: Mesh("text", FACES), "vertices that are no numbers (mesh): expected an array of shape (V, 3)"),
                (lambda: Mesh(7), "a mesh of <class 'int'> (mesh): expected vertices and faces, a file, or an object that "
                                  "has both, as trimesh's"),
                (open_block.sdf, "open: 3 boundary edges (bowl): expected a closed solid"),
                (lambda: Mesh(corners(), FACES).sdf(8), "n = 8 (sdf): expected a whole number in [16, 256]"),
                (lambda: Grid(numpy.zeros((2, 3, 2))),
                 "values of shape (2, 3, 2) (grid): expected an array of shape (n, n, n), z y x, n in [2, 256]")):
            with self.subTest(line), self.assertRaises(InputError) as raised:
                wrong()
            self.assertEqual(str(raised.exception), line)
        self.assertIsInstance(raised.exception, ValueError)
        self.assertIsInstance(raised.exception, antigrasp.Error)

    def test_a_file_is_refused_in_the_words_of_the_program(self):
        with self.assertRaises(InputError) as raised:
            Mesh(str(self.folder / "none.stl"))
        self.assertIn("no such file", str(raised.exception))
        (self.folder / "cut.obj").write_text("v 0 0\n")
        with self.assertRaises(InputError) as raised:
            Mesh(str(self.folder / "cut.obj"))
        self.assertEqual(str(raised.exception), self.refusal("info", self.folder / "cut.obj"))

    def test_what_can_be_repaired_is_and_says_so(self):
        inside_out = Mesh(corners(), FACES[:, ::-1])
        self.assertEqual(inside_out.status, "ok")
        self.assertAlmostEqual(inside_out.repaired().volume, 60000)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            antigrasp.evaluate(inside_out, antigrasp.Metric(num_grasps=5))
        self.assertEqual([(one.category, str(one.message)) for one in said],
                         [(antigrasp.Warning, "mesh: turned inside out")])


class Grids(Files):
    def test_distances_are_positive_inside_with_x_last(self):
        grid = Mesh(corners(), FACES).sdf(32)
        self.assertAlmostEqual(grid.side, 60 * 32 / 28)  # two free cells on each side
        numpy.testing.assert_allclose(grid.center, [30, 20, 12.5])
        self.assertAlmostEqual(grid.spacing, 60 / 28)
        values = grid.side * grid.values  # of nodes around the middle, half a cell from it
        self.assertEqual((values.shape, values.dtype), ((32, 32, 32), numpy.float32))
        self.assertAlmostEqual(values[16, 16, 16], 12.5 - .5 * grid.spacing, places=4)
        self.assertAlmostEqual(values[16, 16, 31], 30 - 15.5 * grid.spacing, places=4)  # beyond the end along x
        self.assertAlmostEqual(values[31, 16, 16], 12.5 - 15.5 * grid.spacing, places=4)

    def test_grids_are_those_that_the_program_imports(self):
        self.run_program("dataset", "import", "block.obj", "--scale", "each", "--out", "block.npy")
        numpy.testing.assert_array_equal(Mesh(self.block).sdf(32).values, numpy.load(self.folder / "block.npy")[0])

    def test_a_mesh_remeshed_lies_where_it_lay(self):
        mesh = Mesh(corners() + [100, -7, 3], FACES, name="away").remesh(48)
        self.assertEqual(mesh.name, "away")
        numpy.testing.assert_allclose(mesh.bounds, [[100, -7, 3], [160, 33, 28]], atol=.05)
        self.assertAlmostEqual(mesh.volume, 60000, delta=600)

    def test_a_grid_of_ones_own_becomes_a_ball_in_its_place(self):
        at = (numpy.arange(24) + .5) / 24 - .5
        z, y, x = numpy.meshgrid(at, at, at, indexing="ij")
        grid = Grid(.3 - numpy.sqrt(x**2 + y**2 + z**2), side=10, center=[1, 2, 3])
        self.assertEqual(grid.status, "ok")
        numpy.testing.assert_allclose(grid.remesh().bounds, [[-2, -1, 0], [4, 5, 6]], atol=.05)
        empty = Grid(-numpy.ones((24, 24, 24)), name="void")
        self.assertEqual(empty.status, "empty")
        with self.assertRaisesRegex(InputError, r"^empty \(void\): expected a grid whose surface is one closed solid$"):
            empty.remesh()


class Poses(Files):
    def test_stable_poses_are_the_rows_of_the_program(self):
        poses = Mesh(self.block).stable_poses()
        rows = self.rows(self.run_program("poses", "block.obj", "--units", "m"))
        self.assertEqual(len(poses), 6)
        numpy.testing.assert_array_equal(poses.probabilities, column(rows, "probability"))
        numpy.testing.assert_array_equal(poses.com_heights, column(rows, "com_height"))
        names = [f"r{row}{k}" for row in range(3) for k in range(3)]
        numpy.testing.assert_array_equal(
            poses.rotations, [numpy.reshape([float(row[name]) for name in names], (3, 3)) for row in rows])

    def test_a_mesh_is_saved_for_the_program(self):
        Mesh(corners(), FACES).save(self.folder / "saved.obj", scale=2)
        numpy.testing.assert_array_equal(Mesh(str(self.folder / "saved.obj")).vertices, 2 * corners())


if __name__ == "__main__":
    unittest.main()
