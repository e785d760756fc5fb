"""Figures 16 and 17: the droplet at seven times for two stored energies; how far it spreads; its energies."""
import os

import numpy

from common.plots import new_figure, save
from common.results import REFERENCE, columns, nearest_output
from gallery.run import Row, Run

TIMES = [0.5e-3, 1.5e-3, 3e-3, 4.5e-3, 6e-3, 8e-3, 16e-3]
RADIUS = 6e-3
STORED = (0, -1)  # the parameter a
SPEEDS = [0.3, 0.5, 1, 2, 3, 4.5, 6]
QUICK_SPEEDS = [0.5, 1, 3]
SIZES = ["0.4e-3", "0.3e-3", "0.2e-3"]
QUICK_SIZES = ["0.4e-3"]
TILE = (520, 420)
COLOURS = {0: (0.93, 0.93, 0.9), -1: (0.25, 0.42, 0.75)}


def end_of_spreading(a, speed):
    """A time at which the droplet recoils."""
    return min(14e-3, 8e-3 / speed**0.6 + 1e-3) if a == 0 else max(9e-3, 17e-3 - 2.2e-3 * speed)


def name_of(a, speed, h):
    return f"droplet_{a}_{speed:g}_{h}"


class Droplet:
    name = "droplet"

    def __init__(self):
        self.speeds, self.sizes = [], []

    def runs(self, quick):
        self.speeds, self.sizes = (QUICK_SPEEDS, QUICK_SIZES) if quick else (SPEEDS, SIZES)
        for a in STORED:
            h = "0.2e-3" if a == 0 and not quick else "0.4e-3"  # finer, lamellae of a = -1 stop the run
            room = {"mesh_parameters": f"{{ h = {h}, {'outer = 3, height = 40e-3' if a == 0 else 'outer = 6, height = 24e-3'} }}"}
            yield Run(f"droplet_{a}_series", "droplet_axisymmetric",
                      room | {"phase.carbopol.elastic.a": a, "end_time": 16e-3, "output.every": 0.5e-3})
        for h in self.sizes:
            for a in STORED:
                for speed in self.speeds:
                    settings = {
                        "mesh_parameters": f"{{ h = {h}, outer = {3 if a == 0 else 7} }}",
                        "phase.carbopol.elastic.a": a,
                        "region.1.velocity": f"[{-speed}, 0.0]",
                        "end_time": end_of_spreading(a, speed),
                        "output.count": 1,
                    }
                    yield Run(name_of(a, speed, h), "droplet_axisymmetric", settings)

    def draw(self, results):
        if all(results.good(f"droplet_{a}_series") for a in STORED):
            self._draw_series(results)
        histories = {}
        for h in self.sizes:
            for a in STORED:
                for speed in self.speeds:
                    file = os.path.join(results.directory(name_of(a, speed, h)), "history.csv")
                    if os.path.exists(file):  # of a run that stopped: until then
                        histories[a, speed, h] = columns(file)
        reference = columns(os.path.join(REFERENCE, "droplet.csv"))
        self._draw_spread(histories, reference, results.picture("droplet_spread"))
        self._draw_energies(histories, results.picture("droplet_energies"))
        return rows_of_spread(histories, reference) + rows_of_energies(histories)

    def _draw_series(self, results):
        from common.views import Sheet, actor_of, contour_of, read_body, section_of, text, turned, view_of_body, wall_of
        from common.views import with_normals

        columns_of_tiles = 4
        sheet = Sheet(columns_of_tiles * TILE[0], 2 * TILE[1])
        room, height = 5.5 * RADIUS, 20e-3
        for i, time in enumerate(TIMES):
            left, bottom = (i % columns_of_tiles) * TILE[0], (1 - i // columns_of_tiles) * TILE[1]
            view = sheet.renderer(left, bottom, left + TILE[0], bottom + TILE[1])
            view.AddActor(wall_of(room))
            for a, start in ((0, 90), (-1, -90)):
                directory = results.directory(f"droplet_{a}_series")
                plane = read_body(nearest_output(directory, time)[1], "carbopol")
                skin = with_normals(turned(contour_of(plane), 180))
                ends = [(section_of(plane), angle) for angle in (0, 180)]
                for surface, angle in [(skin, 0)] + ends:
                    part = actor_of(surface, color=COLOURS[a])
                    part.RotateZ(start + angle)
                    part.GetProperty().SetSpecular(0.15)
                    view.AddActor(part)
            view_of_body(view, room, height)
            sheet.light.AddLightsToRenderer(view)
            view.AddActor2D(text(f"t = {1e3 * time:g} ms", 20, TILE[0] / 2, 14))
        legend = sheet.renderer(3 * TILE[0], 0, 4 * TILE[0], TILE[1])
        words = ("left, white: a = 0", "right, blue: a = -1 (neo-Hookean)", "3 m/s, axisymmetric, sharp")
        for k, line in enumerate(words):
            legend.AddActor2D(text(line, 20, TILE[0] / 2, TILE[1] * 0.6 - 40 * k))
        sheet.write(results.picture("droplet"))

    def _draw_spread(self, histories, reference, picture):
        figure, (axis,) = new_figure(1, 1, 6.5, 4.2)
        styles = dict(zip(self.sizes, ("-", "-") if len(self.sizes) < 3 else (":", "--", "-")))
        for a, colour in ((0, "tab:red"), (-1, "tab:blue")):
            for h in self.sizes:
                known = [speed for speed in self.speeds if (a, speed, h) in histories]
                reached = [speed for speed in known if recoils(histories[a, speed, h])]
                at_least = [speed for speed in known if speed not in reached]

                def spread(speeds):
                    return [largest(histories[a, speed, h], "spread")[0] for speed in speeds]

                marker = "s" if a == 0 else "^"
                label = f"a = {a}, h = {1e3 * float(h):g} mm"
                style = dict(color=colour, linewidth=1, markersize=4, label=label)
                axis.plot(reached, spread(reached), styles[h] + marker, **style)
                if at_least:
                    axis.plot(at_least, spread(at_least), marker, markersize=6, markerfacecolor="none", color=colour)
            known = reference["a"] == a
            axis.plot(reference["speed"][known], reference["spread"][known], "o", markersize=9, markerfacecolor="none",
                      color="black", label="Lagrangian finite elements" if a == 0 else None)
        axis.plot([], [], "^", markersize=6, markerfacecolor="none", color="tab:blue", label="at least: ended too soon")
        axis.set_ylabel("largest spread, Lm / L0", fontsize=8)
        axis.set_xlim(0, 6.3)
        axis.set_ylim(0, None)
        axis.legend(fontsize=7)
        save(figure, picture, "impact velocity [m/s]")

    def _draw_energies(self, histories, picture):
        figure, axes = new_figure(2)
        exact = columns(os.path.join(REFERENCE, "droplet_history.csv"))
        shades = dict(zip(self.sizes, ("tab:orange", "tab:green", "tab:blue")))
        for h in self.sizes:
            if (0, 3, h) not in histories:
                continue
            history = histories[0, 3, h]
            time, label = 1e3 * history["time"], f"h = {1e3 * float(h):g} mm"
            for name, style in (("kinetic", "-"), ("elastic", "--")):
                share = energy(history, name, history["time"])
                axes[0].plot(time, share, style, color=shades[h], linewidth=1, label=f"{name}, {label}")
            axes[1].plot(time, history["r95"] / RADIUS, color=shades[h], linewidth=1, label=label)
        known = dict(marker="o", linestyle="none", markersize=5, markerfacecolor="none", color="black")
        axes[0].plot([1, 2, 2, 2.4, 2.4], [0.075, 0.425, 0.320, 0.334, 0.399], label="Lagrangian", **known)
        axes[1].plot(1e3 * exact["time"], exact["r95"], label="Lagrangian", **known)
        axes[0].set_ylabel("energy over the first kinetic", fontsize=8)
        axes[1].set_ylabel("95 % radius / R0", fontsize=8)
        for axis in axes:
            axis.set_xlim(0, 3)
            axis.legend(fontsize=6)
        save(figure, picture, "time [ms], a = 0, 3 m/s")


def largest(history, name):
    """(largest radius over R0, its time)."""
    at = numpy.nanargmax(history[name])
    return history[name][at] / RADIUS, history["time"][at]


def recoils(history):
    """Whether the radius that holds 95 % has been larger than it is at the end, and nothing left the domain before."""
    at = numpy.nanargmax(history["r95"])
    left = history["outflow.outer.mass.carbopol"][at] / history["mass.carbopol"][0]
    return history["time"][at] < 0.97 * history["time"][-1] and left < 1e-3


def energy(history, name, time):
    """Kinetic energy, or what elastic energy has been gained, over the first kinetic energy."""
    values = history[f"{name}.carbopol"] - (history["elastic.carbopol"][0] if name == "elastic" else 0)
    return numpy.interp(time, history["time"], values / history["kinetic.carbopol"][0])


def rows_of_spread(histories, reference):
    rows = []
    for i in range(len(reference["a"])):
        a, speed = int(reference["a"][i]), float(reference["speed"][i])
        for name, label in (("spread", "largest spread Lm/L0"), ("r95", "largest 95 % radius")):
            these = [history for (b, s, _), history in histories.items() if (b, s) == (a, speed)]
            found = [f"{largest(history, name)[0]:.3f}" for history in these]
            if found:
                rows.append(Row(f"droplet, a = {a}, {speed:g} m/s: {label}", ", ".join(found),
                                f"{reference[name][i]:g}", "see Fig. 17"))
    return rows


def rows_of_energies(histories):
    found = [history for (a, speed, h), history in histories.items() if (a, speed) == (0, 3)]
    if not found:
        return []
    kinetic, elastic = (
        ", ".join(f"{energy(history, name, 2e-3):.3f}" for history in found) for name in ("kinetic", "elastic")
    )
    return [
        Row("droplet, a = 0, 3 m/s: kinetic energy at 2 ms over the first", kinetic, "0.425", "—"),
        Row("the same, elastic energy", elastic, "0.320", "—"),
    ]


FAMILIES = [Droplet()]
