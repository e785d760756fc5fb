"""Figures 6, 8, 9, 11, 12: profiles along the tubes of sections 5.1 to 5.4 beside the exact solutions."""
import os

import numpy

from common.exact import contact_in_tube, exact_in_tube
from common.plots import new_figure, save
from common.results import columns
from gallery.run import Row, Run

# Per figure: case, what the README calls it, and panels: label, divisor, {column of the line: label}.
ALUMINIUM_AIR = {"alpha.aluminium": "aluminium", "alpha.air": "air"}
COPPER_ALUMINIUM = {"alpha.copper": "copper", "alpha.aluminium": "aluminium"}
PANELS = {
    "advection": [
        ("normal stress of aluminium [MPa]", 1e6, {"stress.aluminium.xx": "aluminium"}),
        ("pressure of air [bar]", 1e5, {"pressure.air": "air"}),
        ("velocity [m/s]", 1, {"velocity.aluminium.x": "aluminium", "velocity.air.x": "air"}),
        ("volume fraction", 1, ALUMINIUM_AIR),
    ],
    "impact": [
        ("normal stress of the mixture [GPa]", 1e9, {"stress.xx": ""}),
        ("velocity of the mixture [m/s]", 1, {"velocity.x": ""}),
        ("normal stress [GPa]", 1e9, {"stress.copper.xx": "copper", "stress.aluminium.xx": "aluminium"}),
        ("pressure [GPa]", 1e9, {"pressure.copper": "copper", "pressure.aluminium": "aluminium"}),
        ("velocity [m/s]", 1, {"velocity.copper.x": "copper", "velocity.aluminium.x": "aluminium"}),
        ("volume fraction", 1, COPPER_ALUMINIUM),
    ],
    "shear": [
        ("density [kg/m³]", 1, {"density": ""}),
        ("pressure [GPa]", 1e9, {"pressure": ""}),
        ("normal stress [GPa]", 1e9, {"stress.xx": ""}),
        ("tangential stress [GPa]", 1e9, {"stress.xy": ""}),
        ("normal velocity [m/s]", 1, {"velocity.x": ""}),
        ("tangential velocity [m/s]", 1, {"velocity.y": ""}),
    ],
    "sliding": [
        ("volume fraction", 1, COPPER_ALUMINIUM),
        ("tangential velocity [m/s]", 1, {"velocity.y": ""}),
        ("density [kg/m³]", 1, {"density": ""}),
        ("normal velocity [m/s]", 1, {"velocity.x": ""}),
        ("normal stress [GPa]", 1e9, {"stress.xx": ""}),
        ("tangential stress [GPa]", 1e9, {"stress.xy": ""}),
    ],
}
# As wide as the paper's axes where a field is uniform, so that round-off does not fill a panel.
RANGES = {
    "normal stress of aluminium [MPa]": (-0.21, 0.01),
    "pressure of air [bar]": (0.989, 1.011),
    "advection velocity [m/s]": (395.5, 404.5),
    "sliding normal velocity [m/s]": (178, 222),
    "sliding normal stress [GPa]": (-0.011, 0.011),
    "sliding tangential stress [GPa]": (-0.011, 0.011),
}
COLOURS = ("tab:blue", "tab:red")


class Tube:
    def __init__(self, case):
        self.case = case
        self.name = case

    def runs(self, quick):
        n = 500 if quick else 2000
        line = {"line.0.points": n, "line.0.from": f"[{0.5 / n}, 0.0001]", "line.0.to": f"[{1 - 0.5 / n}, 0.0001]"}
        return [Run(self.case, self.case, {"mesh_parameters": f"{{ n = {n} }}"} | line)]

    def draw(self, results):
        if not results.good(self.case):
            return []
        line = columns(os.path.join(results.directory(self.case), "axis.csv"))
        exact = exact_in_tube(self.case)
        self._draw(line, exact, results.picture(self.case))
        rows = ROWS[self.case](line, exact(line["x"]))
        rows[0].quantity = f"{self.case}, {len(line['x'])} cells: {rows[0].quantity}"
        return rows

    def _exact_of(self, column, x, exact):
        """Of a column of a phase or of the mixture; NaN where the phase is not."""
        parts = column.split(".")
        phases = [name for name in ("copper", "aluminium", "air") if name in parts]
        if not phases:
            return exact(x)[column]
        inside = numpy.ones(len(x), bool)
        if self.case in ("advection", "impact", "sliding"):
            first = {"advection": "aluminium"}.get(self.case, "copper")
            inside = (x < contact_in_tube(self.case)) == (phases[0] == first)
        if parts[0] == "alpha":
            return inside.astype(float)
        values = exact(x)[".".join(part for part in parts if part != phases[0])]
        return numpy.where(inside, values, numpy.nan)

    def _draw(self, line, exact, picture):
        fine = numpy.linspace(0, 1, 20001)
        panels = PANELS[self.case]
        figure, axes = new_figure(len(panels))
        for axis, (label, unit, shown) in zip(axes, panels):
            for colour, (column, legend) in zip(COLOURS, shown.items()):
                phase = legend or None
                there = line[f"alpha.{phase}"] > 1e-2 if phase and not column.startswith("alpha") else slice(None)
                axis.plot(fine, self._exact_of(column, fine, exact) / unit, color="black", linewidth=0.9)
                x, values = line["x"][there], line[column][there] / unit
                axis.plot(x, values, ".", color=colour, markersize=2.6, label=legend or None)
            axis.set_ylabel(label, fontsize=8)
            limits = RANGES.get(label) or RANGES.get(f"{self.case} {label}")
            if limits:
                axis.set_ylim(limits)
            if len(shown) > 1:
                axis.legend(fontsize=7, markerscale=4, loc="best")
        save(figure, picture, "x [m]; dots: computed, lines: exact")


def _range(values, exact):
    return f"within {numpy.max(numpy.abs(values - exact)):.1e}"


def _mean_error(line, exact, column):
    spread = numpy.mean(numpy.abs(exact[column] - numpy.mean(exact[column])))
    return 100 * numpy.mean(numpy.abs(line[column] - exact[column])) / spread


def rows_of_advection(line, exact):
    solid, gas = line["alpha.aluminium"] > 1e-2, line["alpha.air"] > 1e-2
    front = numpy.sum(line["alpha.aluminium"]) / len(line["x"])
    return [
        Row("normal stress of aluminium [Pa]", _range(line["stress.aluminium.xx"][solid], -1e5), "−1e5", "uniform"),
        Row("pressure of air [Pa]", _range(line["pressure.air"][gas], 1e5), "1e5", "uniform"),
        Row("velocity of both [m/s]", _range(line["velocity.x"], 400), "400", "uniform"),
        Row("front [m]", f"{front:.6f}", "0.7", "—"),
    ]


def rows_of_impact(line, exact):
    plateau = (line["x"] > 0.3) & (line["x"] < 0.75)
    stress, speed = line["stress.xx"][plateau], line["velocity.x"][plateau]
    return [
        Row("normal stress between the shocks [GPa]", f"{numpy.mean(stress) / 1e9:.5f}", "−8.09201", "continuous"),
        Row("velocity there [m/s]", f"{numpy.mean(speed):.4f}", "239.5549", "continuous"),
        Row("mean error of stress, velocity", _errors(line, exact, "stress.xx", "velocity.x"), "0", "—"),
    ]


def _errors(line, exact, *names):
    return ", ".join(f"{_mean_error(line, exact, name):.2g} %" for name in names)


def rows_of_shear(line, exact):
    middle = (line["x"] > 0.4) & (line["x"] < 0.45)
    stress, density = numpy.mean(line["stress.xy"][middle]), numpy.mean(line["density"][middle])
    return [
        Row("tangential stress in the middle [GPa]", f"{stress / 1e9:.5f}", "−4.20390", "—"),
        Row("density there [kg/m³]", f"{density:.3f}", "2690.624", "—"),
        Row("mean error of tangential velocity, pressure, tangential stress",
            _errors(line, exact, "velocity.y", "pressure", "stress.xy"), "0", "—"),
    ]


def rows_of_sliding(line, exact):
    slip = line["velocity.y"][0] - line["velocity.y"][-1]
    return [
        Row("jump of the tangential velocity [m/s]", f"{slip:.6f}", "100", "kept"),
        Row("normal stress [Pa]", _range(line["stress.xx"], -1e5), "−1e5", "no oscillations"),
        Row("tangential stress [Pa]", _range(line["stress.xy"], 0), "0", "no oscillations"),
    ]


ROWS = {"advection": rows_of_advection, "impact": rows_of_impact, "shear": rows_of_shear, "sliding": rows_of_sliding}
FAMILIES = [Tube(case) for case in PANELS]
