"""Meshes made harder to grasp (docs/perturbation.md): search, random, rotation, exhaustive, shape.

Each takes a mesh, or a list, and gives a Perturbed, or a list: .mesh, .graspability_before and
_after, .hausdorff_pct and the other numbers of perturb.csv, those of the program for the same seed.
An object that cannot be changed has a status that says why, and no mesh.
"""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import _geometry
from ._geometry import Mesh, Metric, Perturbed, Polyhedron, shape
from ._given import metric_of, one_or_list

__all__ = ["Perturbed", "Polyhedron", "exhaustive", "random", "rotation", "search", "shape"]


def _run(method: str, meshes: Any, metric: Metric | None, seed: int, threads: int,
         options: dict[str, Any], judge: Any = None) -> Any:
    return one_or_list(meshes, lambda given: _geometry.perturb(
        method, given, judge, metric_of(metric), seed, threads, options))


def search(meshes: Any, metric: Metric | None = None, *, seed: int = 1, threads: int = 0,
           objective: str | Callable[[Mesh], float | None] = "epsilon", **options: Any) -> Any:
    """Descent on the metric within normals turned by alpha degrees, or search on a judge.

    objective: "epsilon"; a judge, "settled", "trial", "trial:PROTOCOL" or a command; or a function
    of a Mesh that answers with a number, lower = harder, or None. It is called from the threads of
    the work, one at a time; what it raises ends the search.
    options: those of `antigrasp perturb search --help`, with _ for -: alpha=20; hausdorff=5 with a
    judge. InputError for one that the objective makes no use of.
    """
    if callable(objective):
        return _run("search", meshes, metric, seed, threads, options, objective)
    return _run("search", meshes, metric, seed, threads, options | {"objective": objective})


def random(meshes: Any, metric: Metric | None = None, *, seed: int = 1, threads: int = 0,
           **options: Any) -> Any:
    """Section IV-B: random vertices of sampled pairs, normals kept within alpha degrees.

    options: those of `antigrasp perturb random --help`, with _ for -: alpha=10.
    """
    return _run("random", meshes, metric, seed, threads, options)


def rotation(meshes: Any, metric: Metric | None = None, *, seed: int = 1, threads: int = 0,
             **options: Any) -> Any:
    """Section IV-C: decimate, then turn the faces of sampled pairs apart.

    options: those of `antigrasp perturb rotation --help`, with _ for -: beta=0.075, max_faces=350.
    """
    return _run("rotation", meshes, metric, seed, threads, options)


def exhaustive(meshes: Any, metric: Metric | None = None, *, seed: int = 1, threads: int = 0,
               **options: Any) -> Any:
    """Section IV-A: every vertex of every antipodal face; for meshes of some hundred faces.

    options: those of `antigrasp perturb exhaustive --help`, with _ for -: iterations=64.
    """
    return _run("exhaustive", meshes, metric, seed, threads, options)
