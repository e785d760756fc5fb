#!/usr/bin/python3
"""Renders the impact of a droplet: the whole body and its meridian plane at six times, in one picture.

    render_droplet.py DIR/droplet.pvd PICTURE.png

reads the output of cases/droplet.toml: a quarter of the body, at x, y >= 0 on a wall at z = 0; or that of
cases/droplet_axisymmetric.toml: half of the meridian plane, the wall at x = 0, the axis at y = 0. Needs a display; without
one: xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' render_droplet.py ...
"""
import argparse
import csv
import math
import os
import sys
import xml.etree.ElementTree

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

COLUMNS, ROWS = 3, 2
TILE = (640, 560)
PLANE_PART = 0.32  # of a tile's height, for the meridian plane
BAR = 90  # height of the strip with the scales
INK = (0.15, 0.15, 0.15)


class Failure(Exception):
    pass


def outputs(pvd):
    """[(time, file)] of a .pvd."""
    try:
        root = xml.etree.ElementTree.parse(pvd).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        raise Failure(f"{pvd}: {error}") from None
    found = [(float(d.get("timestep")), os.path.join(os.path.dirname(pvd), d.get("file"))) for d in root.iter("DataSet")]
    if not found:
        raise Failure(f"{pvd}: lists no output")
    return found


def history(file):
    """{column: values} of history.csv; empty if there is none."""
    try:
        with open(file, newline="") as lines:
            rows = list(csv.DictReader(lines))
    except OSError:
        return {}
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]} if rows else {}


def result_of(algorithm):
    """Its output as data: a port alone does not keep its filter alive."""
    algorithm.Update()
    return algorithm.GetOutput()


def is_meridian(grid):
    """Whether it is a part of the plane y = 0 alone, see without_seams."""
    bounds = grid.GetBounds()
    return bounds[2] == bounds[3]


def without_seams(grid):
    """The grid with one point where the pieces of several ranks have one each; no data. Half of a meridian plane comes to
    stand where that of a body in space does."""
    corners, joined = numpy.unique(vtk_to_numpy(grid.GetPoints().GetData()), axis=0, return_inverse=True)
    if not corners[:, 2].any():
        corners = corners[:, [1, 2, 0]].copy()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(corners, deep=True))
    ids = joined[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    cells = vtk.vtkCellArray()
    cells.SetData(grid.GetCells().GetOffsetsArray(), numpy_to_vtkIdTypeArray(ids.astype(numpy.int64), deep=True))
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points)
    result.SetCells(grid.GetCellTypesArray(), cells)
    return result


def read(file, phase):
    """The grid of an output with point data alpha and speed, interpolated from the cells."""
    if not os.path.exists(file):
        raise Failure(f"{file}: no such file")
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(file)
    grid = result_of(reader)
    cells = grid.GetCellData()
    arrays = [cells.GetArray(f"{name}.{phase}") for name in ("alpha", "velocity")]
    if None in arrays:
        names = ", ".join(cells.GetArrayName(i) for i in range(cells.GetNumberOfArrays()))
        raise Failure(f"{file}: no alpha.{phase} and velocity.{phase}; it has: {names or 'no cell data'}")
    alpha, velocity = (vtk_to_numpy(array).astype(float) for array in arrays)

    # An absent phase has no velocity: cells count by how much of the phase they hold.
    points = vtk.vtkCellDataToPointData()
    bare = without_seams(grid)
    for name, values in (("alpha", alpha), ("momentum", alpha[:, None] * velocity)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        bare.GetCellData().AddArray(array)
    points.SetInputData(bare)
    points.Update()
    result = points.GetOutput()
    data = result.GetPointData()
    alpha = vtk_to_numpy(data.GetArray("alpha"))
    momentum = vtk_to_numpy(data.GetArray("momentum"))
    speed = numpy_to_vtk(numpy.linalg.norm(momentum, axis=1) / numpy.maximum(alpha, 1e-6), deep=True)
    speed.SetName("speed")
    data.AddArray(speed)
    data.SetActiveScalars("alpha")
    return result


def mirrored(data, planes):
    for plane in planes:
        mirror = vtk.vtkReflectionFilter()
        mirror.SetInputData(data)
        getattr(mirror, f"SetPlaneTo{plane}")()
        mirror.CopyInputOn()
        data = result_of(mirror)
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    joined = vtk.vtkCleanPolyData()
    joined.SetInputConnection(surface.GetOutputPort())
    return result_of(joined)


def surface_of(grid):
    contour = vtk.vtkContourFilter()
    contour.SetInputData(grid)
    contour.SetValue(0, 0.5)
    contour.ComputeNormalsOff()
    if is_meridian(grid):
        turned = vtk.vtkRotationalExtrusionFilter()
        turned.SetInputConnection(contour.GetOutputPort())
        turned.SetResolution(120)
        body = result_of(turned)
    else:
        body = mirrored(result_of(contour), "XY")
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(body)
    normals.SplittingOff()
    return result_of(normals)


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
    line = vtk.vtkContourFilter()
    line.SetInputData(both)
    line.SetValue(0, 0.5)
    return both, result_of(line)


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


def actor_of(data, colors=None, array=None, color=INK):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    if colors:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(array)
        mapper.SetLookupTable(colors)
    else:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(*color)
    actor.SetMapper(mapper)
    return actor


def wall_of(radius):
    wall = vtk.vtkRegularPolygonSource()
    wall.SetNumberOfSides(120)
    wall.SetRadius(radius)
    wall.SetCenter(0, 0, -2e-3 * radius)
    actor = actor_of(result_of(wall), color=(0.86, 0.86, 0.84))
    actor.GetProperty().SetAmbient(0.3)
    actor.GetProperty().SetDiffuse(0.7)
    return actor


def text(string, size, x, y):
    """Centered at x, in pixels of its renderer."""
    actor = vtk.vtkTextActor()
    actor.SetInput(string)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(*INK)
    style.SetJustificationToCentered()
    actor.SetPosition(x, y)
    return actor


def renderer(window, left, bottom, right, top):
    width, height = COLUMNS * TILE[0], ROWS * TILE[1] + BAR
    result = vtk.vtkRenderer()
    result.SetViewport(left / width, bottom / height, right / width, top / height)
    result.SetBackground(1, 1, 1)
    window.AddRenderer(result)
    return result


def scale_bar(table, title, window, left, right):
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
    strip = renderer(window, left, 0, right, BAR)
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
    columns = history(os.path.join(os.path.dirname(pvd), "history.csv"))

    tiles = []
    for time, file in chosen:
        grid = read(file, phase)
        tiles.append((time, grid, surface_of(grid), meridian_of(grid)))
    speeds = [vtk_to_numpy(s.GetPointData().GetArray("speed")) for _, _, s, _ in tiles if s.GetNumberOfPoints()]
    if not speeds:
        raise Failure(f"{pvd}: no surface alpha.{phase} = 0.5 in any output")
    # A few fast splinters must not take the colours from the body.
    largest = math.ceil(2 * max(numpy.percentile(speed, 99) for speed in speeds)) / 2 or 0.5
    colors, shades = speed_colors(largest), alpha_colors()
    bounds = tiles[0][1].GetBounds()
    room, height = bounds[1], bounds[5]

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(COLUMNS * TILE[0], ROWS * TILE[1] + BAR)
    light = vtk.vtkLightKit()
    light.SetKeyLightIntensity(0.85)
    light.SetKeyLightElevation(60)
    for i, (time, _, surface, (plane, line)) in enumerate(tiles):
        left, bottom = (i % COLUMNS) * TILE[0], BAR + (ROWS - 1 - i // COLUMNS) * TILE[1]
        split = bottom + PLANE_PART * TILE[1]

        view = renderer(window, left, split, left + TILE[0], bottom + TILE[1])
        view.AddActor(wall_of(room))
        body = actor_of(surface, colors, "speed")
        body.GetProperty().SetSpecular(0.15)
        view.AddActor(body)
        camera = view.GetActiveCamera()
        camera.SetFocalPoint(0, 0, 0.22 * height)
        camera.SetPosition(0.3 * room, -3.7 * room, 1.8 * room)
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(24)
        view.ResetCameraClippingRange()
        light.AddLightsToRenderer(view)
        view.AddActor2D(text(caption(time, columns, radius), 20, TILE[0] / 2, TILE[1] * (1 - PLANE_PART) - 34))

        section = renderer(window, left, bottom, left + TILE[0], split)
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
    scale_bar(colors, "speed on the surface alpha = 0.5  [m/s]", window, 0, middle)
    scale_bar(shades, "alpha in the meridian plane", window, middle, 2 * middle)

    folder = os.path.dirname(os.path.abspath(picture))
    if not os.access(folder, os.W_OK):
        raise Failure(f"{picture}: cannot be written")
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode():
        raise Failure(f"{picture}: cannot be written")


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("pvd", help="DIR/droplet.pvd")
    options.add_argument("picture", help="PNG to write")
    options.add_argument("--phase", default="carbopol", help="phase to show (default: carbopol)")
    options.add_argument("--radius", type=float, default=6e-3, help="R0 [m] (default: 6e-3)")
    given = options.parse_args()
    try:
        if not os.environ.get("DISPLAY"):
            raise Failure("no display; run it as xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' render_droplet.py ...")
        draw(given.pvd, given.picture, given.phase, given.radius)
    except Failure as failure:
        sys.exit(f"render_droplet: {failure}")


if __name__ == "__main__":
    main()
