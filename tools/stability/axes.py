"""What is taken to extremes: AXES, a table to extend by an entry."""
import dataclasses
import math

from stability.case import AIR, ALUMINIUM, CLOSED, COPPER, EVERYWHERE, FASTEST, OPEN, WATER
from stability.case import case, filled, gas, liquid
from stability.strip import graded, leaning, shaken, strip_of

OWN_MESH = 'mesh = "strip.msh"'  # the axis says what is in it
SOUND = math.sqrt(1.4e5)  # of a gas with gamma 1.4 at 1e5 Pa and 1 kg/m^3 [m/s]


def short(value):
    """1e10, 1e-9, 1-1e-9"""
    text = f"1-{1 - value:.0e}" if 0.99 < value < 1 else f"{value:g}"
    return text.replace("e+", "e").replace("e0", "e").replace("e-0", "e-")


@dataclasses.dataclass
class Axis:
    name: str
    values: list  # from mild to extreme
    text: object  # (grid, order, value) -> text of the case
    quick: list  # values for --quick
    label: object = lambda value: short(value)
    factors: object = None  # value -> {"length", "time", "density": factor} over the case of value 1, else None
    mesh: object = None  # (grid, value) -> text of its strip.msh, where the case has one
    grows: bool = False  # a run in which kinetic energy grows is unstable


def density_ratio(grid, order, ratio):
    phases = {"heavy": gas(), "light": gas()}
    regions = [
        filled(EVERYWHERE, "light", grid.vector(0.0), density=1.0),
        filled(grid.half(), "heavy", grid.vector(100.0), density=ratio),
    ]
    return case(grid.strip(), order, 0.5 / SOUND, phases, regions)


def impact(grid, order, speed, elastic="", mesh=None, end_time=None, cfl=0.8):
    phases = {"copper": COPPER, "aluminium": ALUMINIUM + elastic}
    regions = [
        filled(EVERYWHERE, "aluminium", grid.vector(-speed / 2)),
        filled(grid.half(), "copper", grid.vector(speed / 2)),
    ]
    end_time = end_time or 0.35 / (FASTEST + speed)
    return case(mesh or grid.strip(), order, end_time, phases, regions, OPEN, cfl)


def shear(grid, order, speed, push=0.0, a=0.5):
    sides = 'left = "transmissive"\nright = "transmissive"\nbottom = { type = "periodic", with = "top" }'
    if grid.space:
        sides += '\n"*" = "symmetry"'
    regions = [
        filled(EVERYWHERE, "aluminium", grid.vector(-push, -speed)),
        filled(grid.half(slope=0.0), "aluminium", grid.vector(push, speed)),
    ]
    phases = {"aluminium": ALUMINIUM + f"\nelastic = {{ a = {a!r} }}"}
    return case(grid.strip(), order, 0.35 / (FASTEST + speed), phases, regions, sides)


def pressed_shear(grid, order, a):
    return shear(grid, order, 500.0, 300.0, a)


def tension(grid, order, share):
    regions = [
        filled(EVERYWHERE, "aluminium", grid.vector(0.0)),
        filled(grid.half(), "aluminium", grid.vector(0.0), pressure=-share * 21.5e9),
    ]
    return case(grid.strip(), order, 0.5 / FASTEST, {"aluminium": ALUMINIUM}, regions)


def tension_beside_air(grid, order, share):
    phases = {"water": WATER + "\neos = { p_inf = 6e8 }", "air": AIR}
    regions = [
        filled(EVERYWHERE, "air", grid.vector(0.0)),
        filled(grid.half(), "water", grid.vector(0.0), pressure=-share * 6e8),
    ]
    return case(grid.strip(), order, 0.5 / 1650, phases, regions)


def into_thin_gas(grid, order, ratio):
    regions = [
        filled(EVERYWHERE, "gas", grid.vector(0.0), pressure=1e5 / ratio, density=1 / ratio),
        filled(grid.half(), "gas", grid.vector(0.0), density=1.0),
    ]
    return case(grid.strip(), order, 0.12 / SOUND, {"gas": gas()}, regions)


def beside_thin_gas(grid, order, ratio):
    regions = [
        filled(EVERYWHERE, "air", grid.vector(0.0), pressure=1e5 / ratio, density=1.2 / ratio),
        filled(grid.half(), "copper", grid.vector(300.0)),
    ]
    return case(grid.strip(), order, 0.5 / FASTEST, {"copper": COPPER, "air": AIR}, regions)


def shear_modulus(grid, order, factor):
    return impact(grid, order, 600.0, f"\nelastic = {{ mu = {26e9 * factor!r} }}",
                  end_time=0.35 / math.hypot(FASTEST, math.sqrt(4 / 3 * 26e9 * factor / 2700)))  # fmt: skip


def reference_pressure(grid, order, p_inf):
    phases = {"liquid": liquid(p_inf), "air": AIR}
    regions = [
        filled(EVERYWHERE, "air", grid.vector(0.0)),
        filled(grid.half(), "liquid", grid.vector(100.0), density=1000.0),
    ]
    end_time = 0.6 / math.sqrt(4.4 * (p_inf + 1e5) / 1000 + SOUND**2)
    return case(grid.strip(), order, end_time, phases, regions)


def stretch(grid, order, ratio):
    """Along x, of the left half, at constant volume."""
    side = math.sqrt(ratio)
    cobasis = f"[[{1 / ratio!r}, 0.0, 0.0], [0.0, {side!r}, 0.0], [0.0, 0.0, {side!r}]]"
    regions = [
        filled(EVERYWHERE, "aluminium", grid.vector(0.0)),
        filled(grid.half(), "aluminium", grid.vector(0.0), more=f"phase.aluminium = {{ cobasis = {cobasis} }}"),
    ]
    largest = max(ratio, 1 / ratio)
    return case(grid.strip(), order, 0.35 / FASTEST / largest, {"aluminium": ALUMINIUM}, regions)


def turns(grid, order, count):
    """A disc of aluminium in a void, 600 m/s at its rim."""
    radius, rim = 0.33, 600.0
    spin = rim / radius
    velocity = f'["{-spin!r}*(y-0.5)", "{spin!r}*(x-0.5)"' + (', "0"]' if grid.space else "]")
    phases = {"aluminium": ALUMINIUM, "nothing": "void = { pressure = 0.0 }"}
    regions = [
        f'{EVERYWHERE}\nfill = "nothing"',
        filled(grid.disc(0.5, 0.5, radius), "aluminium", velocity),
    ]
    return case(grid.square(8 if grid.space else 12), order, count * 2 * math.pi / spin, phases, regions)


def fraction(grid, order, share):
    def mixed(shape, velocity):
        alpha = f"alpha = {{ copper = {share!r}, aluminium = {1 - share!r} }}"
        return f"{shape}\n{alpha}\npressure = 1e5\nvelocity = {velocity}"

    regions = [mixed(EVERYWHERE, grid.vector(-200.0)), mixed(grid.half(), grid.vector(200.0))]
    phases = {"copper": COPPER, "aluminium": ALUMINIUM}
    return case(grid.strip(), order, 0.35 / FASTEST, phases, regions, OPEN)


def three_phases(grid, order, speed):
    phases = {"copper": COPPER, "aluminium": ALUMINIUM, "air": AIR}
    regions = [
        filled(EVERYWHERE, "air", grid.vector(0.0)),
        filled(grid.box((0.504, 0.104), (0.704, 0.896)), "aluminium", grid.vector(0.0)),
        filled(grid.disc(0.35, 0.5, 0.14), "copper", grid.vector(float(speed))),
    ]
    sides = '"*" = "transmissive"'
    return case(grid.square(16), order, min(0.3 / max(speed, 1), 0.5 / FASTEST), phases, regions, sides)


def wedges(grid, order, count):
    """So many phases around a line, which all fly towards it."""
    names = [["copper", "water", "aluminium", "air", "carbopol", "helium"][k % 6] for k in range(count)]
    phases = {f"{name}_{k}": f'material = "{name}"' for k, name in enumerate(names)}
    velocity = grid.vector("-600*(x-0.507)", "-600*(y-0.512)")
    regions = []
    for k, name in enumerate(phases):  # half a turn each, painted over from its begin on by the next
        turn = math.pi * k / count
        half = f'shape = "half_space"\npoint = {grid.vector(0.507, 0.512)}\n'
        half += f"normal = {grid.vector(-math.sin(turn), math.cos(turn))}"
        regions.append(filled(half if k else EVERYWHERE, name, velocity))
    return case(grid.square(16), order, 0.3 / FASTEST, phases, regions, '"*" = "transmissive"')


def courant(grid, order, cfl):
    """Noise of the velocity of a solid: sines that the mesh cannot resolve."""
    noise = ["sin(9973*x+7919*y)", "sin(8887*x-6841*y)"] + (["sin(7727*x+5807*z)"] if grid.space else [])
    velocity = "[" + ", ".join(f'"{text}"' for text in noise) + "]"
    regions = [filled(EVERYWHERE, "aluminium", velocity)]
    return case(grid.strip(), order, 2 / FASTEST, {"aluminium": ALUMINIUM}, regions, CLOSED, cfl)


def courant_of_impact(grid, order, cfl):
    return impact(grid, order, 600.0, cfl=cfl)


def courant_beside_void(grid, order, cfl):
    """Noise in water whose surface halves cells."""
    noise = grid.vector("NOISE").replace("'NOISE'", '"sin(9973*x+7919*y)"')
    regions = [
        filled(EVERYWHERE, "surroundings", grid.vector(0.0), pressure=0.0),
        filled(grid.half(slope=0.0, x=8.5 / 16), "water", noise, pressure=0.0),
    ]
    phases = {"water": WATER, "surroundings": "void = { pressure = 0.0 }"}
    return case(grid.square(16), order, 10 / 1600.0, phases, regions, CLOSED, cfl)


def slivers(grid, order, aspect):
    return impact(grid, order, 600.0, mesh=grid.strip(aspect), end_time=0.35 / FASTEST * min(1, 20 / aspect))


def leaning_cells(grid, order, angle):
    lowest = min(1.0, math.tan(math.radians(angle)))  # of the height of a row, over a cell's length
    return impact(grid, order, 600.0, mesh=OWN_MESH, end_time=0.35 / FASTEST * min(1, 20 * lowest))


def graded_cells(grid, order, jump):
    return impact(grid, order, 600.0, mesh=OWN_MESH, end_time=0.35 / FASTEST * min(1, 20 / jump))


def shaken_cells(grid, order, share):
    return impact(grid, order, 600.0, mesh=OWN_MESH)


def strip_with(placed):
    """Text of the strip whose corners are where placed(grid, value) says."""
    return lambda grid, value: strip_of(grid.element, grid.n, grid.across, 1.0, placed(grid, value))


def streams(direction):
    def text(grid, order, mach):
        velocity = direction * mach * SOUND
        regions = [
            filled(EVERYWHERE, "gas", grid.vector(-velocity), density=1.0),
            filled(grid.half(), "gas", grid.vector(velocity), density=1.0),
        ]
        return case(grid.strip(), order, 0.35 / SOUND / (1 + mach), {"gas": gas()}, regions, OPEN)

    return text


def scaled(unit):
    def factors(value):
        length, time, mass = (value if unit == name else 1.0 for name in ("length", "time", "mass"))
        return {"length": length, "time": time, "density": mass / length**3}

    def text(grid, order, value):
        by = factors(value)
        speed = by["length"] / by["time"]
        stress = by["density"] * speed**2

        def solid(gamma, p_inf, mu, rho0):
            eos = f'eos = {{ type = "stiffened_gas", gamma = {gamma}, p_inf = {p_inf * stress!r} }}'
            return f"{eos}\nelastic = {{ mu = {mu * stress!r}, rho0 = {rho0 * by['density']!r}, a = 0.5 }}"

        phases = {"copper": solid(4.2, 34.2e9, 92e9, 8900.0), "aluminium": solid(3.4, 21.5e9, 26e9, 2700.0)}
        half = grid.half(x=0.507 * by["length"])
        regions = [
            filled(EVERYWHERE, "aluminium", grid.vector(-256.0 * speed), pressure=131072.0 * stress),
            filled(half, "copper", grid.vector(256.0 * speed), pressure=131072.0 * stress),
        ]
        return case(OWN_MESH, order, 2.0**-15 * by["time"], phases, regions, OPEN)

    def mesh(grid, value):
        return strip_of(grid.element, grid.n, grid.across, factors(value)["length"])

    values = [1.0, 2.0**30, 2.0**-30, 1e9, 1e-9]
    names = dict(zip(values, ["1", "2^30", "2^-30", "1e9", "1e-9"]))
    return Axis(f"unit of {unit} times", values, text, [1.0, 2.0**30], names.get, factors, mesh)


def axes():
    powers = [10.0**k for k in range(0, 11, 2)]
    cfl = [0.4, 0.8, 1.0, 1.2, 1.3, 1.4, 1.6, 1.8, 2.0]
    shares = [0.5, 1e-3, 1e-6, 1e-12, 0.0, 1 - 1e-3, 1 - 1e-6, 1 - 1e-12, 1.0]
    return [
        Axis("density ratio of gases", [10.0**k for k in range(7)], density_ratio, [1e6]),
        Axis("impact of copper on aluminium, m/s", [100.0, 600.0, 1e3, 2e3, 4e3, 6e3, 8e3, 1e4], impact, [1e4]),
        Axis("shear, ± m/s", [100.0, 500.0, 1e3, 2e3, 3e3, 4e3], shear, [4e3]),
        Axis("tension of aluminium, p / -p_inf", [0.1, 0.5, 0.8, 0.9, 0.95, 0.99], tension, [0.99]),
        Axis("tension of water beside air, p / -p_inf", [0.1, 0.5, 0.8, 0.9, 0.95, 0.99], tension_beside_air, [0.99]),
        Axis("gas into gas thinner by", powers[1:], into_thin_gas, [1e10]),
        Axis("copper into air thinner by", powers, beside_thin_gas, [1e10]),
        Axis("mu, times the table's", [1.0, 1e-3, 1e-6, 0.0, 10.0, 100.0, 1e3], shear_modulus, [1e3]),
        Axis("a of aluminium, sheared and pressed", [0.5, 0.25, 0.0, -0.5, -1.0], pressed_shear, [-1.0]),
        Axis("p_inf of a liquid, Pa", [1e6, 1e9, 1e12, 1e3, 0.0], reference_pressure, [0.0]),
        Axis("stretch of aluminium", [1.1, 1.5, 2.0, 5.0, 10.0, 0.5, 0.2, 0.1], stretch, [10.0]),
        Axis("turns of a disc", [0.25, 1.0, 3.0, 10.0], turns, [0.25]),
        Axis("volume fraction of copper", shares, fraction, [1e-12, 1 - 1e-12]),
        Axis("three phases meet at m/s", [0.0, 100.0, 800.0, 2e3, 5e3], three_phases, [800.0]),
        Axis("phases that meet in a line", [2, 3, 4, 6, 12], wedges, [12]),
        Axis("CFL, noise in aluminium", cfl, courant, [0.8, 2.0], grows=True),
        Axis("CFL, noise in water beside a void", cfl, courant_beside_void, [0.8], grows=True),
        Axis("CFL, impact at 600 m/s", cfl, courant_of_impact, [0.8], grows=True),
        Axis("cells, length / height", [1.0, 10.0, 100.0, 1e3, 0.1, 0.01, 1e-3], slivers, [1e3]),
        Axis("angle of cells, degrees", [90.0, 45.0, 10.0, 3.0, 1.0], leaning_cells, [1.0],
             mesh=strip_with(lambda grid, angle: leaning(angle))),
        Axis("neighbours longer by", [1.0, 3.0, 10.0, 30.0, 100.0], graded_cells, [100.0],
             mesh=strip_with(lambda grid, jump: graded(grid.n, jump))),
        Axis("corners moved by, of a cell", [0.1, 0.2, 0.3, 0.4, 0.5], shaken_cells, [0.3],
             mesh=strip_with(lambda grid, share: shaken([grid.n] + [grid.across] * grid.space + [grid.across], share))),
        Axis("streams of gas meet, Mach", [1e-3, 1e-2, 0.1, 1.0, 5.0, 10.0, 50.0], streams(1), [50.0]),
        Axis("streams of gas part, Mach", [1e-3, 0.1, 1.0, 2.0, 5.0, 10.0, 50.0], streams(-1), [50.0]),
        *(scaled(unit) for unit in ("length", "time", "mass")),
    ]


AXES = axes()
