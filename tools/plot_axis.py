#!/usr/bin/python3
"""Plots a line of samples: mixture density, velocity, stress, and the volume fractions.

    plot_axis.py DIR/axis.csv PICTURE.png

reads what a [[line]] of a case leaves at the end of its run, in the columns' own units.
"""
import argparse
import json
import os
import sys

import numpy

from common.results import Failure, columns as read


def last_time(file):
    """Of the .series beside the line; nothing where there is none."""
    try:
        with open(os.path.splitext(file)[0] + ".series") as series:
            return json.load(series)["files"][-1]["time"]
    except (OSError, ValueError, LookupError):
        return None


def panels(columns):
    """[(label, {column: values})]: components that vanish throughout are left out."""

    def shown(names, always):
        found = {name: columns[name] for name in names if name in columns}
        return {name: y for name, y in found.items() if name == always or numpy.nanmax(numpy.abs(y)) > 0}

    alphas = {name: y for name, y in columns.items() if name.startswith("alpha.")}
    every = [
        ("density [kg/m³]", shown(["density"], "density")),
        ("velocity [m/s]", shown([f"velocity.{c}" for c in "xyz"], "velocity.x")),
        ("stress [Pa]", shown([f"stress.{c}" for c in ("xx", "xy", "xz")], "stress.xx")),
        ("volume fraction", alphas),
    ]
    return [(label, lines) for label, lines in every if lines]


def draw(file, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plot

    columns = read(file)
    missing = [name for name in "xyz" if name not in columns]
    if missing:
        raise Failure(f"{file}: no column {missing[0]}; it has: {', '.join(columns)}")
    points = numpy.stack([columns[name] for name in "xyz"], axis=1)
    along = max(range(3), key=lambda i: numpy.ptp(points[:, i]))
    chosen = panels(columns)
    if not chosen:
        raise Failure(f"{file}: no density, velocity, stress or alpha; it has: {', '.join(columns)}")

    figure, axes = plot.subplots(len(chosen), 1, sharex=True, figsize=(8, 2.3 * len(chosen)), squeeze=False)
    for axis, (label, lines) in zip(axes[:, 0], chosen):
        for name, values in lines.items():
            axis.plot(points[:, along], values, label=name, linewidth=1.2)
        low = min(numpy.nanmin(values) for values in lines.values())
        high = max(numpy.nanmax(values) for values in lines.values())
        if high - low < 1e-4 * max(abs(low), abs(high)):  # do not magnify round-off into waves
            axis.set_ylim(low - 0.05 * abs(low) - 1e-300, high + 0.05 * abs(high) + 1e-300)
        axis.ticklabel_format(useOffset=False)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        if len(lines) > 1:
            axis.legend(fontsize=8)
    axes[-1, 0].set_xlabel(f"{'xyz'[along]} [m]")
    time = last_time(file)
    where = os.path.join(os.path.basename(os.path.dirname(os.path.abspath(file))), os.path.basename(file))
    axes[0, 0].set_title(where if time is None else f"{where}, t = {time:g} s", fontsize=10)
    figure.tight_layout()
    try:
        figure.savefig(picture, dpi=110)
    except OSError as error:
        raise Failure(error) from None


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("line", help="CSV file of a [[line]]")
    options.add_argument("picture", help="PNG to write")
    given = options.parse_args()
    try:
        draw(given.line, given.picture)
    except Failure as failure:
        sys.exit(f"plot_axis: {failure}")


if __name__ == "__main__":
    main()
