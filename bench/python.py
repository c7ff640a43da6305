#!/usr/bin/env python3
"""What the Python package is worth beside NumPy and SciPy: PYTHONPATH=build/release/python bench/python.py

epsilon of a million grasps in one call, beside a loop that builds each grasp's wrenches with NumPy and their hull with
SciPy, on a thousand of the same grasps; and what a call of evaluate costs beside its work. Prints `ratio NAME VALUE`.
"""
import time

import numpy as np
from scipy.spatial import ConvexHull, QhullError

import antigrasp
from antigrasp import Metric, datasets

FRICTION, EDGES, RADIUS, SCALE = 0.5, 8, 0.005, 1000.0


def tangents(inward):
    """The first edge of the pyramid is x across the normal (docs/metric.md)."""
    first = np.array([1.0, 0, 0]) - inward[0] * inward
    first /= np.linalg.norm(first)
    return first, np.cross(inward, first)


def hull_epsilon(points, normals, com):
    wrenches = []
    torsions = []
    for point, normal in zip(points, normals):
        inward = -normal
        first, second = tangents(inward)
        angles = 2 * np.pi * np.arange(EDGES) / EDGES
        forces = inward + FRICTION * (np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second)
        wrenches.append(np.hstack([forces, SCALE * np.cross(point - com, forces)]))
        torsion = np.hstack([np.zeros(3), SCALE * np.pi * RADIUS**2 * FRICTION * inward])
        torsions += [torsion, -torsion]
    try:
        hull = ConvexHull(np.vstack([*wrenches, torsions]))
    except QhullError:
        return 0.0
    return max(0.0, -hull.equations[:, -1].max())


def best_of(times, call):
    best = np.inf
    for _ in range(times):
        start = time.perf_counter()
        result = call()
        best = min(best, time.perf_counter() - start)
    return best, result


def main():
    mesh = datasets.make("cylinders", 1).meshes()[0]
    grasps = antigrasp.evaluate(mesh, Metric(num_grasps=1000, max_attempts=40000)).grasps
    com = mesh.center_of_mass * grasps.metres_per_unit
    points, normals = np.array(grasps.contacts), np.array(grasps.normals)
    some = len(points)
    loop, slow = best_of(1, lambda: np.array([hull_epsilon(p, n, com) for p, n in zip(points, normals)]))
    # A million different grasps: contacts moved by up to a millimetre along their faces' normals.
    rng = np.random.default_rng(1)
    repeats = -(-1_000_000 // some)
    many_points = np.tile(points, (repeats, 1, 1))[:1_000_000]
    many_normals = np.tile(normals, (repeats, 1, 1))[:1_000_000]
    many_points = many_points + rng.uniform(-.001, .001, (len(many_points), 1, 1)) * many_normals
    both = antigrasp.epsilon(points, normals, com)
    print(f"largest difference of the two, of {some} grasps: {np.abs(both - slow).max():.2e}")
    for threads in (1, 0):
        fast, _ = best_of(3, lambda: antigrasp.epsilon(many_points, many_normals, com, threads=threads))
        name = "one_thread" if threads == 1 else "all_threads"
        print(f"{name}: {1e6 * fast / len(many_points):.3f} us a grasp; NumPy and SciPy {1e6 * loop / some:.0f} us")
        print(f"ratio python_epsilon_{name} {loop / some / (fast / len(many_points)):.0f}")

    antigrasp.evaluate(mesh)  # looks at the mesh once
    beside, work = [], []
    for _ in range(40):
        score = None
        start = time.perf_counter()
        score = antigrasp.evaluate(mesh)
        beside.append(time.perf_counter() - start - score.seconds)
        work.append(score.seconds)
    # The least of each: all else is other processes.
    print(f"a call of evaluate takes {1e3 * min(beside):.2f} ms beside its work, {1e3 * min(work):.1f} ms")
    print(f"ratio python_evaluate_overhead {1 + min(beside) / min(work):.4f}")


if __name__ == "__main__":
    main()
