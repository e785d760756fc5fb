"""Free bodies that swing or turn for long: a breathing tube, a vibrating plate, a turning disc."""
import math
import os

import numpy

from common.plots import new_figure, save
from common.results import REFERENCE, Cells, columns, outputs, pvd_in
from gallery.run import Row, Run

WORDS = {4: "quadrilaterals", 3: "triangles"}
COLOURS = ("tab:orange", "tab:green", "tab:blue")


def ends_of_swings(time, value, least):
    """When the value changes its sign, not counting changes within `least` after one."""
    at = numpy.nonzero(value[:-1] * value[1:] < 0)[0]
    found = []
    for t in time[at] - value[at] * (time[at + 1] - time[at]) / (value[at + 1] - value[at]):
        if not found or t > found[-1] + least:
            found.append(t)
    return numpy.array(found)


def measure_swings(time, value, kinetic, least):
    """(periods, loss): the time between every second two ends of swings; the mean part of the amplitude that is lost in
    one. The kinetic energy is largest between two ends and goes with the square of the amplitude, so from swing to
    swing, half a period, it falls as much as the amplitude in a period."""
    ends = ends_of_swings(time, value, least)
    peaks = [kinetic[(time > a) & (time < b)].max() for a, b in zip(ends[:-1], ends[1:])]
    loss = 1 - (peaks[-1] / peaks[0]) ** (1 / (len(peaks) - 1)) if len(peaks) > 1 else math.nan
    return ends[2:] - ends[:-2], loss


def spread_of(periods, unit, digits):
    mean, least, most = (f"{f(periods) / unit:.{digits}f}" for f in (numpy.mean, min, max))
    return f"{mean} ({least} to {most})"


class Tube:
    """Energy over time, period and loss per period for three speeds on a sequence of meshes, in the tube's cross section
    and in its meridian plane."""

    name = "tube"
    EXACT = {0.05: 4.2707, 0.5: 4.2269, 1: 4.0991}
    # Case: what it is called; the component of the momentum that is zero at ends of swings.
    PLANES = {"breathing_tube": ("", "x"), "breathing_tube_axisymmetric": (", axisymmetric", "y")}

    def __init__(self):
        self.sizes = {}

    def runs(self, quick):
        few, many = [0.2, 0.1], [0.2, 0.1, 0.05]
        self.sizes = {
            "breathing_tube": {4: few, 3: [0.2]} if quick else {4: many, 3: few},
            "breathing_tube_axisymmetric": {4: few, 3: few} if quick else {4: many, 3: many},
        }
        for case in self.PLANES:
            for speed in self.EXACT:
                for element, sizes in self.sizes[case].items():
                    for h in sizes:
                        yield Run(f"{case}_{element}_{speed}_{h}", case, self.settings(case, speed, element, h))

    def settings(self, case, speed, element, h):
        components, mesh = [f"{speed}*{axis}/(x^2+y^2)" for axis in "xy"], f"h = {h}"
        if case == "breathing_tube_axisymmetric":
            components, mesh = ["0", f"{speed}/y"], f"length = {4 * h}, height = 2.5, n = 4"
        velocity = ", ".join(f'"{component}"' for component in components)
        return {"mesh_parameters": f"{{ {mesh}, element = {element} }}", "region.1.velocity": f"[{velocity}]",
                "output.count": 1}

    def draw(self, results):
        rows = []
        figure, axes = new_figure(2 * len(self.EXACT), 3, 3.4, 2.4)
        panels = [(case, speed) for case in self.PLANES for speed in self.EXACT]
        for axis, (case, speed) in zip(axes, panels):
            words, component = self.PLANES[case]
            for element, sizes in self.sizes[case].items():
                measured = []
                for h, colour in zip(sizes, COLOURS):
                    run = f"{case}_{element}_{speed}_{h}"
                    if not results.good(run):
                        continue
                    history = columns(os.path.join(results.directory(run), "history.csv"))
                    time, kinetic = history["time"], history["kinetic.rubber"]
                    measured.append((h, *measure_swings(time, history[f"momentum.rubber.{component}"], kinetic, 1)))
                    axis.plot(time, kinetic / kinetic[0], "-" if element == 4 else ":", color=colour, linewidth=1,
                              label=f"{WORDS[element]}, {h:g} m")
                name = f"tube{words}, {speed:g} m/s, {WORDS[element]} of {', '.join(f'{m[0]:g}' for m in measured)} m"
                rows += [
                    Row(f"{name}: period [s], mean (least to largest)",
                        ", ".join(spread_of(m[1], 1, 3) for m in measured), f"{self.EXACT[speed]}", "—"),
                    Row("amplitude lost per period [%]", ", ".join(f"{100 * m[2]:.2g}" for m in measured), "0", "—"),
                ]
            axis.set_title(f"{speed:g} m/s at 1 m{words}", fontsize=8)
            axis.set_ylim(-0.05, 1.1)
        for axis in (axes[0], axes[3]):
            axis.set_ylabel("kinetic energy over the first", fontsize=8)
        axes[0].legend(fontsize=5)
        save(figure, results.picture("tube"), "time [s]")
        return rows


class Vibration:
    """The plate's velocity and energy over time beside a Lagrangian computation."""

    name = "vibration"
    THIN = 26.627e-6

    def __init__(self):
        self.sizes = {}

    def runs(self, quick):
        self.sizes = {4: [34, 68], 3: [34]} if quick else {4: [34, 68, 136], 3: [34, 68]}
        for element, sizes in self.sizes.items():
            for n in sizes:
                yield Run(f"vibration_{element}_{n}", "vibrating_plate",
                          {"mesh_parameters": f"{{ length = 0.068, height = 0.026, n = {n}, element = {element} }}",
                           "output.count": 1})

    def draw(self, results):
        reference = columns(os.path.join(REFERENCE, "vibrating_plate.csv"))
        periods, lost = measure_swings(reference["time"], reference["middle"], reference["kinetic"], 5e-6)
        rows = [Row("plate, Lagrangian: period [us], mean (least to largest); amplitude lost per period [%]",
                    f"{spread_of(periods, 1e-6, 2)}; {100 * lost:.1f}",
                    "thin beam 26.627, plane elasticity 28.917", "—")]
        figure, axes = new_figure(4, 2, 4.2, 2.4)
        for column, (element, sizes) in enumerate(self.sizes.items()):
            measured = []
            above, below = axes[column], axes[2 + column]
            for n, colour in zip(sizes, COLOURS):
                if not results.good(f"vibration_{element}_{n}"):
                    continue
                history = columns(os.path.join(results.directory(f"vibration_{element}_{n}"), "history.csv"))
                time, kinetic = history["time"], history["kinetic.beryllium"]
                measured.append((n, *measure_swings(time, history["middle"], kinetic, 5e-6)))
                style = dict(color=colour, linewidth=1, label=f"{WORDS[element]} of {68 / n:g} mm")
                above.plot(1e6 * time, history["middle"], **style)
                below.plot(1e6 * time, kinetic / kinetic[0], **style)
            known = dict(color="black", linewidth=0.7, linestyle="--", label="Lagrangian")
            above.plot(1e6 * reference["time"], reference["middle"], **known)
            below.plot(1e6 * reference["time"], reference["kinetic"] / reference["kinetic"][0], **known)
            above.legend(fontsize=6)
            name = f"plate, {WORDS[element]} of {', '.join(f'{68 / m[0]:g}' for m in measured)} mm"
            rows += [
                Row(f"{name}: first period [us]", ", ".join(f"{1e6 * m[1][0]:.2f}" for m in measured),
                    f"{1e6 * periods[0]:.2f}", "—"),
                Row("mean of all", ", ".join(spread_of(m[1], 1e-6, 2) for m in measured),
                    spread_of(periods, 1e-6, 2), "—"),
                Row("amplitude lost per period [%]", ", ".join(f"{100 * m[2]:.0f}" for m in measured),
                    f"{100 * lost:.1f}", "—"),
            ]
        axes[0].set_ylabel("velocity of the middle [m/s]", fontsize=8)
        axes[2].set_ylabel("kinetic energy over the first", fontsize=8)
        save(figure, results.picture("vibration"), "time [us]")
        return rows


class Turning:
    """What the disc keeps of its angular momentum, pressure and shape."""

    name = "turning"
    OMEGA, RADIUS, RHO0 = 1e4, 0.1, 2700.0

    def __init__(self):
        self.sizes = {}

    def runs(self, quick):
        self.sizes = {4: [24], 3: [24]} if quick else {4: [24, 48], 3: [24, 36]}
        for element, sizes in self.sizes.items():
            for n in sizes:
                yield Run(f"turning_{element}_{n}", "turning_disc",
                          {"mesh_parameters": f"{{ length = 0.24, height = 0.24, n = {n}, element = {element} }}"})

    def draw(self, results):
        rows = []
        figure, axes = new_figure(3, 3, 3.4, 2.6)
        for element, sizes in self.sizes.items():
            series = []
            for n, colour in zip(sizes, COLOURS):
                if not results.good(f"turning_{element}_{n}"):
                    continue
                found = numpy.array([self.measure(time, Cells(file))
                                     for time, file in outputs(pvd_in(results.directory(f"turning_{element}_{n}")))])
                series.append((n, found))
                for axis, which in zip(axes, (1, 2, 3)):
                    axis.plot(found[:, 0], found[:, which], "-o" if element == 4 else ":s", color=colour, linewidth=1,
                              markersize=3, label=f"{WORDS[element]} of {240 / n:g} mm")
            name = f"disc, {WORDS[element]} of {', '.join(f'{240 / n:g}' for n, _ in series)} mm"
            for which, what, exact in ((1, "angular momentum over the exact", "1"),
                                       (2, "stress off by [GPa], mean", "0"),
                                       (3, "distance of ρ/(ρ0 det e) from 1, mean", "0"),
                                       (4, "second moment of the shape over the exact", "1")):
                values = "; ".join(f"{f[1, which]:.3g}, {f[-1, which]:.3g}" for _, f in series)
                rows.append(Row(f"{name}: {what}, after 1, 10 turns", values, exact, "—"))
        for axis, label in zip(axes, ("angular momentum over the exact", "mean error of the stress [GPa]",
                                      "mean |ρ/(ρ0 det e) − 1|")):
            axis.set_title(label, fontsize=8)
        axes[0].legend(fontsize=6)
        save(figure, results.picture("turning"), "turns")
        return rows

    def measure(self, time, cells):
        """(turns; angular momentum over the exact one; mean error of the stress [GPa]; mean distance of
        rho/(rho0 det e) from 1; second moment of the area over the exact one)"""
        x, y = cells.centres[:, 0], cells.centres[:, 1]
        area, rho = cells["alpha.aluminium"] * cells.volume, cells["density.aluminium"]
        mass = area * rho
        momentum = numpy.sum(mass * (x * cells["velocity.aluminium.y"] - y * cells["velocity.aluminium.x"]))
        pressure = -0.5 * self.RHO0 * self.OMEGA**2 * (self.RADIUS**2 - x**2 - y**2)
        off = sum((cells[f"stress.aluminium.{i}"] + pressure) ** 2 for i in ("xx", "yy", "zz"))
        off = numpy.sqrt(off + 2 * cells["stress.aluminium.xy"] ** 2)
        e = {(b, i): cells[f"cobasis.aluminium.e{b}.{i}"] for b in (1, 2, 3) for i in "xyz"}
        stretch = (e[1, "x"] * e[2, "y"] - e[1, "y"] * e[2, "x"]) * e[3, "z"]
        there = mass > 0
        drift = numpy.zeros_like(rho)
        drift[there] = numpy.abs(rho[there] / (self.RHO0 * stretch[there]) - 1)
        polar = math.pi * self.RADIUS**4 / 2
        return (time * self.OMEGA / (2 * math.pi), momentum / (self.RHO0 * self.OMEGA * polar),
                1e-9 * numpy.average(off, weights=mass), numpy.average(drift, weights=mass),
                numpy.sum(area * (x**2 + y**2)) / polar)


FAMILIES = [Tube(), Vibration(), Turning()]
