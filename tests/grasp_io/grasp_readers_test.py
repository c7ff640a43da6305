"""Files of grasps that the binary in ANTIGRASP_BINARY writes, in readers that are not ours: PyYAML, Python's json, h5py. A cube
of 40 mm, one grasp down onto its middle and one beside it: every pose is known on paper (docs/grasps.md)."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import yaml
except ImportError as error:
    print(f"skipped: {error.name} is not installed")
    sys.exit(77)  # CTest counts and names it

CUBE = """v -20 -20 -20\nv 20 -20 -20\nv 20 20 -20\nv -20 20 -20\nv -20 -20 20\nv 20 -20 20\nv 20 20 20\nv -20 20 20
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
GRASPS = """grasp,center_x,center_y,center_z,axis_x,axis_y,axis_z,approach_x,approach_y,approach_z,candidate
7,0,0,0,1,0,0,0,0,-1,7\n9,0,90,0,1,0,0,0,0,-1,9\n"""
PANDA = ["--gripper", "panda", "--units", "mm", "--true-size", "--num-draws", "3"]
# x the closing direction, z the approach, 103.4 mm behind the middle; Franka's link has y for closing.
CONVENTION = [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0.1034], [0, 0, 0, 1]]
HALF_TURN = {"w": 0.0, "xyz": [math.sqrt(0.5), math.sqrt(0.5), 0.0]}


class Grasps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / "cube.obj").write_text(CUBE)
        (cls.folder / "mine.csv").write_text(GRASPS)
        for name, *more in (["g.yaml"], ["g.json"], ["g.h5"], ["g.hdf5"], ["m.json", "--grasp-format", "multigripper"]):
            cls.call("--grasps-in", "mine.csv", "--grasps", name, *more)

    @classmethod
    def call(cls, *words):
        return subprocess.run([os.environ["ANTIGRASP_BINARY"], "evaluate", "cube.obj", *PANDA, *words], cwd=cls.folder,
                              check=True, capture_output=True, text=True).stdout

    def same(self, found, expected):
        """Numbers in lists of lists."""
        if isinstance(expected, list):
            self.assertEqual(len(found), len(expected))
            for one, other in zip(found, expected):
                self.same(one, other)
        else:
            self.assertAlmostEqual(float(found), expected, 12)

    def test_isaac_grasp_by_pyyaml(self):
        with open(self.folder / "g.yaml", encoding="utf-8") as file:
            text = yaml.safe_load(file)
        grasps = text.pop("grasps")
        self.assertEqual(text, {
            "format": "isaac_grasp", "format_version": 1.0, "object_frame": "cube.obj", "object_frame_link": "cube.obj",
            "gripper_frame": "panda_hand", "gripper_frame_link": "panda_hand", "object_file": "cube.obj", "object_scale": 0.001,
            "gripper": "panda", "open_limit": "upper", "label": "robust quality of at least 0.002"})
        self.assertEqual(list(grasps), ["grasp_7", "grasp_9"])
        first, beside = grasps.values()
        self.assertEqual((first["confidence"], beside["confidence"]), (1.0, 0.0))
        self.same(first["position"], [0, 0, 0.1034])
        self.same(beside["position"], [0, 0.09, 0.1034])
        self.same(first["orientation"]["xyz"], HALF_TURN["xyz"])
        self.same(first["orientation"]["w"], HALF_TURN["w"])
        joints = ["panda_finger_joint1", "panda_finger_joint2"]
        self.assertEqual(first["pregrasp_cspace_position"], dict.fromkeys(joints, 0.04))
        self.same([first["cspace_position"][joint] for joint in joints], [0.02, 0.02])
        for grasp in grasps.values():  # 1e-05 would be a text
            for number in [grasp["robust_quality"], *grasp["position"], *grasp["orientation"]["xyz"]]:
                self.assertIsInstance(number, float)

    def test_graspgen_by_json(self):
        text = json.loads((self.folder / "g.json").read_text())
        self.assertEqual(text["object"], {"file": "cube.obj", "scale": 0.001})
        self.assertEqual(text["gripper"]["name"], "franka_panda")
        self.same([text["gripper"]["width"], text["gripper"]["depth"]], [0.08, 0.1034])
        self.same(text["grasps"]["transforms"][0], CONVENTION)
        self.assertEqual(text["grasps"]["object_in_gripper"], [True, False])
        self.assertEqual(text["grasps"]["candidate"], [7, 9])

    def test_multigrippergrasp_by_json(self):
        text = json.loads((self.folder / "m.json").read_text())
        self.assertEqual((text["gripper"], text["object_ID"], text["result"]), ("franka_panda", "cube.obj", [1, 0]))
        self.same(text["pose"][0], [0, 0, 0.1034, HALF_TURN["w"], *HALF_TURN["xyz"]])
        self.assertEqual(text["dofs"], 2 * [[0.04, 0.04]])

    def test_acronym_by_h5py_as_its_loader_reads_it(self):
        with h5py.File(self.folder / "g.h5") as file:
            self.assertEqual(file["object/file"][()].decode("utf-8"), "cube.obj")
            self.assertEqual(file["gripper/type"][()].decode("utf-8"), "panda")
            self.assertEqual((file["object/scale"][()], list(file["gripper/configuration"])), (0.001, [0.04]))
            poses, held = file["grasps/transforms"], file["grasps/qualities/flex/object_in_gripper"]
            self.assertEqual((poses.dtype.str, held.dtype.str, list(held)), ("<f8", "<i8", [1, 0]))
            self.same(poses[0].tolist(), CONVENTION)
            self.assertEqual(held.attrs["label"], "robust quality of at least 0.002")
            # 64 cm3 of 1000 kg/m3, I = m a^2 / 6.
            self.same(file["object/volume"][()], 64e-6)
            self.same(file["object/mass"][()], 0.064)
            self.same(file["object/inertia"][()].tolist(), [[0.064 * 0.04**2 / 6 * (i == k) for k in range(3)] for i in range(3)])

    def test_dexnet_by_h5py(self):
        with h5py.File(self.folder / "g.hdf5") as file:
            cube = file["datasets/antigrasp/objects/cube"]
            self.assertEqual(set(cube), {"mesh", "sdf", "stable_poses", "rendered_images", "sensor_data", "grasps"})
            self.same(cube.attrs["mass"], 0.064)
            self.assertEqual((cube["mesh/vertices"].shape, cube["mesh/triangles"].shape), ((8, 3), (12, 3)))
            self.same(cube["mesh/vertices"][0].tolist(), [-0.02, -0.02, -0.02])
            sdf = cube["sdf"]
            node = (-sdf.attrs["origin"] / sdf.attrs["resolution"]).round().astype(int)
            place = sdf.attrs["origin"] + sdf.attrs["resolution"] * node
            self.assertAlmostEqual(float(sdf["data"][tuple(node)]), max(abs(place)) - 0.02, 8)  # negative inside
            grasps = cube["grasps/panda"]
            self.assertEqual(grasps.attrs["num_grasps"], 2)
            grasp = grasps["grasp_0"]
            self.assertEqual((grasp.attrs["type"], grasp.attrs["frame"], grasp.attrs["id"]), ("ParallelJawPtGrasp3D", "object", 7))
            self.same(list(grasp.attrs["configuration"]), [0, 0, 0, 1, 0, 0, 0.08, -math.pi / 2, 0.0175, 0])
            self.assertEqual(grasp["metrics"].attrs["success"], 1)

    def test_each_is_read_back_to_the_same_scores(self):
        expected = self.call("--grasps-in", "mine.csv").split("\n", 1)[1]
        for name in ("g.yaml", "g.json", "g.h5", "g.hdf5", "m.json"):
            rows = [line.split(",") for line in self.call("--grasps-in", name).splitlines()[1:]]
            scores = [row[2:] for row in rows]
            self.assertEqual(scores, [line.split(",")[2:] for line in expected.splitlines()], name)


if __name__ == "__main__":
    unittest.main()
