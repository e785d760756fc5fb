"""What tools/tradeoff runs, and how far from exact a run ended: CASES, a table to extend by a line.

An error is the L1 distance from the exact solution over that of the exact solution's own mean. Of the droplet: the
relative distance of its largest radii until 3 ms from 1.93 R0 (outermost) and 1.83 R0 (95 % of the volume), and of
kinetic and elastic energy at 2 ms from .425 and .320 of the first kinetic energy.
"""
import dataclasses
import math
import os

import numpy

from common.exact import exact_in_tube
from common.results import columns, last_cells


def in_tube(case, fields):
    """Exact values at the centres of the cells: {field: values}."""
    exact = exact_in_tube(case)
    return lambda x: {field: values for field, values in exact(x[:, 0]).items() if field in fields}


def advected_front(x):
    return {"alpha.aluminium": (x[:, 0] < 0.7).astype(float)}


def standing_waves(x):
    rho, gamma, p_inf, mu, p0, t = 2700.0, 3.4, 21.5e9, 26e9, 1e5, 40e-6
    bulk = gamma * (p0 + p_inf)
    K = 2 * math.pi * numpy.array([2.0, 1.0])
    k = math.hypot(*K)
    start = numpy.array([0.01, 0.03])
    phase = x[:, :2] @ K
    u = numpy.zeros((len(x), 2))
    gradient = numpy.zeros((len(x), 2, 2))  # of the displacement
    along = K / k
    for direction, modulus in ((along, bulk + 4 * mu / 3), (numpy.array([-along[1], along[0]]), mu)):
        omega = k * math.sqrt(modulus / rho)
        a = start @ direction
        u += numpy.outer(a * math.cos(omega * t) * numpy.cos(phase), direction)
        gradient -= (a / omega * math.sin(omega * t) * numpy.sin(phase))[:, None, None] * numpy.outer(direction, K)
    volume = numpy.trace(gradient, axis1=1, axis2=2)
    normal = -p0 + (bulk - 2 * mu / 3) * volume
    return {
        "velocity.x": u[:, 0],
        "velocity.y": u[:, 1],
        "stress.xx": normal + 2 * mu * gradient[:, 0, 0],
        "stress.yy": normal + 2 * mu * gradient[:, 1, 1],
        "stress.xy": mu * (gradient[:, 0, 1] + gradient[:, 1, 0]),
    }


def errors_of_fields(directory, exact):
    cells = last_cells(directory)
    volume = cells.volume
    errors = {}
    for name, values in exact(cells.centres).items():
        spread = numpy.abs(values - numpy.average(values, weights=volume))
        errors[name] = numpy.average(numpy.abs(cells[name] - values), weights=volume) / numpy.average(
            spread, weights=volume
        )
    return errors


def errors_of_droplet(directory):
    table = columns(os.path.join(directory, "history.csv"))
    rows = [dict(zip(table, row)) for row in zip(*table.values())]
    radius = 6e-3
    middle = min(rows, key=lambda row: abs(row["time"] - 2e-3))
    start = rows[0]["kinetic.carbopol"]
    measured = {
        "spread": (max(row["spread"] for row in rows) / radius, 1.93),
        "r95": (max(row["r95"] for row in rows) / radius, 1.83),
        "kinetic": (middle["kinetic.carbopol"] / start, 0.425),
        "elastic": ((middle["elastic.carbopol"] - rows[0]["elastic.carbopol"]) / start, 0.320),
    }
    return {name: abs(value / reference - 1) for name, (value, reference) in measured.items()}


FIRST = {"scheme.order": "1", "cfl": "0.8"}
SECOND = {"scheme.order": "2", "cfl": "0.8", "scheme.limiter": '"monotone"'}
UNLIMITED = {"scheme.limiter": '"none"'}
DIFFUSE = {"scheme.interface": '"diffuse"'}
SHARP = {"scheme.interface": '"sharp"'}
COMPRESSED = {"scheme.interface": '"compressed"'}
LOW_MACH = {"scheme.low_mach": '"on"'}
ACOUSTIC = {"scheme.low_mach": '"off"'}


def cfl(number):
    return {"cfl": str(number)}


ONE_PHASE = {
    "order 1": FIRST | ACOUSTIC,
    "order 2": SECOND | ACOUSTIC,
    "order 2, unlimited": SECOND | UNLIMITED | ACOUSTIC,
    "order 2, low Mach": SECOND | LOW_MACH,
}
TWO_PHASES = {
    "order 1, diffuse": FIRST | DIFFUSE | ACOUSTIC,
    "order 1, sharp": FIRST | SHARP | ACOUSTIC,
    "order 2, diffuse": SECOND | DIFFUSE | ACOUSTIC,
    "order 2, sharp": SECOND | SHARP | ACOUSTIC,
    "order 2, compressed": SECOND | COMPRESSED | ACOUSTIC,
    "order 2, sharp, unlimited": SECOND | SHARP | UNLIMITED | ACOUSTIC,
}


def with_steps(schemes, names, numbers):
    """The schemes, and some of them with other steps."""
    return schemes | {f"{name}, CFL {number}": schemes[name] | cfl(number) for name in names for number in numbers}


def tube(sides):
    """Elements of a strip or bar; `sides`: the boundary of its two further sides in space."""
    space = {"mesh": '"../meshes/tube_space.geo"', "boundary.back": sides, "boundary.front": sides}
    plane = {"mesh": '"../meshes/tube.geo"'}
    return {
        "quadrilaterals": lambda n: plane | {"mesh_parameters": f"{{ n = {n}, element = 4 }}"},
        "triangles": lambda n: plane | {"mesh_parameters": f"{{ n = {n}, element = 3 }}"},
        "hexahedra": lambda n: space | {"mesh_parameters": f"{{ n = {n}, ny = 1, element = 8 }}"},
        "tetrahedra": lambda n: space | {"mesh_parameters": f"{{ n = {n}, ny = 1, element = 4 }}"},
    }


def box():
    return {
        "quadrilaterals": lambda n: {"mesh_parameters": f"{{ n = {n}, element = 4 }}"},
        "triangles": lambda n: {"mesh_parameters": f"{{ n = {n}, element = 3 }}"},
    }


def droplet():
    return {
        "hexahedra": lambda h: {"mesh_parameters": f"{{ h = {h}e-3, element = 8 }}"},
        "tetrahedra": lambda h: {"mesh_parameters": f"{{ h = {h}e-3, element = 4 }}"},
    }


@dataclasses.dataclass
class Case:
    schemes: dict  # name: keys to set
    elements: dict  # name: size -> keys to set; the first is the case's own
    sizes: dict  # element: sizes, coarse to fine
    errors: object  # (case's output directory) -> {quantity: error}
    unit: str = "n"  # what a size is called

    def runs(self):
        for scheme, keys in self.schemes.items():
            for element, sizes in self.sizes.items():
                if "CFL" in scheme and element != next(iter(self.elements)):
                    continue
                for size in sizes:
                    yield scheme, element, size, keys | self.elements[element](size)


def fields_against(exact):
    return lambda directory: errors_of_fields(directory, exact)


CASES = {
    "wave": Case(
        with_steps(ONE_PHASE, ["order 1", "order 2"], [0.4, 1.2]),
        box(),
        {"quadrilaterals": [25, 50, 100, 200, 400], "triangles": [25, 50, 100, 200]},
        fields_against(standing_waves),
    ),
    "shear": Case(
        with_steps(ONE_PHASE, ["order 1", "order 2"], [0.4, 1.2]),
        tube('"symmetry"'),
        {
            "quadrilaterals": [250, 500, 1000, 2000, 4000],
            "triangles": [250, 500, 1000, 2000],
            "hexahedra": [250, 500, 1000, 2000],
            "tetrahedra": [250, 500, 1000],
        },
        fields_against(in_tube("shear", ("velocity.y", "pressure", "stress.xy"))),
    ),
    "impact": Case(
        with_steps(TWO_PHASES, ["order 1, diffuse", "order 2, sharp"], [0.4, 1.2]),
        tube('"symmetry"'),
        {
            "quadrilaterals": [250, 500, 1000, 2000, 4000],
            "triangles": [250, 500, 1000, 2000],
            "hexahedra": [250, 500, 1000, 2000],
            "tetrahedra": [250, 500, 1000],
        },
        fields_against(in_tube("impact", ("density", "velocity.x", "pressure", "stress.xx"))),
    ),
    "advection": Case(
        TWO_PHASES,
        tube('"symmetry"'),
        {"quadrilaterals": [250, 500, 1000, 2000], "triangles": [250, 500, 1000], "tetrahedra": [125, 250, 500]},
        fields_against(advected_front),
    ),
    "droplet": Case(
        {
            f"{scheme}, {name}": TWO_PHASES[scheme] | keys
            for scheme in ("order 1, diffuse", "order 2, diffuse", "order 2, compressed", "order 2, sharp")
            for name, keys in (("acoustic", ACOUSTIC), ("low Mach", LOW_MACH))
        },
        droplet(),
        {"hexahedra": [0.8, 0.6, 0.4], "tetrahedra": [1.0, 0.8, 0.6]},
        errors_of_droplet,
        "h",
    ),
}
QUICK = 2  # sizes of each element
