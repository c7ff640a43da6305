#!/usr/bin/env python3
"""Scores a mesh of trimesh: score_trimesh.py [FILE]. Without a file a capsule that trimesh makes."""
import sys

try:
    import trimesh
except ImportError:
    print("skipped: trimesh is not installed")
    sys.exit(77)

import antigrasp

mesh = trimesh.load(sys.argv[1], force="mesh") if len(sys.argv) > 1 else trimesh.creation.capsule(60, 20)
score = antigrasp.evaluate(mesh)
low, high = score.interval
print(f"graspability {score.graspability:.5f} ({low:.5f} to {high:.5f}), {score.status}, {score.attempts} candidates")

best = score.grasps.qualities.argmax()  # metres, as the metric rescales the object
for jaw, point in enumerate(score.grasps.contacts[best] / score.metres_per_unit, 1):
    print(f"best grasp, jaw {jaw} at {point.round(2)} in the unit of the mesh")
