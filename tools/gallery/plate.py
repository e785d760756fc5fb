"""Figure 14: projectile and plate at seven times; and how far the plate bends."""
import os

import numpy
from matplotlib.colors import LinearSegmentedColormap

from common.fields import field_on_raster
from common.plots import new_figure, plot, save
from common.results import Cells, columns, nearest_output
from gallery.run import Row, Run

COPPER = LinearSegmentedColormap.from_list("copper in air", [(0.93, 0.96, 1.0), (0.72, 0.38, 0.2)])
TIMES = [40e-6, 70e-6, 110e-6, 200e-6, 300e-6, 490e-6, 700e-6]
# Name of a run: label, size of cells [mm], corners of a cell, further keys.
FIRST = {"scheme.order": "1"}
FULL = {
    "plate": ("quadrilaterals", 2, 4, {}),
    "plate_coarse": ("quadrilaterals", 5, 4, {}),
    "plate_coarse_triangles": ("triangles", 5, 3, {}),
    "plate_first": ("first order, quadrilaterals", 2.5, 4, FIRST),
    "plate_first_triangles": ("first order, triangles", 2.5, 3, FIRST),
}
QUICK = {
    "plate": ("quadrilaterals", 5, 4, {}),
    "plate_first": ("first order, quadrilaterals", 5, 4, FIRST),
    "plate_first_triangles": ("first order, triangles", 5, 3, FIRST),
}


class Plate:
    name = "plate"

    def __init__(self):
        self.chosen = {}

    def runs(self, quick):
        self.chosen = QUICK if quick else FULL
        for name, (_, h, element, keys) in self.chosen.items():
            settings = {"mesh_parameters": f"{{ h = {h}e-3, element = {element} }}"} | keys
            yield Run(name, "plate", settings | ({} if name == "plate" else {"output.every": "100e-6"}))

    def draw(self, results):
        if results.good("plate"):
            self._draw_series(results.directory("plate"), results.picture("plate"))
        curves = {}
        for name, (label, h, _, _) in self.chosen.items():
            if results.good(name):
                history = columns(os.path.join(results.directory(name), "history.csv"))
                bending = history["front_axis"] - history["front_edge"]
                curves[f"{label}, {h:g} mm"] = (history["time"], bending, history["mass.copper"])
        if curves:
            self._draw_bending(curves, results.picture("plate_bending"))
        return [row for label, curve in curves.items() for row in rows_of_bending(label, *curve)]

    def _draw_series(self, directory, picture):
        figure, axes = plot.subplots(2, 4, figsize=(11, 6.4))
        for axis, time in zip(axes.flat, TIMES):
            cells = Cells(nearest_output(directory, time)[1])
            density, extent = field_on_raster(cells, "density", 5e-4)
            alpha, _ = field_on_raster(cells, "alpha.copper", 5e-4)
            axis.imshow(schlieren(density, 5e-4), origin="lower", extent=extent, cmap="gray", vmin=0, vmax=1)
            mirrored = (extent[0], extent[1], -extent[3], -extent[2])
            axis.imshow(alpha[::-1], origin="lower", extent=mirrored, cmap=COPPER, vmin=0, vmax=1)
            axis.axhline(0, color="white", linewidth=0.6)
            axis.set_xlim(extent[0], extent[1])
            axis.set_ylim(-extent[3], extent[3])
            axis.set_title(f"{1e6 * time:.0f} µs", fontsize=9)
            axis.tick_params(labelsize=7)
        last = axes.flat[-1]
        last.set_axis_off()
        last.text(0, 0.5, "above: schlieren of the\nmixture density\n\nbelow: volume fraction\nof copper\n\nx, y in m",
                  fontsize=10, va="center", transform=last.transAxes)
        save(figure, picture, dpi=100)

    def _draw_bending(self, curves, picture):
        figure, (axis,) = new_figure(1, 1, 6.5, 3.6)
        for label, (time, bending, _) in curves.items():
            axis.plot(1e6 * time, 1e3 * bending, linewidth=1.2, label=label)
        axis.axhline(0, color="black", linewidth=0.6)
        axis.set_ylabel("bending: axis ahead of the edge [mm]", fontsize=8)
        axis.legend(fontsize=7)
        save(figure, picture, "time [µs]")


def schlieren(density, spacing):
    """1 where density is uniform, dark where its logarithm changes: waves in air show as well as those in copper."""
    gradient = numpy.hypot(*numpy.gradient(numpy.log(density), spacing))
    return numpy.exp(-numpy.sqrt(gradient / 10))


def crossings(time, values):
    """Times at which the values change sign."""
    change = numpy.nonzero(numpy.sign(values[1:]) * numpy.sign(values[:-1]) < 0)[0]
    share = values[change] / (values[change] - values[change + 1])
    return time[change] + share * (time[change + 1] - time[change])


def rows_of_bending(label, time, bending, mass):
    early = (time >= 100e-6) & (time <= 200e-6)
    first, last = 1e3 * bending[early].min(), 1e3 * bending[early].max()
    largest = numpy.argmax(numpy.where(time < 300e-6, bending, -1))
    straight = [1e6 * t for t in crossings(time, bending) if t > time[largest]]
    least = numpy.argmin(numpy.where(time > time[largest], bending, 1))
    swing = f"{1e3 * bending[largest]:.1f} mm at {1e6 * time[largest]:.0f} µs, "
    swing += f"{1e3 * bending[least]:.1f} mm at {1e6 * time[least]:.0f} µs"
    times = ", ".join(f"{t:.0f}" for t in straight)
    swing += f"; straight at {times} µs" if straight else ""
    return [
        Row(f"plate, {label}: bending from 100 to 200 µs", f"{first:.1f} to {last:.1f} mm", "14 to 22 mm", "—"),
        Row("its largest and least", swing, "first order: 0 at 450 to 550 µs", "—"),
        Row("mass of copper", f"kept to {numpy.max(numpy.abs(mass / mass[0] - 1)):.0e}", "kept to 1e-12", "kept"),
    ]


FAMILIES = [Plate()]
