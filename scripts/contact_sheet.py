#!/usr/bin/env python3
"""Draws rows of binary STL files as one PNG: the picture in the README. Not part of the build.

    apt-get install python3-matplotlib
    scripts/contact_sheet.py OUT.png "label=GLOB" ["label=GLOB" ...]
"""
import glob
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

COLUMNS = 8
LIGHT = np.array([0.4, -0.5, 0.77])
COLOR = np.array([0.42, 0.55, 0.78])
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path):
    with open(path, "rb") as file:
        return np.frombuffer(file.read()[84:], dtype=FACET)["corners"].astype(float)


def draw(axes, triangles):
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
    shade = 0.35 + 0.65 * np.clip(normals @ LIGHT, 0, 1)
    colors = np.clip(np.outer(shade, COLOR), 0, 1)
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=colors, edgecolors=colors, linewidths=0.2))
    points = triangles.reshape(-1, 3)
    center, half = (points.max(0) + points.min(0)) / 2, (points.max(0) - points.min(0)).max() / 2
    axes.set_xlim(center[0] - half, center[0] + half)
    axes.set_ylim(center[1] - half, center[1] + half)
    axes.set_zlim(center[2] - half, center[2] + half)
    axes.set_axis_off()
    axes.view_init(20, -60)
    axes.set_box_aspect((1, 1, 1), zoom=1.35)


def main():
    rows = [argument.split("=", 1) for argument in sys.argv[2:]]
    figure = plt.figure(figsize=(COLUMNS * 1.5, len(rows) * 1.65))
    for row, (label, pattern) in enumerate(rows):
        for column, path in enumerate(sorted(glob.glob(pattern))[:COLUMNS]):
            axes = figure.add_subplot(len(rows), COLUMNS, row * COLUMNS + column + 1, projection="3d")
            draw(axes, read_stl(path))
            if column == 0:
                axes.text2D(0, 1.0, label, transform=axes.transAxes, fontsize=9)
    figure.subplots_adjust(0, 0, 1, 0.97, 0, 0)
    figure.savefig(sys.argv[1], dpi=90)


if __name__ == "__main__":
    main()
