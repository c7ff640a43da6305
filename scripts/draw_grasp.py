#!/usr/bin/env python3
"""The picture of docs/grasps.md: an object, its most robust grasp from above, the gripper and their frames.

  scripts/draw_grasp.py block.obj grasps.csv scores.csv.metric.toml docs/images/grasp-frames.svg

The object: an OBJ file of convex faces, coordinates in millimetres.
"""
import math
import sys

import grasp_pose as poses

AZIMUTH, ELEVATION = math.radians(-155.0), math.radians(22.0)
SCALE, MARGIN = 3.2, 40.0  # pixels a millimetre, pixels
AXES = (("x", "#c62828"), ("y", "#2e7d32"), ("z", "#1565c0"))


def seen(point):
    """Right, down and depth of a place, as a camera far away sees it."""
    ca, sa, ce, se = math.cos(AZIMUTH), math.sin(AZIMUTH), math.cos(ELEVATION), math.sin(ELEVATION)
    x, y, z = point
    right, away = -sa * x + ca * y, ca * x + sa * y
    return right, -(ce * z - se * away), -(ce * away + se * z)


def place_in(pose, point):
    return [sum(pose[k][j] * point[j] for j in range(3)) + pose[k][3] for k in range(3)]


def read_obj(path):
    vertices, faces = [], []
    with open(path) as file:
        for words in map(str.split, file):
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            if words[:1] == ["f"]:
                faces.append([vertices[int(word.split("/")[0]) - 1] for word in words[1:]])
    return faces


def box_faces(low, high, pose):
    corner = [[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [[place_in(pose, corner[k]) for k in side] for side in sides]


def gripper_faces(gripper, width, pose):
    """Fingers and palm as quality/gripper.h has them, closed to `width`; millimetres."""
    mm = {name: 1000 * value for name, value in gripper.items()}
    back, tip, side = -mm["palm_distance"], mm["fingertip_overlap"], mm["finger_width"] / 2
    inner, outer = width / 2, width / 2 + mm["finger_thickness"]
    half, high = mm["palm_length"] / 2, mm["palm_width"] / 2
    boxes = [((back, -outer, -side), (tip, -inner, side)), ((back, inner, -side), (tip, outer, side)),
             ((back - mm["palm_depth"], -half, -high), (back, half, high))]
    return [face for low, high_ in boxes for face in box_faces(low, high_, pose)]


class Drawing:
    def __init__(self):
        self.items, self.points = [], []

    def at(self, point):
        right, down, depth = seen(point)
        self.points.append((SCALE * right, SCALE * down))
        return SCALE * right, SCALE * down, depth

    def face(self, corners, fill):
        places = [self.at(corner) for corner in corners]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y, _ in places)
        depth = sum(place[2] for place in places) / len(places)
        self.items.append((depth, f'<polygon points="{path}" fill="{fill}" fill-opacity="0.3" stroke="{fill}" '
                                  'stroke-linejoin="round"/>'))

    def over(self, text):
        self.items.append((math.inf, text))

    def dot(self, point, label):
        x, y, _ = self.at(point)
        self.over(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5"/><text x="{x + 6:.1f}" y="{y - 7:.1f}">{label}</text>')

    def frame(self, pose, length, label, shift):
        origin = self.at(poses.column(pose, 3))
        for k, (name, colour) in enumerate(AXES):
            tip = [a + length * b for a, b in zip(poses.column(pose, 3), poses.column(pose, k))]
            x, y, _ = self.at(tip)
            size = max(math.hypot(x - origin[0], y - origin[1]), 1e-9)
            u, v = (x - origin[0]) / size, (y - origin[1]) / size
            head = f"{x:.1f},{y:.1f} {x - 9 * u - 4 * v:.1f},{y - 9 * v + 4 * u:.1f} {x - 9 * u + 4 * v:.1f},{y - 9 * v - 4 * u:.1f}"
            self.over(f'<line x1="{origin[0]:.1f}" y1="{origin[1]:.1f}" x2="{x - 5 * u:.1f}" y2="{y - 5 * v:.1f}" '
                      f'stroke="{colour}" stroke-width="2.5"/><polygon points="{head}" fill="{colour}"/>'
                      f'<text x="{x + 11 * u:.1f}" y="{y + 11 * v + 5:.1f}" text-anchor="middle" fill="{colour}">{name}</text>')
        x, y = origin[0] + shift[0], origin[1] + shift[1]
        side = 1 if shift[0] > 0 else -1
        self.over(f'<line x1="{origin[0]:.1f}" y1="{origin[1]:.1f}" x2="{x - 4 * side:.1f}" y2="{y - 4:.1f}" stroke="black" '
                  f'stroke-dasharray="3 3"/><text x="{x:.1f}" y="{y:.1f}" font-weight="bold" '
                  f'text-anchor="{"start" if side > 0 else "end"}">{label}</text>')

    def svg(self):
        left, top = (min(p[k] for p in self.points) - MARGIN for k in range(2))
        width, height = (max(p[k] for p in self.points) + MARGIN - low for k, low in enumerate((left, top)))
        right = 120  # room for the labels
        body = "\n".join(text for _, text in sorted(self.items, key=lambda item: item[0]))
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 2 * right:.0f}" height="{height:.0f}" '
                f'viewBox="{left - right:.1f} {top:.1f} {width + 2 * right:.1f} {height:.1f}" '
                'font-family="sans-serif" font-size="15">\n'
                f'<rect x="{left - right:.1f}" y="{top:.1f}" width="100%" height="100%" fill="white"/>\n{body}\n</svg>\n')


def in_millimetres(pose):
    return [row[:3] + [1000 * row[3]] for row in pose[:3]] + [pose[3]]


def main(obj, table, metric, out):
    gripper = poses.read_metric(metric)["gripper"]
    here = poses.turned_about_z([0.0, 0.0, 0.0], 0.0)
    row = poses.choose(poses.read_grasps(table), here, 45.0, None)
    grasp = in_millimetres(poses.grasp_in_object(row))
    base = in_millimetres(poses.times(poses.grasp_in_object(row), poses.base_from_grasp(gripper)))
    drawing = Drawing()
    for face in read_obj(obj):
        drawing.face(face, "#8d6e63")
    for face in gripper_faces(gripper, 1000 * float(row["width"]), grasp):
        drawing.face(face, "#607d8b")
    drawing.frame(here, 20, "object (the file's origin)", (40, 34))
    drawing.frame(grasp, 26, "grasp", (150, 4))
    drawing.frame(base, 38, "gripper's base", (150, -20))
    for name in ("p1", "p2"):
        drawing.dot([1000 * value for value in poses.vector(row, name)], name)
    with open(out, "w") as file:
        file.write(drawing.svg())


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
