"""Figure 14: projectile and plate at seven times; and how far the plate bends."""
import os

import numpy

from common.fields import field_on_raster
from common.plots import new_figure, plot, save
from common.results import Cells, columns, nearest_output
from gallery.run import Row, Run

TIMES = [40e-6, 70e-6, 110e-6, 200e-6, 300e-6, 490e-6, 700e-6]


class Plate:
    name = "plate"

    def runs(self, quick):
        h = "5e-3" if quick else "1.25e-3"
        coarse = "5e-3" if quick else "2.5e-3"
        runs = [Run("plate", "plate", {"mesh_parameters": f"{{ h = {h} }}"})]
        for element, word in ((4, "quadrilaterals"), (3, "triangles")):
            settings = {"mesh_parameters": f"{{ h = {coarse}, element = {element} }}", "output.every": "100e-6"}
            runs.append(Run(f"plate_{word}", "plate", settings))
        return runs

    def draw(self, results):
        if results.good("plate"):
            self._draw_series(results.directory("plate"), results.picture("plate"))
        curves = {}
        for run, label in (
            ("plate", "quadrilaterals, fine"),
            ("plate_quadrilaterals", "quadrilaterals"),
            ("plate_triangles", "triangles"),
        ):
            if results.good(run):
                history = columns(os.path.join(results.directory(run), "history.csv"))
                curves[label] = (history["time"], history["front_axis"] - history["front_edge"], history)
        self._draw_bending(curves, results.picture("plate_bending"))
        return [row for label, curve in curves.items() for row in rows_of_bending(label, *curve)]

    def _draw_series(self, directory, picture):
        figure, axes = plot.subplots(2, 4, figsize=(11, 7.6))
        for axis, time in zip(axes.flat, TIMES):
            cells = Cells(nearest_output(directory, time)[1])
            density, extent = field_on_raster(cells, "density", 5e-4)
            alpha, _ = field_on_raster(cells, "alpha.copper", 5e-4)
            axis.imshow(schlieren(density, 5e-4), origin="lower", extent=extent, cmap="gray", vmin=0, vmax=1)
            mirrored = (extent[0], extent[1], -extent[3], -extent[2])
            axis.imshow(alpha[::-1], origin="lower", extent=mirrored, cmap="copper_r", vmin=0, vmax=1)
            axis.axhline(0, color="white", linewidth=0.6)
            axis.set_xlim(extent[0], extent[1])
            axis.set_ylim(-extent[3], extent[3])
            axis.set_title(f"{1e6 * time:.0f} µs", fontsize=9)
            axis.tick_params(labelsize=7)
        last = axes.flat[-1]
        last.set_axis_off()
        last.text(0, 0.5, "above: schlieren of the\nmixture density\n\nbelow: volume fraction\nof copper\n\nx, y in m",
                  fontsize=10, va="center", transform=last.transAxes)
        save(figure, picture, dpi=85)

    def _draw_bending(self, curves, picture):
        figure, (axis,) = new_figure(1, 1, 6.5, 3.6)
        for label, (time, bending, _) in curves.items():
            axis.plot(1e6 * time, 1e3 * bending, linewidth=1.2, label=label)
        axis.axhline(0, color="black", linewidth=0.6)
        axis.set_ylabel("bending: axis ahead of the edge [mm]", fontsize=8)
        axis.legend(fontsize=7)
        save(figure, picture, "time [µs]")


def schlieren(density, spacing):
    """1 where density is uniform, dark where its logarithm changes: weak waves in air show as well as those in copper."""
    gradient = numpy.hypot(*numpy.gradient(numpy.log(density), spacing))
    return numpy.exp(-numpy.sqrt(gradient / 4))


def crossings(time, values):
    """Times at which the values change sign."""
    change = numpy.nonzero(numpy.sign(values[1:]) * numpy.sign(values[:-1]) < 0)[0]
    share = values[change] / (values[change] - values[change + 1])
    return time[change] + share * (time[change + 1] - time[change])


def rows_of_bending(label, time, bending, history):
    early = (time >= 100e-6) & (time <= 200e-6)
    largest = numpy.argmax(bending)
    zero = [t for t in crossings(time, bending) if t > time[largest]]
    mass = history["mass.copper"]
    return [
        Row(f"plate, {label}: bending from 100 to 200 µs", f"{1e3 * bending[early].min():.1f} to "
            f"{1e3 * bending[early].max():.1f} mm", "14–22 mm", "—"),
        Row(f"plate, {label}: largest bending; straight again",
            f"{1e3 * bending[largest]:.1f} mm at {1e6 * time[largest]:.0f} µs; " +
            ", ".join(f"{1e6 * t:.0f}" for t in zero) + " µs", "450–550 µs", "490 µs looks straight"),
        Row(f"plate, {label}: mass of copper", f"kept to {numpy.max(numpy.abs(mass / mass[0] - 1)):.0e}", "kept", "kept"),
    ]


FAMILIES = [Plate()]
