#!/usr/bin/python3
"""Draws what `cobasis study` found: every number against the size of the cells, and what the meshes cost.

    plot_study.py DIR

reads DIR/study.csv, DIR/meshes.csv and DIR/forecast.csv and writes DIR/study.png. Circles are runs; the bar at size 0
is the value with its error; the line is the power law through the three finest meshes, where they follow one.
"""
import argparse
import csv
import math
import os
import sys

from common.results import Failure

most_panels = 11


def read(file):
    """Rows of a table by column."""
    try:
        with open(file, newline="") as lines:
            return list(csv.DictReader(lines))
    except OSError as error:
        raise Failure(error) from None


def is_worth_drawing(row):
    value, error = float(row["value"]), float(row["error"])
    return math.isfinite(value) and not (row["trend"] == "same" and abs(value) <= error)


def draw_quantity(axis, row, h):
    values = [float(row[f"mesh_{i + 1}"]) for i in range(len(h))]
    value, error, order = (float(row[name]) for name in ("value", "error", "order"))
    if row["trend"] == "asymptotic":
        fine = [h[-1] * i / 50 for i in range(51)] + [h[-1] + (h[-3] - h[-1]) * i / 50 for i in range(1, 51)]
        slope = (values[-1] - value) / h[-1] ** order
        axis.plot(fine, [value + slope * x**order for x in fine], color="0.6", linewidth=1)
    axis.plot(h, values, "o", color="tab:blue")
    good = row["trend"] in ("asymptotic", "same")
    axis.errorbar([0], [value], yerr=[error], fmt="s", capsize=5, color="tab:green" if good else "tab:red")
    note = {"asymptotic": f"order {order:.2f}", "same": "the same on all meshes"}.get(row["trend"], row["trend"])
    axis.set_title(f"{row['quantity']} ({note})", fontsize=9)
    axis.set_ylabel("" if row["unit"] == "1" else f"[{row['unit']}]")
    axis.set_xlim(-0.06 * h[0], 1.06 * h[0])


def draw_costs(axis, meshes, forecasts):
    h = [float(row["h"]) for row in meshes]
    axis.loglog(h, [float(row["core_seconds"]) for row in meshes], "o", color="tab:blue", label="measured")
    predicted = [(x, float(row["predicted_core_seconds"])) for x, row in zip(h, meshes)]
    predicted = [(x, y) for x, y in predicted if math.isfinite(y)]
    if predicted:
        axis.loglog(*zip(*predicted), "x", color="tab:orange", label="predicted from coarser meshes")
    together = [row for row in forecasts if row["quantity"] == "*"]
    for row in together:
        x, y = float(row["h"]), float(row["core_seconds"])
        axis.loglog([x], [y], "d", color="tab:green", label="forecast, all that converge" if row is together[0] else None)
        axis.annotate(f"  {float(row['accuracy']):g}", (x, y), fontsize=8)
    axis.set_title("core-seconds", fontsize=9)
    axis.set_ylabel("[core s]")
    axis.legend(fontsize=7)


def draw(directory):
    try:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plot
    except ImportError as error:
        raise Failure(error) from None

    study, meshes, forecasts = (read(os.path.join(directory, f"{name}.csv")) for name in ("study", "meshes", "forecast"))
    h = [float(row["h"]) for row in meshes]
    chosen = [row for row in study if is_worth_drawing(row)][:most_panels]
    columns = min(3, len(chosen) + 1)
    rows = math.ceil((len(chosen) + 1) / columns)
    figure, axes = plot.subplots(rows, columns, figsize=(4.2 * columns, 3.1 * rows), squeeze=False)
    panels = list(axes.flat)
    for axis, row in zip(panels, chosen):
        draw_quantity(axis, row, h)
    draw_costs(panels[len(chosen)], meshes, forecasts)
    for axis in panels[len(chosen) + 1 :]:
        axis.set_axis_off()
    for axis in panels[: len(chosen) + 1]:
        axis.grid(alpha=0.3)
        axis.set_xlabel("size of cells (1: the case's own)", fontsize=8)
    figure.tight_layout()
    picture = os.path.join(directory, "study.png")
    try:
        figure.savefig(picture + ".part", dpi=110, format="png")
        os.replace(picture + ".part", picture)
    except OSError as error:
        raise Failure(error) from None


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("directory", help="of a study")
    given = options.parse_args()
    try:
        draw(given.directory)
    except Failure as failure:
        sys.exit(f"plot_study: {failure}")


if __name__ == "__main__":
    main()
