"""Text of small cases on meshes of each element."""
import os

from common.results import ROOT

ALUMINIUM = 'material = "aluminium"'
COPPER = 'material = "copper"'
AIR = 'material = "air"'
WATER = 'material = "water"'
FASTEST = 6400.0  # waves in aluminium and copper at rest [m/s]


def gas(gamma=1.4):
    return f'eos = {{ type = "ideal_gas", gamma = {gamma} }}'


def liquid(p_inf):
    return f'eos = {{ type = "stiffened_gas", gamma = 4.4, p_inf = {p_inf!r} }}'


class Grid:
    """A strip or bar of unit length along x and a unit square (in space: one cell thick), of one type of cells."""

    def __init__(self, element):
        self.element = element
        self.space = element in ("tetrahedra", "hexahedra")
        self.n, self.across = {"quadrilaterals": (48, 4), "triangles": (40, 4)}.get(element, (24, 2))
        self.type = {"triangles": 3, "hexahedra": 8}.get(element, 4)

    def vector(self, x, y=0.0):
        return f"[{x!r}, {y!r}, 0.0]" if self.space else f"[{x!r}, {y!r}]"

    def strip(self, aspect=1.0):
        """Cells are `aspect` times as long as high."""
        file = "tube_space" if self.space else "tube"
        size = "width" if self.space else "height"
        height = "" if aspect == 1 else f", {size} = {self.across / self.n / aspect!r}"
        numbers = f"n = {self.n}, ny = {self.across}, element = {self.type}{height}"
        return self._mesh(file, numbers)

    def square(self, n):
        if self.space:
            return self._mesh("box_space", f"n = {n}, width = {1 / n!r}, element = {self.type}")
        return self._mesh("box", f"n = {n}, element = {self.type}")

    @staticmethod
    def _mesh(file, numbers):
        path = os.path.join(ROOT, "meshes", file + ".geo")
        return f'mesh = "{path}"\nmesh_parameters = {{ {numbers} }}'

    def disc(self, x, y, radius):
        if self.space:
            return f'shape = "cylinder"\nfrom = [{x}, {y}, -1.0]\nto = [{x}, {y}, 2.0]\nradius = {radius}'
        return f'shape = "sphere"\ncenter = [{x}, {y}]\nradius = {radius}'

    def half(self, slope=0.2, x=0.507):
        """The left half; its end is no face, and oblique to faces."""
        return f'shape = "half_space"\npoint = {self.vector(x)}\nnormal = {self.vector(-1.0, -slope)}'

    def box(self, low, high):
        if self.space:
            return f'shape = "box"\nlow = [{low[0]}, {low[1]}, -1.0]\nhigh = [{high[0]}, {high[1]}, 2.0]'
        return f'shape = "box"\nlow = [{low[0]}, {low[1]}]\nhigh = [{high[0]}, {high[1]}]'


EVERYWHERE = 'shape = "everywhere"'
CLOSED = '"*" = "wall"'
OPEN = 'left = "transmissive"\nright = "transmissive"\n"*" = "symmetry"'
MOST_STEPS = 50000


def filled(shape, phase, velocity, pressure=1e5, density=None, more=""):
    lines = [shape, f'fill = "{phase}"', f"pressure = {pressure!r}", f"velocity = {velocity}"]
    if density is not None:
        lines.append(f"density = {density!r}")
    return "\n".join(lines + ([more] if more else []))


def case(mesh, order, end_time, phases, regions, boundary=CLOSED, cfl=0.8):
    """phases: {name: text}; regions: texts."""
    parts = [f"schema = 1\n{mesh}\nend_time = {end_time!r}\ncfl = {cfl!r}\nmax_steps = {MOST_STEPS}"]
    parts.append(f"[scheme]\norder = {order}")
    parts += [f"[phase.{name}]\n{text}" for name, text in phases.items()]
    parts += [f"[[region]]\n{text}" for text in regions]
    parts.append(f"[boundary]\n{boundary}")
    parts.append('[output]\ncount = 1\nfields = ["alpha", "density", "cobasis"]')
    return "\n\n".join(parts) + "\n"
