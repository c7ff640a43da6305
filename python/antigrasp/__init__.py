"""antigrasp: objects that look ordinary and that a gripper cannot hold.

    import antigrasp
    mesh = antigrasp.Mesh("mug.stl")                   # or (vertices, faces), or a trimesh
    score = antigrasp.evaluate(mesh)                   # score.graspability, .interval, .grasps

Meshes: Mesh, Grid, read. Scores: evaluate, evaluate_grasps, epsilon, with the constants of a Metric;
trial tries grasps in physics. perturb makes meshes harder to grasp, datasets holds sets of grids,
compare measures one set against another. load and train, with all of antigrasp.networks, need
LibTorch, which is loaded when they are first asked for. The same seed gives the same numbers as the program `antigrasp`, on any number of threads.
Whatever takes a mesh takes a file, or an object with vertices and faces, too.
Errors are InputError (also a ValueError) and Error, each with one line; warnings are Warning.
"""
from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

from . import _geometry, datasets, perturb
from ._errors import Error, InputError, Warning
from ._geometry import (Comparison, GraspScores, Grasps, Grid, Inspection, Mesh, Metric, Score,
                        ShapeSet, StablePoses, Trial, epsilon)
from ._given import mesh_of, metric_of, one_or_list

if TYPE_CHECKING:
    from . import networks
    from .networks import load, train

__version__: str = _geometry.version

__all__ = ["Comparison", "Error", "GraspScores", "Grasps", "Grid", "InputError", "Inspection", "Mesh",
           "Metric", "Score", "ShapeSet", "StablePoses", "Trial", "Warning", "compare", "datasets",
           "epsilon", "evaluate", "evaluate_grasps", "load", "networks", "perturb", "read", "train",
           "trial"]


def __getattr__(name: str) -> Any:
    if name not in ("load", "networks", "train"):
        raise AttributeError(f"module 'antigrasp' has no attribute {name!r}")
    networks = importlib.import_module(".networks", __name__)
    return networks if name == "networks" else getattr(networks, name)


def read(*paths: str | os.PathLike[str], threads: int = 0) -> list[Mesh]:
    """The objects of mesh files, folders (searched recursively) and SDF files, as commands take them.

    Names are told apart as there. What is no solid has a status that says why.
    InputError for a missing path, for a file of unknown kind and for no object at all.
    """
    return _geometry.read_objects([os.fspath(path) for path in paths], threads)


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


def trial(meshes: Any, protocol: str = "six-ways", metric: Metric | None = None, *, seed: int = 1,
          threads: int = 0, **options: Any) -> Any:
    """Executes planned grasps in physics (MuJoCo): a Trial of a mesh, a list of those of a list.

    protocol: six-ways, paper, graspdatagen or dexgraspbench (docs/trials.md). metric: of the grasps;
    its friction is the trial's, unless the protocol lays down another and the metric was not told.
    options: those of `antigrasp trial --help`, with _ for -: mass=0.05 (kg; 0 = its own), draws=5,
    tip="pad". InputError for one that the protocol makes no use of, and when nothing could be tried.
    """
    return one_or_list(meshes, lambda given: _geometry.trial(given, protocol, metric_of(metric),
                                                             seed, threads, options))


def _compared(things: Any) -> Any:
    if isinstance(things, (str, os.PathLike)):
        return os.fspath(things)
    return things if isinstance(things, ShapeSet) else [mesh_of(thing) for thing in things]


def compare(samples: Any, reference: Any, training: Any = None, *, units: str = "m",
            count: int = 500, points: int = 1024, normals: float = 1.0, seed: int = 1,
            threads: int = 0) -> Comparison:
    """Two sets of shapes on their surfaces, as `antigrasp compare`: a Comparison.

    Each is a file, a folder, a ShapeSet (in its unit cube) or a list of meshes. training: what the
    samples' generator was trained on, to look for copies. units: what the coordinates are in; count:
    most shapes of either; points: on a shape; normals: their weight, 0 for places alone.
    InputError for sets of fewer than two solids and numbers out of range.
    """
    return _geometry.compare(_compared(samples), _compared(reference),
                             None if training is None else _compared(training), units, count, points,
                             normals, seed, threads)
