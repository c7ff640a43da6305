#!/usr/bin/env python3
"""Makes a block harder for a judge of one's own: judge.py [GENERATIONS].

The judge is a function of a mesh: here the share of the surface that some other face opposes squarely enough to be
pinched. Lower is harder. Any policy that scores a mesh can stand in its place.
"""
import sys

import numpy as np

import antigrasp
from antigrasp import Metric, perturb

CONE = np.degrees(np.arctan(0.25))  # half the friction cone


def pinchable(mesh):
    corners = mesh.vertices[mesh.faces]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    twice_area = np.linalg.norm(cross, axis=1)
    normals = cross / twice_area[:, None]
    opposed = (-normals @ normals.T).max(axis=1) > np.cos(np.radians(CONE))
    return twice_area[opposed].sum() / twice_area.sum()


x, y, z = 60, 40, 25
vertices = [[i, j, k] for k in (0, z) for i, j in ((0, 0), (x, 0), (x, y), (0, y))]
faces = [[0, 3, 2], [0, 2, 1], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6],
         [3, 0, 4], [3, 4, 7]]
block = antigrasp.Mesh(vertices, faces, name="block")
generations = int(sys.argv[1]) if len(sys.argv) > 1 else 15

harder = perturb.search(block, Metric(friction=0.25), objective=pinchable, hausdorff=5, generations=generations)
print(f"pinchable {harder.judge_before:.3f} -> {harder.judge_after:.3f}, "
      f"graspability {harder.graspability_before:.5f} -> {harder.graspability_after:.5f}, "
      f"surface moved by {harder.hausdorff_pct:.1f} % of the diagonal")
