"""What a run leaves on disk, as arrays."""
import csv
import os
import xml.etree.ElementTree

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REFERENCE = os.path.join(ROOT, "tests/verification/reference")


class Failure(Exception):
    """What the user can mend."""


def columns(file):
    """{column: values} of a table of numbers."""
    try:
        with open(file, newline="") as lines:
            rows = list(csv.reader(lines))
    except OSError as error:
        raise Failure(error) from None
    if len(rows) < 2:
        raise Failure(f"{file}: holds no numbers")
    try:
        values = numpy.array([[float(value) for value in row] for row in rows[1:]])
    except ValueError as error:
        raise Failure(f"{file}: {error}") from None
    return dict(zip(rows[0], values.T))


def tables(folder):
    """{name: bytes} of all that is not fields."""
    return {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*"))
            if f.suffix in (".csv", ".series", ".pvd")}  # fmt: skip


def outputs(pvd):
    """[(time, file)] of a .pvd."""
    try:
        root = xml.etree.ElementTree.parse(pvd).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        raise Failure(f"{pvd}: {error}") from None
    folder = os.path.dirname(pvd)
    found = [(float(d.get("timestep")), os.path.join(folder, d.get("file"))) for d in root.iter("DataSet")]
    if not found:
        raise Failure(f"{pvd}: lists no output")
    return found


def pvd_in(directory):
    pvd = [name for name in os.listdir(directory) if name.endswith(".pvd")]
    if len(pvd) != 1:
        raise Failure(f"{directory}: holds {len(pvd)} .pvd files")
    return os.path.join(directory, pvd[0])


def nearest_output(directory, time):
    """(time, file) of the output at that time; a tenth of the distance of outputs may lie between."""
    available = outputs(pvd_in(directory))
    found = min(available, key=lambda output: abs(output[0] - time))
    if abs(found[0] - time) > 0.1 * available[-1][0] / max(1, len(available) - 1):
        raise Failure(f"{directory}: no output at {time:g} s; there are: {', '.join(f'{t:g}' for t, _ in available)}")
    return found


def grid_of(file):
    """The vtkUnstructuredGrid of an output."""
    import vtk

    if not os.path.exists(file):
        raise Failure(f"{file}: no such file")
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


class Cells:
    """Centres and sizes of the cells of an output, and their fields: {name or name.component: values}."""

    COMPONENTS = {
        3: ("x", "y", "z"),
        6: ("xx", "yy", "zz", "xy", "yz", "xz"),
        9: tuple(f"e{beta}.{axis}" for beta in (1, 2, 3) for axis in "xyz"),
    }

    def __init__(self, file):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy

        self.file = file
        self.grid = grid_of(file)
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputData(self.grid)
        centres = vtk.vtkCellCenters()
        centres.SetInputConnection(sizes.GetOutputPort())
        centres.Update()
        data = sizes.GetOutput().GetCellData()
        self.fields = {}
        for i in range(data.GetNumberOfArrays()):
            values, name = vtk_to_numpy(data.GetArray(i)), data.GetArrayName(i)
            if values.ndim == 1:
                self.fields[name] = values
            else:
                names = self.COMPONENTS[values.shape[1]]
                self.fields |= {f"{name}.{component}": values[:, c] for c, component in enumerate(names)}
        self.centres = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())
        self.volume = self.fields["Volume"] + self.fields["Area"]  # of a cell one of them vanishes

    def __getitem__(self, name):
        if name not in self.fields:
            raise Failure(f"{self.file}: no field {name}; it has: {', '.join(self.fields)}")
        return self.fields[name]

    def corners(self):
        """Of the cells of a plane mesh: (cells, 4, 2); a triangle's last corner is there twice."""
        from vtk.util.numpy_support import vtk_to_numpy

        points = vtk_to_numpy(self.grid.GetPoints().GetData())[:, :2].astype(float)
        begin = vtk_to_numpy(self.grid.GetCells().GetOffsetsArray())
        nodes = vtk_to_numpy(self.grid.GetCells().GetConnectivityArray())
        count = numpy.diff(begin)
        return points[nodes[begin[:-1, None] + numpy.minimum(numpy.arange(4), count[:, None] - 1)]]


def last_cells(directory):
    return Cells(outputs(pvd_in(directory))[-1][1])
