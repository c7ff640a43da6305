"""What functions take: meshes in whatever shape, one or many."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from ._geometry import Mesh, Metric

Result = TypeVar("Result")


def mesh_of(thing: Any) -> Mesh:
    return thing if isinstance(thing, Mesh) else Mesh(thing)


def metric_of(metric: Metric | None) -> Metric:
    return Metric() if metric is None else metric


def one_or_list(things: Any, work: Callable[[list[Mesh]], list[Result]]) -> Result | list[Result]:
    """The result of an only mesh, a list of those of a list."""
    if isinstance(things, Sequence) and not isinstance(things, str):
        return work([mesh_of(thing) for thing in things])
    return work([mesh_of(things)])[0]
