"""Figures 19 and 20: the spinning disc, and the circulation of the cobasis round closed contours."""
import math

import numpy

from common.contour import circulation
from common.fields import field_on_raster
from common.plots import new_figure, plot, save
from common.results import last_cells, nearest_output, Cells
from gallery.run import Row, Run

TIMES = [5e-6, 10e-6]
RHO0 = 2700.0
CENTRE = numpy.array([1.0, 1.0])
SIZES = {"quadrilaterals": [100, 200, 300, 400, 600, 800], "triangles": [100, 200, 400]}
QUICK_SIZES = {"quadrilaterals": [50, 100, 200], "triangles": [50, 100]}
CONTOURS = 60


def quadrant():
    """The paper's contour: a square of 1 m with a corner in the disc's centre; the cells inside count, as its sides run
    along faces of quadrilaterals."""
    inside = 1e-6
    return CENTRE + numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * (1 - 2 * inside) + inside


def contours():
    """Squares of many sizes, places and angles that lie in the block, most of them across the rim of the disc."""
    numbers = numpy.random.default_rng(1)
    squares = []
    while len(squares) < CONTOURS:
        middle, side = numbers.uniform(-0.6, 0.6, 2), numbers.uniform(0.3, 0.9)
        turn = numbers.uniform(0, math.pi / 2) + math.pi / 2 * numpy.arange(4)
        corners = middle + side / math.sqrt(2) * numpy.stack([numpy.cos(turn), numpy.sin(turn)], axis=1)
        if numpy.all(numpy.abs(corners) < 0.95):
            squares.append(CENTRE + corners)
    return squares


def name_of(word, n):
    return f"disc_{word}_{n}"


class Disc:
    name = "disc"

    def __init__(self):
        self.sizes = {}

    def runs(self, quick):
        self.sizes = QUICK_SIZES if quick else SIZES
        return [
            Run(name_of(word, n), "disc", {"mesh_parameters": f"{{ n = {n}, length = 2, height = 2, element = {e} }}"})
            for word, e in (("quadrilaterals", 4), ("triangles", 3))
            for n in self.sizes[word]
        ]

    def draw(self, results):
        measured = {}
        for word, sizes in self.sizes.items():
            good = [n for n in sizes if results.good(name_of(word, n))]
            measured[word] = [(n, *measure(last_cells(results.directory(name_of(word, n))))) for n in good]
            if good and word == "quadrilaterals":
                self._draw_fields(results.directory(name_of(word, good[-1])), results.picture("disc"))
        self._draw_circulation(measured, results.picture("disc_circulation"))
        return [row for word, points in measured.items() if len(points) > 1 for row in rows_of(word, points)]

    def _draw_fields(self, directory, picture):
        figure, axes = plot.subplots(2, 2, figsize=(8.2, 7.2))
        for column, time in enumerate(TIMES):
            cells = Cells(nearest_output(directory, time)[1])
            for row, (name, unit, label) in enumerate(
                (("density", 1, "density [kg/m³]"), ("pressure", 1e9, "pressure [GPa]"))
            ):
                values, extent = field_on_raster(cells, name, 2.5e-3)
                axis = axes[row, column]
                image = axis.imshow(values / unit, origin="lower", extent=(-1, 1, -1, 1), cmap="viridis")
                axis.set_title(f"{label}, {1e6 * time:.0f} µs", fontsize=9)
                axis.set_xlim(-0.7, 0.7)
                axis.set_ylim(-0.7, 0.7)
                axis.tick_params(labelsize=7)
                figure.colorbar(image, ax=axis, shrink=0.85).ax.tick_params(labelsize=7)
        save(figure, picture, "x, y from the centre [m]")

    def _draw_circulation(self, measured, picture):
        figure, (single, mean) = new_figure(2)
        for axis, which in ((single, 1), (mean, 2)):
            for (word, points), marker in zip(measured.items(), "s^"):
                if points:
                    axis.plot([math.log(2 / p[0]) for p in points], [math.log(p[which]) for p in points],
                              marker + "-", markersize=4, linewidth=1, label=word)
            points = measured["quadrilaterals"]
            if points:
                x = numpy.array([math.log(2 / p[0]) for p in points])
                axis.plot(x, math.log(points[0][which]) + x - x[0], color="black", linewidth=0.8, label="slope 1")
            axis.set_xlabel("ln(Δx / L)", fontsize=8)
            axis.legend(fontsize=7)
        single.set_ylabel("ln |Γ / L|, the quadrant", fontsize=8)
        mean.set_ylabel(f"ln of the mean of {CONTOURS} squares", fontsize=8)
        save(figure, picture)


def measure(cells):
    """(|circulation| of e^1 round the quadrant, its mean round many squares, mean and largest drift of density), per
    metre of side."""
    vector = numpy.stack([cells["cobasis.aluminium.e1.x"], cells["cobasis.aluminium.e1.y"]], axis=1)
    corners = cells.corners()
    squares = contours()
    around = [abs(circulation(corners, vector, s)) / numpy.linalg.norm(s[1] - s[0]) for s in squares]
    e = {(beta, axis): cells[f"cobasis.aluminium.e{beta}.{axis}"] for beta in (1, 2, 3) for axis in "xyz"}
    volume = (e[1, "x"] * e[2, "y"] - e[1, "y"] * e[2, "x"]) * e[3, "z"]
    drift = numpy.abs(cells["density"] / (RHO0 * volume) - 1)
    return (abs(circulation(corners, vector, quadrant())), numpy.mean(around),
            numpy.average(drift, weights=cells.volume), numpy.max(drift))


def slope(points, which):
    x, y = (numpy.log([p[i] for p in points]) for i in (0, which))
    return -numpy.polyfit(x, y, 1)[0]


def rows_of(word, points):
    sizes = ", ".join(str(p[0]) for p in points)
    last = points[-1]

    def list_of(which):
        return ", ".join(f"{p[which]:.2g}" for p in points)

    paper = "1" if word == "quadrilaterals" else "—"
    quadrant_slope = f"{slope(points, 1):.2f}"
    return [
        Row(f"disc, {word}, n = {sizes}: slope of the circulation round the quadrant", quadrant_slope, "≥ 1", paper),
        Row(f"mean of {CONTOURS} squares: values; slope", f"{list_of(2)}; {slope(points, 2):.2f}", "0", "—"),
        Row(f"distance of ρ/(ρ0 det e) from 1, n = {last[0]}: mean; largest", f"{last[3]:.1e}; {last[4]:.1e}", "0", "—"),
    ]


FAMILIES = [Disc()]
