#!/usr/bin/env python3
"""Draws what a change does to the grasps of an object: figures.py OUT.png"""
import sys

try:
    import matplotlib
except ImportError:
    print("skipped: matplotlib is not installed")
    sys.exit(77)
matplotlib.use("Agg")
import matplotlib.pyplot as plt

import antigrasp
from antigrasp import datasets, perturb

mesh = datasets.make("prisms", 1, seed=3).meshes()[0]
changed = perturb.random(mesh, alpha=20)
scores = antigrasp.evaluate([changed.before, changed.mesh])

figure, (histogram, axes) = plt.subplots(1, 2, figsize=(9, 4))
for score, name in zip(scores, ("before", "after")):
    histogram.hist(score.grasps.qualities, bins=30, histtype="step",
                   label=f"{name}: graspability {score.graspability:.5f}")
histogram.set_xlabel("robust quality of a grasp")
histogram.legend()

grasps = scores[1].grasps
points = axes.scatter(1e3 * grasps.centers[:, 0], 1e3 * grasps.centers[:, 1], c=grasps.qualities, s=8)
axes.set(xlabel="x of the grasps' centers, mm", ylabel="y, mm", aspect="equal")
figure.colorbar(points, label="robust quality, after")
figure.tight_layout()
figure.savefig(sys.argv[1])
print(f"{sys.argv[1]}: {len(grasps)} grasps")
