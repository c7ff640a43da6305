#!/usr/bin/env python3
"""A judge for antigrasp: how much of an object's surface two jaws could close on.

    antigrasp evaluate part.stl --judge "python3 examples/judge/antipodal_judge.py"

The score is the share of points, uniform over the surface, from which a jaw that closes against the surface finds the
other side within the opening and within the friction cone: a cube has 1, a tetrahedron 0. It needs NumPy alone and takes
some 20 ms an object of 2,500 triangles. A learnt policy goes in its place: read a mesh, say a number (docs/judges.md).
"""
import json
import math
import sys

import numpy as np

FRICTION = 0.5
OPENING = 0.05  # m
POINTS = 64


def read_stl(path):
    """Corners of the triangles of a binary STL, (n, 3, 3)."""
    with open(path, "rb") as file:
        data = file.read()
    count = int.from_bytes(data[80:84], "little")
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, count, 84)["corners"].astype(float)


def cast(origin, direction, corners):
    """Distance to the first triangle along a ray and its number; infinity when there is none (Moller and Trumbore)."""
    a, e1, e2 = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(direction, e2)
    det = np.einsum("ij,ij->i", e1, p)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = origin - a
        u = np.einsum("ij,ij->i", s, p) / det
        q = np.cross(s, e1)
        v = q @ direction / det
        t = np.einsum("ij,ij->i", e2, q) / det
    t[~((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-9))] = math.inf
    hit = int(np.argmin(t))
    return t[hit], hit


def score(corners):
    """`corners` in metres; the same number for the same mesh."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(cross, axis=1)
    if not area.sum() > 0:
        return None
    normals = cross / np.where(area > 0, area, 1)[:, None]
    random = np.random.default_rng(1)
    held = 0
    for face in random.choice(len(area), POINTS, p=area / area.sum()):
        u, v = random.random(2)
        if u + v > 1:
            u, v = 1 - u, 1 - v
        a, b, c = corners[face]
        point = a + u * (b - a) + v * (c - a)
        distance, opposite = cast(point - 1e-7 * normals[face], -normals[face], corners)
        angle = math.acos(np.clip(-normals[face] @ normals[opposite], -1, 1))
        held += distance <= OPENING and angle <= math.atan(FRICTION)
    return held / POINTS


def main():
    for line in sys.stdin:
        request = json.loads(line)
        corners = request["metres_per_unit"] * read_stl(request["mesh"])
        print(json.dumps({"id": request["id"], "score": score(corners)}), flush=True)


if __name__ == "__main__":
    main()
