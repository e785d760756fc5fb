#!/usr/bin/python3
"""Renders the impact of a droplet: the whole body and its meridian plane at six times, in one picture.

    render_droplet.py DIR/droplet.pvd PICTURE.png

reads the output of cases/droplet.toml: a quarter of the body, at x, y >= 0 on a wall at z = 0; or that of
cases/droplet_axisymmetric.toml: half of the meridian plane, the wall at x = 0, the axis at y = 0. Needs a display;
without one: xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' render_droplet.py ...
"""
import argparse
import math
import os
import sys

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from common.results import Failure, columns, outputs
from common.views import (
    INK,
    Sheet,
    actor_of,
    contour_of,
    is_meridian,
    mirrored,
    need_display,
    read_body,
    result_of,
    surface_of,
    text,
    view_of_body,
    wall_of,
)

COLUMNS, ROWS = 3, 2
TILE = (640, 560)
PLANE_PART = 0.32  # of a tile's height, for the meridian plane
BAR = 90  # height of the strip with the scales


def meridian_of(grid):
    """The plane y = 0 and its line alpha = 0.5."""
    half = grid
    if not is_meridian(grid):
        bounds = grid.GetBounds()
        plane = vtk.vtkPlane()
        plane.SetNormal(0, 1, 0)
        plane.SetOrigin(0, 1e-6 * (bounds[3] - bounds[2]), 0)
        cut = vtk.vtkCutter()
        cut.SetInputData(grid)
        cut.SetCutFunction(plane)
        half = result_of(cut)
    both = mirrored(half, "X")
    return both, contour_of(both)


def speed_colors(largest):
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToLab()
    stops = ((0.19, 0.27, 0.61), (0.27, 0.61, 0.77), (0.93, 0.93, 0.75), (0.96, 0.55, 0.26), (0.65, 0.06, 0.15))
    for i, color in enumerate(stops):
        table.AddRGBPoint(largest * i / (len(stops) - 1), *color)
    return table


def alpha_colors():
    table = vtk.vtkColorTransferFunction()
    table.AddRGBPoint(0, 1, 1, 1)
    table.AddRGBPoint(1, 0.36, 0.45, 0.62)
    return table


def scale_bar(table, title, sheet, left, right):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.SetPosition(0.1, 0.02)
    bar.SetPosition2(0.8, 0.6)
    bar.UnconstrainedFontSizeOn()
    style = bar.GetLabelTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(18)
    style.SetColor(*INK)
    style.ItalicOff()
    style.BoldOff()
    style.ShadowOff()
    strip = sheet.renderer(left, 0, right, BAR)
    strip.AddActor2D(bar)
    strip.AddActor2D(text(title, 18, (right - left) / 2, 0.7 * BAR))


def caption(time, columns, radius):
    def value(name):
        known = numpy.isfinite(columns[name])
        return numpy.interp(time, columns["time"][known], columns[name][known]) / radius if known.any() else math.nan

    parts = [f"t = {1e3 * time:.2f} ms"]
    for name, label in (("spread", "L/L0"), ("r95", "95 % radius/R0")):
        if name in columns and "time" in columns:
            parts.append(f"{label} = {value(name):.2f}")
    return "    ".join(parts)


def draw(pvd, picture, phase, radius):
    available = outputs(pvd)
    count = min(COLUMNS * ROWS, len(available))
    chosen = [available[round(i)] for i in numpy.linspace(0, len(available) - 1, count)]
    history = os.path.join(os.path.dirname(pvd), "history.csv")
    found = columns(history) if os.path.exists(history) else {}

    tiles = []
    for time, file in chosen:
        grid = read_body(file, phase)
        tiles.append((time, grid, surface_of(grid), meridian_of(grid)))
    speeds = [vtk_to_numpy(s.GetPointData().GetArray("speed")) for _, _, s, _ in tiles if s.GetNumberOfPoints()]
    if not speeds:
        raise Failure(f"{pvd}: no surface alpha.{phase} = 0.5 in any output")
    # A few fast splinters must not take the colours from the body.
    largest = math.ceil(2 * max(numpy.percentile(speed, 99) for speed in speeds)) / 2 or 0.5
    colors, shades = speed_colors(largest), alpha_colors()
    bounds = tiles[0][1].GetBounds()
    room, height = bounds[1], bounds[5]

    sheet = Sheet(COLUMNS * TILE[0], ROWS * TILE[1] + BAR)
    for i, (time, _, surface, (plane, line)) in enumerate(tiles):
        left, bottom = (i % COLUMNS) * TILE[0], BAR + (ROWS - 1 - i // COLUMNS) * TILE[1]
        split = bottom + PLANE_PART * TILE[1]

        view = sheet.renderer(left, split, left + TILE[0], bottom + TILE[1])
        view.AddActor(wall_of(room))
        body = actor_of(surface, colors, "speed")
        body.GetProperty().SetSpecular(0.15)
        view.AddActor(body)
        view_of_body(view, room, height)
        sheet.light.AddLightsToRenderer(view)
        view.AddActor2D(text(caption(time, found, radius), 20, TILE[0] / 2, TILE[1] * (1 - PLANE_PART) - 34))

        section = sheet.renderer(left, bottom, left + TILE[0], split)
        flat = actor_of(plane, shades, "alpha")
        flat.GetProperty().LightingOff()
        edge = actor_of(line, color=(0, 0, 0))
        edge.GetProperty().SetLineWidth(1.5)
        edge.GetProperty().LightingOff()
        edge.SetPosition(0, -0.05 * room, 0)
        ground = vtk.vtkLineSource()
        ground.SetPoint1(-room, 0, 0)
        ground.SetPoint2(room, 0, 0)
        floor = actor_of(result_of(ground), color=INK)
        floor.GetProperty().SetLineWidth(3)
        for part in (flat, edge, floor):
            section.AddActor(part)
        camera = section.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(1.05 * room * PLANE_PART * TILE[1] / TILE[0])
        camera.SetFocalPoint(0, 0, 0.45 * height)
        camera.SetPosition(0, -10 * room, 0.45 * height)
        camera.SetViewUp(0, 0, 1)
        section.ResetCameraClippingRange()
    middle = COLUMNS * TILE[0] / 2
    scale_bar(colors, "speed on the surface alpha = 0.5  [m/s]", sheet, 0, middle)
    scale_bar(shades, "alpha in the meridian plane", sheet, middle, 2 * middle)
    sheet.write(picture)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("pvd", help="DIR/droplet.pvd")
    options.add_argument("picture", help="PNG to write")
    options.add_argument("--phase", default="carbopol", help="phase to show (default: carbopol)")
    options.add_argument("--radius", type=float, default=6e-3, help="R0 [m] (default: 6e-3)")
    given = options.parse_args()
    try:
        need_display("render_droplet.py")
        draw(given.pvd, given.picture, given.phase, given.radius)
    except Failure as failure:
        sys.exit(f"render_droplet: {failure}")


if __name__ == "__main__":
    main()
