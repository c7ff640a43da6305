#!/usr/bin/env python3
"""A grasp of grasps.csv as a pose for a robot (docs/grasps.md has the frames and an example).

  scripts/grasp_pose.py grasps.csv scores.csv.metric.toml
  scripts/grasp_pose.py grasps.csv scores.csv.metric.toml --object-at 0.5 0.1 0 90 --from-above 45

Both files are those of one `antigrasp evaluate --true-size --out scores.csv --grasps grasps.csv`.
"""
import argparse
import csv
import math
import sys
import tomllib


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def from_columns(x, y, z, place):
    """The 4 x 4 pose with these axes and this origin."""
    return [[x[k], y[k], z[k], place[k]] for k in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def column(pose, k):
    return [pose[row][k] for row in range(3)]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def turned_about_z(place, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return from_columns([c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], place)


def vector(row, head):
    joint = "_" if head in ("axis", "approach") else ""
    return [float(row[head + joint + axis]) for axis in "xyz"]


def grasp_in_object(row):
    """Origin between the contacts, x the approach, y from contact 1 to contact 2."""
    x, y = vector(row, "approach"), vector(row, "axis")
    return from_columns(x, y, cross(x, y), [(a + b) / 2 for a, b in zip(vector(row, "p1"), vector(row, "p2"))])


def base_from_grasp(gripper):
    """The back of the palm, the same axes: behind the grasp by the palm's distance and its depth."""
    x = -(gripper["palm_distance"] + gripper["palm_depth"])
    return from_columns([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [x, 0.0, 0.0])


def tool_axes(pose):
    """The same place with z as the approach and y as the closing direction, as most robots call them."""
    x, y, z = (column(pose, k) for k in range(3))
    return from_columns([-a for a in z], y, x, column(pose, 3))


def read_metric(path):
    with open(path, "rb") as file:
        constants = tomllib.load(file)
    if constants["metric"]["object_min_extent"] > 0:
        sys.exit(f"{path}: scored at another size than the object has: expected evaluate --true-size")
    return constants


def read_grasps(path):
    """The rows, most robust first; those without an approach (--collision jaws) have no pose."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    rows = [row for row in rows if any(vector(row, "approach"))]
    rows.sort(key=lambda row: -float(row["robust_quality"]))
    return rows


def in_metres(rows, frame_of_mesh):
    """Of a table with --frame mesh: the same rows with lengths in metres."""
    if not frame_of_mesh:
        return rows
    lengths = [head + axis for head in ("p1", "p2", "com") for axis in "xyz"] + ["width"]
    return [row | {name: float(row[name]) * float(row["metres_per_unit"]) for name in lengths} for row in rows]


def choose(rows, robot_from_object, from_above, number):
    """The most robust row whose way in is that near to straight down in the robot's frame."""
    for row in rows:
        way = column(times(robot_from_object, grasp_in_object(row)), 0)
        down = math.degrees(math.acos(max(-1.0, min(1.0, -way[2]))))
        if (number is None or row["grasp"] == str(number)) and down <= from_above + 1e-6:
            return row
    sys.exit("no such grasp with a way in: expected another --grasp or a wider --from-above")


def text(name, pose):
    lines = ["  ".join(f"{value + 0.0:9.5f}" for value in row) for row in pose]
    return name + "\n" + "\n".join(f"    {line}" for line in lines).replace("-0.00000", " 0.00000")


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grasps", help="grasps.csv")
    parser.add_argument("metric", help="scores.csv.metric.toml of the same call: its gripper")
    parser.add_argument("--grasp", type=int, help="its number; without it, the most robust")
    parser.add_argument("--frame-mesh", action="store_true", help="the table was written with --frame mesh")
    parser.add_argument("--object-at", type=float, nargs=4, default=[0.0, 0.0, 0.0, 0.0], metavar=("X", "Y", "Z", "TURN"),
                        help="where the origin of the object's file lies in the robot's frame, m, and its turn about z, degrees")
    parser.add_argument("--from-above", type=float, default=180.0, metavar="DEGREES",
                        help="only ways in that are this near to straight down in the robot's frame")
    return parser.parse_args(words)


def main(words):
    given = arguments(words)
    constants = read_metric(given.metric)
    gripper, opening = constants["gripper"], constants["metric"]["jaw_opening"]
    robot_from_object = turned_about_z(given.object_at[:3], given.object_at[3])
    rows = in_metres(read_grasps(given.grasps), given.frame_mesh)
    row = choose(rows, robot_from_object, given.from_above, given.grasp)
    if float(row["width"]) > 1.001 * opening:
        sys.exit(f"{given.grasps}: jaws {float(row['width']):g} m apart, which open {opening:g} m: "
                 "expected metres, or --frame-mesh for a table with --frame mesh")
    grasp = grasp_in_object(row)
    base = times(grasp, base_from_grasp(gripper))
    print(f"grasp {row['grasp']} of {row['object']}: jaws {1000 * float(row['width']):.1f} mm apart, "
          f"robust quality {float(row['robust_quality']):.5f}")
    print(text("grasp in the object's frame", grasp))
    print(text(f"gripper's base in the object's frame, {-1000 * base_from_grasp(gripper)[0][3]:.0f} mm behind", base))
    print(text("gripper's base in the robot's frame", times(robot_from_object, base)))
    print(text("the same, z the approach and y the closing direction", tool_axes(times(robot_from_object, base))))


if __name__ == "__main__":
    main(sys.argv[1:])
