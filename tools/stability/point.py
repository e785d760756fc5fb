"""A point of the map: run, and judged by what it left."""
import csv
import dataclasses
import math
import os
import re

import numpy
import vtk  # noqa: F401  before threads do, at once

from common.program import run_case
from common.results import last_cells
from stability.axes import Axis
from stability.case import Grid

FINISHED, SENSITIVE, STOPPED, REFUSED, CRAWLS, UNSTABLE, WRONG = CLASSES = [
    "finished",  # at its end time, conserving
    "sensitive",  # finished, but round-off has grown beyond the tolerance
    "stopped",  # exit status 3 and a reason
    "refused",  # exit status 2 and a reason
    "crawls",  # steps so small that their largest number was not enough
    "unstable",  # a CFL number above the default, at which noise grows
    "WRONG",
]
TOLERANCE = 1e-10  # of mass and energy, relative; of results in other units
DEFAULT_CFL = 0.8
GROWTH = 1.1  # of kinetic energy, which falls where noise decays and bodies collide
COLUMNS = ["axis", "value", "element", "order", "class", "exit", "steps", "mass_error", "energy_error", "least_volume"]
COLUMNS += ["least_density", "least_det_cobasis", "units_error", "words"]


@dataclasses.dataclass
class Point:
    axis: Axis
    value: float
    element: str
    order: int
    verdict: str = ""
    exit: int = 0
    steps: int = 0
    mass_error: float = math.nan
    energy_error: float = math.nan
    least_volume: float = math.nan  # of a phase, of the whole
    least_density: float = math.nan  # of a phase where it is, at the end [kg/m^3]
    least_det_cobasis: float = math.nan  # likewise of a solid
    units_error: float = math.nan
    words: str = ""
    last: dict = dataclasses.field(default_factory=dict)  # the last row of its history

    def name(self):
        text = f"{self.axis.name} {self.axis.label(self.value)} {self.element} order {self.order}"
        return re.sub(r"[^a-z0-9.^+-]+", "_", text.lower())

    def text(self):
        return self.axis.text(Grid(self.element), self.order, self.value)

    def write(self, folder):
        """Its case and what mesh goes with it into a folder of its own; the case's name."""
        directory = os.path.join(folder, self.name())
        os.makedirs(directory)
        case = os.path.join(directory, "case")
        with open(case + ".toml", "w") as out:
            out.write(self.text())
        if self.axis.mesh:
            with open(os.path.join(directory, "strip.msh"), "w") as out:
                out.write(self.axis.mesh(Grid(self.element), self.value))
        return case

    def row(self):
        numbers = [self.mass_error, self.energy_error, self.least_volume, self.least_density, self.least_det_cobasis]
        numbers = [*numbers, self.units_error]
        numbers = ["" if math.isnan(number) else f"{number:.3g}" for number in numbers]
        head = [self.axis.name, self.axis.label(self.value), self.element, self.order, self.verdict, self.exit]
        return head + [self.steps] + numbers + [self.words]


def rows_of(file):
    """{column: values} of a history; None: there is none, or no row."""
    if not os.path.exists(file):
        return None
    with open(file, newline="") as lines:
        rows = list(csv.reader(lines))
    if len(rows) < 2:
        return None
    return dict(zip(rows[0], numpy.array([[float(value) for value in row] for row in rows[1:]]).T))


def total(history, word):
    """Of all phases."""
    return sum(values for name, values in history.items() if re.fullmatch(rf"{word}\.[^.]+", name))


def energy_error(history):
    """Largest change of the energy of all phases with what left through boundaries, relative."""
    left = [values for name, values in history.items() if re.fullmatch(r"outflow\..+\.energy\.[^.]+", name)]
    balance = total(history, "energy") + sum(left)
    scale = max(abs(total(history, "energy"))) + sum(max(abs(values)) for values in left)
    return float(max(abs(balance - balance[0])) / scale) if scale else 0.0


def least_of_fields(directory):
    """(density, det e) of the last output, where a phase has at least 1 % of a cell; NaN: of no phase."""
    cells = last_cells(directory)
    densities, determinants = [math.nan], [math.nan]
    for name in [name for name in cells.fields if name.startswith("density.")]:
        phase = name.removeprefix("density.")
        there = cells.fields.get(f"alpha.{phase}", numpy.ones(len(cells.volume))) > 0.01
        densities.extend(cells[name][there])
        if f"cobasis.{phase}.e1.x" in cells.fields:
            e = [[cells[f"cobasis.{phase}.e{beta}.{axis}"][there] for axis in "xyz"] for beta in (1, 2, 3)]
            determinants.extend(numpy.linalg.det(numpy.moveaxis(numpy.array(e), 2, 0)))
    return float(numpy.fmin.reduce(densities)), float(numpy.fmin.reduce(determinants))


def judge(point, outcome, history):
    """(class, words)"""
    if outcome.exit not in (0, 2, 3) or (outcome.exit and not outcome.words):
        return WRONG, f"exit status {outcome.exit}: {outcome.words or 'no reason told'}"
    if outcome.exit == 0 and history is None:
        return WRONG, "no history"
    if history is not None:
        if not all(numpy.isfinite(values).all() for values in history.values()):
            return WRONG, "not a number in the history"
        if not point.energy_error <= TOLERANCE:
            return WRONG, f"energy changes by {point.energy_error:.3g}"
    if outcome.exit:
        return {2: REFUSED, 3: STOPPED}[outcome.exit], outcome.words
    if not point.mass_error <= TOLERANCE:
        return WRONG, f"mass changes by {point.mass_error:.3g}"
    if point.axis.grows:
        kinetic = total(history, "kinetic")
        if max(kinetic) > GROWTH * kinetic[0]:
            words = f"kinetic energy grows {max(kinetic) / kinetic[0]:.3g} times"
            return UNSTABLE if point.value > DEFAULT_CFL else WRONG, words
    end = float(re.search(r"^end_time = (\S+)", point.text(), re.M).group(1))
    if float(outcome.summary["time"]) < end * (1 - 1e-6):
        return CRAWLS, f"at {float(outcome.summary['time']) / end:.2g} of its time after {point.steps} steps"
    return FINISHED, ""


def measure(point, program, folder, limit):
    """Runs it in a folder of its own and fills in what came of it."""
    case = point.write(folder)
    outcome = run_case(program, case, case, {}, limit)
    history = rows_of(os.path.join(case, "history.csv"))
    point.exit = outcome.exit
    point.mass_error = float(outcome.summary.get("mass_error", "nan"))
    if history is not None:
        point.steps = int(outcome.summary.get("steps", history["step"][-1]))
        point.energy_error = energy_error(history)
        volumes = [values for name, values in history.items() if name.startswith("volume.")]
        if volumes:
            point.least_volume = float(min(min(values) for values in volumes) / sum(volumes)[0])
        point.last = {name: values[-1] for name, values in history.items()}
    if outcome.exit == 0 and os.path.exists(os.path.join(case, "case.pvd")):
        point.least_density, point.least_det_cobasis = least_of_fields(case)
    point.verdict, point.words = judge(point, outcome, history)
    return point


def compare_units(points):
    """In other units results are the same: to the last bit by powers of two, else up to round-off. Where they are the
    same by powers of two, larger differences by other numbers are round-off that has grown."""
    ones = {(p.axis.name, p.element, p.order): p for p in points if p.axis.factors and p.value == 1}
    exact = set(ones)
    for point in sorted(points, key=lambda point: not power_of_two(point.value)):
        key = (point.axis.name, point.element, point.order)
        one = ones.get(key)
        if one is None or WRONG in (point.verdict, one.verdict):
            continue
        if point.verdict != one.verdict:
            point.verdict, point.words = WRONG, f"{point.verdict}, by value 1 {one.verdict}: {point.words}"
        elif point.verdict == FINISHED:
            point.units_error = units_error(point, one)
            if point.units_error > (0 if power_of_two(point.value) else TOLERANCE):
                grown = not power_of_two(point.value) and key in exact
                point.verdict = SENSITIVE if grown else WRONG
                point.words = f"in other units by {point.units_error:.3g} different"
        if power_of_two(point.value) and point.verdict != FINISHED:
            exact.discard(key)


def power_of_two(value):
    return math.frexp(value)[0] == 0.5


def units_error(point, one):
    """The largest difference of volumes, masses, momenta and energies, over the largest value of the kind."""
    by = point.axis.factors(point.value)
    speed = by["length"] / by["time"]
    volume = by["length"] ** (3 if Grid(point.element).space else 2)
    mass = by["density"] * volume
    factors = {"volume": volume, "mass": mass, "momentum": mass * speed, "energy": mass * speed**2}
    error = 0.0
    for kind, factor in factors.items():
        names = [name for name in one.last if kind in name.split(".")]
        scale = max(abs(one.last[name]) for name in names)
        error = max(error, *(abs(point.last[name] / factor - one.last[name]) / scale for name in names))
    return float(error)
