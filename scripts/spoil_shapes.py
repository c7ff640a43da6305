#!/usr/bin/python3
"""Spoils the shapes of an SDF file on purpose, to see which measures of `antigrasp compare` notice.

    scripts/spoil_shapes.py prisms.h5 lumpy.h5 --noise 2    white noise, percent of a cell
    scripts/spoil_shapes.py prisms.h5 round.h5 --blur 1     a Gaussian blur of the grid, deviation in cells: edges get round

Both together: first the blur. Needs h5py and numpy. The third fault, shapes that lack parts: antigrasp dataset make --grafts 0.
"""
import argparse
import pathlib
import shutil

import h5py
import numpy


def blurred(grid, sigma):
    """The border is repeated outward."""
    reach = int(4 * sigma + 0.5)
    weights = numpy.exp(-0.5 * (numpy.arange(-reach, reach + 1) / sigma) ** 2)
    weights /= weights.sum()
    for axis in range(3):
        n = grid.shape[axis]
        padded = numpy.pad(grid, [(reach, reach) if axis == k else (0, 0) for k in range(3)], mode="edge")
        grid = sum(weight * padded.take(range(i, i + n), axis) for i, weight in enumerate(weights))
    return grid


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--noise", type=float, default=0.0, metavar="PERCENT")
    parser.add_argument("--blur", type=float, default=0.0, metavar="CELLS")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    if args.noise < 0 or args.blur < 0:
        parser.error("--noise and --blur: at least 0")
    if not args.input.is_file():
        parser.error(f"{args.input}: no such file")
    if args.output.exists():
        parser.error(f"{args.output} exists")
    part = args.output.with_name(args.output.name + ".part")
    shutil.copyfile(args.input, part)
    with h5py.File(part, "r+") as file:
        grids, random = file["sdf"], numpy.random.default_rng(args.seed)
        deviation = args.noise / 100 * file.attrs["spacing"]
        for i in range(len(grids)):
            grid = grids[i].astype(float)
            if args.blur > 0:
                grid = blurred(grid, args.blur)
            grids[i] = grid + deviation * random.standard_normal(grid.shape)
    part.rename(args.output)


if __name__ == "__main__":
    main()
