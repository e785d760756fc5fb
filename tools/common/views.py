"""Pictures of bodies in space, by VTK."""
import os

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from common.results import Failure, grid_of

INK = (0.15, 0.15, 0.15)


def need_display(tool):
    if not os.environ.get("DISPLAY"):
        raise Failure(f"no display; run it as xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' {tool} ...")


def result_of(algorithm):
    """Its output as data: a port alone does not keep its filter alive."""
    algorithm.Update()
    return algorithm.GetOutput()


def is_meridian(grid):
    """Whether it is a part of the plane y = 0 alone, see without_seams."""
    bounds = grid.GetBounds()
    return bounds[2] == bounds[3]


def without_seams(grid):
    """The grid with one point where the pieces of several ranks have one each; no data. Half of a meridian plane comes
    to stand where that of a body in space does."""
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


def read_body(file, phase):
    """The grid of an output with point data alpha and speed, interpolated from the cells."""
    grid = grid_of(file)
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


def contour_of(data):
    """Where alpha is 0.5."""
    contour = vtk.vtkContourFilter()
    contour.SetInputData(data)
    contour.SetValue(0, 0.5)
    contour.ComputeNormalsOff()
    return result_of(contour)


def section_of(plane):
    """The part of a plane where alpha is above 0.5."""
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(plane)
    clip = vtk.vtkClipPolyData()
    clip.SetInputConnection(surface.GetOutputPort())
    clip.SetValue(0.5)
    return result_of(clip)


def with_normals(surface):
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    return result_of(normals)


def turned(line, angle=360):
    """The surface that a line of the meridian plane y = 0, x >= 0 leaves when it turns around z by so many degrees."""
    extrusion = vtk.vtkRotationalExtrusionFilter()
    extrusion.SetInputData(line)
    extrusion.SetResolution(max(1, round(angle / 3)))
    extrusion.SetAngle(angle)
    return result_of(extrusion)


def surface_of(grid):
    contour = contour_of(grid)
    return with_normals(turned(contour) if is_meridian(grid) else mirrored(contour, "XY"))


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


class Sheet:
    """A window of so many pixels, parts of which are renderers."""

    def __init__(self, width, height):
        self.size = (width, height)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(8)
        self.window.SetSize(width, height)
        self.light = vtk.vtkLightKit()
        self.light.SetKeyLightIntensity(0.85)
        self.light.SetKeyLightElevation(60)

    def renderer(self, left, bottom, right, top):
        width, height = self.size
        result = vtk.vtkRenderer()
        result.SetViewport(left / width, bottom / height, right / width, top / height)
        result.SetBackground(1, 1, 1)
        self.window.AddRenderer(result)
        return result

    def write(self, picture):
        if not os.access(os.path.dirname(os.path.abspath(picture)), os.W_OK):
            raise Failure(f"{picture}: cannot be written")
        self.window.Render()
        image = vtk.vtkWindowToImageFilter()
        image.SetInput(self.window)
        image.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(picture)
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()
        if writer.GetErrorCode():
            raise Failure(f"{picture}: cannot be written")


def view_of_body(view, room, height):
    """The camera above a body that stands on the wall."""
    camera = view.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0.22 * height)
    camera.SetPosition(0.3 * room, -3.7 * room, 1.8 * room)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(24)
    view.ResetCameraClippingRange()
