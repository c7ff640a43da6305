"""Sets of signed-distance grids: made, read, written (docs/formats.md)."""
from __future__ import annotations

import os

from . import _geometry
from ._geometry import ShapeSet

__all__ = ["ShapeSet", "make", "read"]


def make(kind: str, count: int = 1000, *, seed: int = 1, resolution: int = 32, grafts: int = 2,
         threads: int = 0) -> ShapeSet:
    """A synthetic prior set, what `antigrasp dataset make` writes: a ShapeSet.

    kind: cylinders, prisms or bottles; resolution: nodes of a grid along a side, 16 to 256; grafts:
    of a shape's two those left on it. Shape i depends on kind, seed and i alone.
    InputError for another kind and numbers out of range.
    """
    return _geometry.make_shapes(kind, count, seed, resolution, grafts, threads)


def read(path: str | os.PathLike[str]) -> ShapeSet:
    """The grids of a file: .h5, .npy, .npz or .vti. InputError for what is none."""
    return _geometry.read_shapes(path)
