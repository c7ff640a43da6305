"""Grasps as poses: scripts/grasp_pose.py on numbers known on paper, and every command and number of docs/grasps.md."""
import contextlib
import io
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from scripts_path import ROOT

import draw_grasp
import grasp_pose

METRIC = "[metric]\nobject_min_extent = {}\njaw_opening = 0.05\n[gripper]\npalm_distance = 0.046\npalm_depth = 0.084\n"
HEADER = ("object,grasp,p1x,p1y,p1z,p2x,p2y,p2z,axis_x,axis_y,axis_z,width,robust_quality,approach_x,approach_y,approach_z,"
          "comx,comy,comz,metres_per_unit\n")


class GraspPose(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, rows, min_extent="0.0"):
        (self.folder / "g.csv").write_text(HEADER + "\n".join(rows) + "\n")
        (self.folder / "m.toml").write_text(METRIC.format(min_extent))
        return [str(self.folder / "g.csv"), str(self.folder / "m.toml")]

    def poses(self, words):
        """The matrices by their titles, and the first line."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            grasp_pose.main(words)
        first, *lines = out.getvalue().splitlines()
        found = {}
        for line in lines:
            if line.startswith("    "):
                found[title].append([float(word) for word in line.split()])
            else:
                title = re.sub(", [0-9]+ mm behind", "", line)
                found[title] = []
        return first, found

    # Jaws along -y, 40 mm apart about (0.01, 0.02, 0.03); the way in is straight down. z = x cross y points to -x.
    DOWN = "a.stl,3,0.01,0.04,0.03,0.01,0.0,0.03,0,-1,0,0.04,0.002,0,0,-1,0,0,0,0.001"
    # A better one, from the side.
    SIDE = "a.stl,5,0.01,0.04,0.03,0.01,0.0,0.03,0,-1,0,0.04,0.003,1,0,0,0,0,0,0.001"

    def test_a_grasp_lies_between_its_contacts_and_the_base_behind_it(self):
        first, found = self.poses(self.write([self.DOWN]))
        self.assertEqual(first, "grasp 3 of a.stl: jaws 40.0 mm apart, robust quality 0.00200")
        turn = [[0, 0, -1], [0, -1, 0], [-1, 0, 0]]
        place = {"grasp in the object's frame": [0.01, 0.02, 0.03], "gripper's base in the object's frame": [0.01, 0.02, 0.16]}
        for title, origin in place.items():
            self.assertEqual(found[title], [turn[k] + [origin[k]] for k in range(3)] + [[0, 0, 0, 1]], title)

    # The object's x is the robot's y and its y the robot's -x: (0.01, 0.02) lies at (0.5 - 0.02, 0.1 + 0.01).
    def test_the_robot_sees_the_base_where_the_object_lies(self):
        _, found = self.poses(self.write([self.DOWN]) + ["--object-at", "0.5", "0.1", "0.2", "90"])
        self.assertEqual(found["gripper's base in the robot's frame"],
                         [[0, 1, 0, 0.48], [0, 0, -1, 0.11], [-1, 0, 0, 0.36], [0, 0, 0, 1]])
        # z the way in, y the closing direction, x = y cross z.
        self.assertEqual(found["the same, z the approach and y the closing direction"],
                         [[0, 1, 0, 0.48], [1, 0, 0, 0.11], [0, 0, -1, 0.36], [0, 0, 0, 1]])

    def test_the_most_robust_grasp_is_taken_unless_another_is_asked_for(self):
        words = self.write([self.DOWN, self.SIDE])
        self.assertIn("grasp 5 ", self.poses(words)[0])
        self.assertIn("grasp 3 ", self.poses(words + ["--grasp", "3"])[0])
        self.assertIn("grasp 3 ", self.poses(words + ["--from-above", "0"])[0])
        self.assertIn("grasp 5 ", self.poses(words + ["--from-above", "90"])[0])
        with self.assertRaisesRegex(SystemExit, "no such grasp with a way in"):
            self.poses(words + ["--grasp", "4"])

    def test_a_table_in_the_frame_of_the_mesh_gives_the_same_pose(self):
        in_mm = "a.stl,3,10,40,30,10,0,30,0,-1,0,40,0.002,0,0,-1,0,0,0,0.001"
        self.assertEqual(self.poses(self.write([in_mm]) + ["--frame-mesh"]), self.poses(self.write([self.DOWN])))

    def test_a_table_in_the_frame_of_the_mesh_is_not_taken_for_metres(self):
        in_mm = "a.stl,3,10,40,30,10,0,30,0,-1,0,40,0.002,0,0,-1,0,0,0,0.001"
        with self.assertRaisesRegex(SystemExit, "jaws 40 m apart, which open 0.05 m: .*--frame-mesh"):
            self.poses(self.write([in_mm]))

    def test_what_has_no_pose_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "evaluate --true-size"):
            self.poses(self.write([self.DOWN], min_extent="0.04"))
        with self.assertRaisesRegex(SystemExit, "no such grasp with a way in"):
            self.poses(self.write(["a.stl,3,0.01,0.04,0.03,0.01,0,0.03,0,-1,0,0.04,0.002,0,0,0,0,0,0,1"]))


class GraspsPage(unittest.TestCase):
    """docs/grasps.md, run as it stands."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.page = (ROOT / "docs/grasps.md").read_text()
        (cls.folder / "scripts").symlink_to(ROOT / "scripts")
        (cls.folder / "bin").mkdir()
        (cls.folder / "bin/antigrasp").symlink_to(os.environ["ANTIGRASP_BINARY"])
        block = re.search(r"```obj\n(.*?)```", cls.page, re.S).group(1)
        (cls.folder / "block.obj").write_text(block)
        mine = re.search(r"```csv\n(grasp,center_x.*?)```", cls.page, re.S).group(1)
        (cls.folder / "mine.csv").write_text(mine)
        cls.outputs = {}
        for commands in re.findall(r"```console\n(.*?)```", cls.page, re.S):
            for part in ("\n" + commands).split("\n$ ")[1:]:
                command, _, shown = part.partition("\n")
                environment = os.environ | {"PATH": f"{cls.folder / 'bin'}:{os.environ['PATH']}"}
                done = subprocess.run(command, shell=True, cwd=cls.folder, env=environment, text=True, capture_output=True)
                cls.outputs[command] = (done.returncode, done.stdout + done.stderr, shown)

    def test_every_command_prints_what_the_page_shows(self):
        self.assertEqual(len(self.outputs), 3, list(self.outputs))
        for command, (code, printed, shown) in self.outputs.items():
            self.assertEqual(code, 0, printed)
            self.assertTrue(shown.strip(), command)
            for line in shown.strip().splitlines():
                self.assertIn(line.rstrip(), printed, command)

    def test_the_row_of_the_page_is_one_of_the_table(self):
        shown = re.search(r"```csv\n(.*?)\n(.*?)\n```", self.page, re.S)
        names, cells = shown.group(1).split(","), shown.group(2).split(",")
        row = next(r for r in grasp_pose.read_grasps(self.folder / "grasps.csv") if r["grasp"] == cells[names.index("grasp")])
        for name, cell in zip(names, cells):
            if name in ("object", "grasp"):
                self.assertEqual(row[name], cell)
            else:
                self.assertAlmostEqual(float(row[name]), float(cell), 5, name)

    def test_the_picture_is_that_of_the_page_s_grasp(self):
        files = [str(self.folder / name) for name in ("block.obj", "grasps.csv", "scores.csv.metric.toml", "now.svg")]
        draw_grasp.main(*files)
        self.assertEqual((self.folder / "now.svg").read_text(), (ROOT / "docs/images/grasp-frames.svg").read_text())


if __name__ == "__main__":
    unittest.main()
