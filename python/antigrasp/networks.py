"""What needs LibTorch: networks that draw objects, and the loop that trains them.

Importing this loads LibTorch, and has it and oneDNN take AVX2's kernels unless the environment says
otherwise, so that a seed gives the same bytes everywhere. OpenBLAS chooses when NumPy loads it: where
it took others, a Warning says what to set.
"""
from __future__ import annotations

import csv
import ctypes
import io
import os
import pathlib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _geometry
from ._errors import Error, Warning
from ._geometry import Mesh, ShapeSet

# Those that were installed beside this package, wherever the prefix was moved to since.
for _folder in pathlib.Path(__file__).parents:
    if (_folder / "share/antigrasp/pretrained").is_dir():
        os.environ.setdefault("ANTIGRASP_PRETRAINED", str(_folder / "share/antigrasp/pretrained"))
        break
_geometry.ask_for_the_same_kernels_everywhere()
try:
    from . import _networks
except ImportError as error:
    raise Error(f"antigrasp has no networks here: it was built without LibTorch, or {error}") from error



def _blas_kernels() -> str:
    """Those of OpenBLAS in this process, "Haswell" for AVX2's; "" where another BLAS is at work."""
    try:
        name = ctypes.CDLL("libopenblas.so.0").openblas_get_corename
    except (OSError, AttributeError):
        return ""
    name.restype = ctypes.c_char_p
    return name().decode()


if "OPENBLAS_CORETYPE" not in os.environ and _blas_kernels() not in ("", "Haswell"):
    warnings.warn(f"OpenBLAS was loaded with the kernels of {_blas_kernels()}: last digits of samples and training "
                  "differ from the program's. OPENBLAS_CORETYPE=Haswell, set before Python starts, gives its bytes",
                  Warning, stacklevel=2)

__all__ = ["Episode", "Networks", "Run", "load", "pretrained", "train"]


def pretrained() -> list[str]:
    """The names of the networks that ship."""
    return _networks.pretrained()


class Networks:
    """Networks that draw objects: see load."""

    def __init__(self, networks: Any) -> None:
        self._networks = networks

    @property
    def path(self) -> str:
        """The file that they were found in."""
        return os.fspath(self._networks.path())

    @property
    def config(self) -> str:
        """What they were trained with (TOML)."""
        return self._networks.config()

    def sample(self, count: int = 64, *, seed: int = 1, first: int = 0) -> ShapeSet:
        """Samples first to first + count - 1 of this seed: what `antigrasp sample` writes.

        Sample i does not depend on count. InputError for a count out of [1, 1000000].
        """
        values, about = self._networks.sample(count, seed, first)
        return ShapeSet(values, **about)


def load(networks: str | os.PathLike[str], *, device: str = "cpu", threads: int = 0,
         fairing: float = -1.0, fairing_power: float = -1.0) -> Networks:
    """Networks of a checkpoint, of the folder of a run, or that ship: "cylinders-prior".

    device: cpu, cuda, cuda:1; fairing, fairing_power: as `antigrasp sample`, below 0 the networks'
    own. InputError for what are none.
    """
    return Networks(_networks.Networks(os.fspath(networks), device, threads, fairing, fairing_power))


@dataclass(frozen=True)
class Episode:
    """A finished episode: its samples scored, and what the next one learns from."""
    number: int                    # 0: the networks of the prior set
    samples: ShapeSet              # .meshes(), .values (N, n, n, n)
    scores: np.ndarray             # (N,): graspability, or what the judge said; NaN of no usable object
    elites: np.ndarray             # places in samples, ascending
    statistics: dict[str, float]   # its row of statistics.csv


class Run:
    """A run, an episode a turn: see train."""

    def __init__(self, run: Any) -> None:
        self._run = run

    def __iter__(self) -> Iterator[Episode]:
        return self

    def __next__(self) -> Episode:
        found = self._run.next()
        if found is None:
            raise StopIteration
        number, values, about, scores, elites = found
        return Episode(number, ShapeSet(values, **about), scores, np.array(elites, dtype=np.int64),
                       self.statistics[-1])

    @property
    def statistics(self) -> list[dict[str, float]]:
        """statistics.csv so far (docs/formats.md): a row a stage, the prior set's (-1) first."""
        rows = csv.DictReader(io.StringIO(self._run.statistics()))
        return [{name: float(text) for name, text in row.items()} for row in rows]

    @property
    def config(self) -> str:
        """Every setting (TOML)."""
        return self._run.config()

    def save(self, path: str | os.PathLike[str]) -> None:
        """The networks as they are now: a checkpoint for load, `antigrasp sample`, `train --from`."""
        self._run.save(path)


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def train(config: str | os.PathLike[str] | None = None, settings: dict[str, Any] | None = None, *,
          judge: Callable[[Mesh], float | None] | None = None, start: str = "", fine_tune: bool = False,
          gripper: str = "", progress: Callable[[str, int, int], Any] | None = None) -> Run:
    """The episode loop, stepped: for episode in antigrasp.train("configs/smoke.toml"): ...

    config: a file (TOML), without one defaults; settings: over it, {"cem.episodes": 2}, as --set;
    start, fine_tune, gripper: as --from, --fine-tune, --gripper of `antigrasp train`. The numbers
    are those of that command; nothing is written, and there is no control (cem.control).
    judge: a function of a Mesh, a number, lower = kept, or None, in the place of the metric. What it
    raises leaves the loop, and the next turn of the same run begins with the scoring again.
    progress: called with what is done, how much of it and of how much.
    InputError for settings that are unknown, out of range or do not fit.
    """
    texts = [f"{key}={_text(value)}" for key, value in (settings or {}).items()]
    return Run(_networks.begin("" if config is None else os.fspath(config), texts, gripper, start,
                               fine_tune, judge, progress))
