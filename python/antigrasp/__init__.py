"""antigrasp: objects that look ordinary and that a gripper cannot hold.

    import antigrasp
    mesh = antigrasp.Mesh("mug.stl")                   # or (vertices, faces), or a trimesh
    score = antigrasp.evaluate(mesh)                   # score.graspability, .interval, .grasps

Meshes: Mesh, Grid. Scores: evaluate, evaluate_grasps, epsilon, with the constants of a Metric.
The same seed gives the same numbers as the program `antigrasp`, on any number of threads.
Whatever takes a mesh takes a file, or an object with vertices and faces, too.
Errors are InputError (also a ValueError) and Error, each with one line; warnings are Warning.
"""
from __future__ import annotations

from typing import Any

from . import _geometry
from ._errors import Error, InputError, Warning
from ._geometry import (GraspScores, Grasps, Grid, Inspection, Mesh, Metric, Score, StablePoses,
                        epsilon)
from ._given import mesh_of, metric_of, one_or_list

__version__: str = _geometry.version

__all__ = ["Error", "GraspScores", "Grasps", "Grid", "InputError", "Inspection", "Mesh", "Metric",
           "Score", "StablePoses", "Warning", "epsilon", "evaluate", "evaluate_grasps"]


def evaluate(meshes: Any, metric: Metric | None = None, *, seed: int = 1,
             threads: int = 0) -> Any:
    """The graspability of a mesh: a Score; of a list of meshes a list of them. Lower is harder.

    metric: the constants; without it the default's. Up to 100 meshes get 1000 grasps each, more of
    them 100, unless the metric says how many. threads: 0 = all; no number depends on it.
    What is no solid after repair has a Score with its status and NaN; InputError when no mesh has a
    score. Objects share random draws by their names: see Mesh.
    """
    return one_or_list(meshes, lambda given: _geometry.evaluate(given, metric_of(metric), seed,
                                                                threads))


def evaluate_grasps(mesh: Any, poses: Any, widths: Any = None, metric: Metric | None = None, *,
                    frame: str = "mesh", seed: int = 1) -> GraspScores:
    """Scores given grasps on a mesh, row by row, as `antigrasp evaluate --grasps-in` does.

    poses: the Grasps of a score (they score the same again), an array (N, 4, 4) with the approach,
    the axis from jaw to jaw and where the jaws meet in columns 0, 1 and 3, or (centers, axes), two
    arrays (N, 3). widths: array (N,), the openings, if they are known. frame: "mesh", the mesh's
    unit, or "metres", as the metric rescales it. Row i has the draws of candidate i.
    InputError for other shapes and a mesh that is no solid.
    """
    if frame not in ("mesh", "metres"):
        raise InputError(f"frame = {frame!r} (evaluate_grasps): expected 'mesh' or 'metres'")
    return _geometry.evaluate_grasps(mesh_of(mesh), poses, widths, frame == "metres",
                                     metric_of(metric), seed)
