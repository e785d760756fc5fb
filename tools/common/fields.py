"""Fields of plane meshes as pictures."""
import numpy

from common.results import Failure


def field_on_raster(cells, name, spacing):
    """(values, extent): a field of the cells, interpolated, at the middles of squares over the whole mesh."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    bare = vtk.vtkUnstructuredGrid()
    bare.CopyStructure(cells.grid)
    array = numpy_to_vtk(numpy.ascontiguousarray(cells[name], dtype=float), deep=True)
    array.SetName("field")
    bare.GetCellData().AddArray(array)
    points = vtk.vtkCellDataToPointData()
    points.SetInputData(bare)
    bounds = bare.GetBounds()
    counts = [max(1, round((bounds[2 * i + 1] - bounds[2 * i]) / spacing)) for i in (0, 1)]
    steps = [(bounds[2 * i + 1] - bounds[2 * i]) / counts[i] for i in (0, 1)]
    raster = vtk.vtkImageData()
    raster.SetOrigin(bounds[0] + steps[0] / 2, bounds[2] + steps[1] / 2, 0)
    raster.SetSpacing(steps[0], steps[1], 1)
    raster.SetDimensions(counts[0], counts[1], 1)
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(raster)
    probe.SetSourceConnection(points.GetOutputPort())
    probe.Update()
    found = probe.GetOutput().GetPointData().GetArray("field")
    if not vtk_to_numpy(probe.GetOutput().GetPointData().GetArray(probe.GetValidPointMaskArrayName())).all():
        raise Failure(f"{cells.file}: is not a rectangle")
    return vtk_to_numpy(found).reshape(counts[1], counts[0]), tuple(bounds[:4])
