"""Draws small scenes: (case, {key: value} for --set, whether energy stays but for what leaves through boundaries)."""
import math

SOLIDS = ("aluminium", "copper", "carbopol")
FLUIDS = ("air", "water", "helium")
# Cases of two halves: speed; names of phases whose material may be any other.
HALVES = {
    "advection": (400.0, ("aluminium",)),
    "impact": (400.0, ("copper", "aluminium")),
    "shear": (500.0, ("aluminium",)),
    "sliding": (100.0, ("copper", "aluminium")),
    "sod": (1.0, ()),
    "water_air": (100.0, ()),
}
# Other cases, on their own meshes: numbers of the mesh and their range; the region that moves, its velocity; whether
# there is anything that gives or takes energy: a void, gravity.
BODIES = {
    "breathing_tube": ({"h": (0.15, 0.3)}, None, True),
    "breathing_tube_axisymmetric": ({"n": (3, 8)}, None, True),
    "disc": ({"n": (12, 40)}, (1, ["-{0}*(y-1)", "{0}*(x-1)"], 8000.0), False),
    "droplet": ({"h": (0.9e-3, 1.6e-3)}, (1, ["0.0", "0.0", "-{0}"], 5.0), True),
    "droplet_axisymmetric": ({"h": (0.4e-3, 1.2e-3)}, (1, ["-{0}", "0.0"], 6.0), True),
    "droplet_on_sphere": ({"h": (0.4e-3, 0.8e-3)}, (1, ["-{0}", "0.0"], 4.0), True),
    "helium_bubble": ({"n": (30, 80)}, (2, ["{0}", "0.0"], 200.0), False),
    "plate": ({"h": (6e-3, 12e-3)}, (2, ["{0}", "0.0"], 2000.0), False),
    "start": ({"n": (12, 32)}, (2, ["{0}", "0.3*{0}"], 3000.0), False),
    "three_phases": ({"n": (16, 40), "ny": (16, 40)}, (2, ["{0}", "0.1*{0}"], 3000.0), False),
    "turning_disc": ({"n": (12, 40)}, None, True),
    "vibrating_plate": ({"n": (20, 60)}, None, True),
    "wave": ({"n": (6, 30)}, None, False),
}


def number(chance, low, high):
    """Of the same chance in every decade; whole if `low` is."""
    value = math.exp(chance.uniform(math.log(low), math.log(high)))
    return round(value) if isinstance(low, int) else float(f"{value:.4g}")


def array(values):
    return "[" + ", ".join(f'"{v}"' if isinstance(v, str) else f"{v:.6f}" for v in values) + "]"


def scheme(chance):
    """Settings that every case allows."""
    return {
        "cfl": chance.choice([0.3, 0.6, 0.8]),
        "max_steps": chance.randint(5, 120),
        "output.count": 2,
        "output.history_every": 1,
        "scheme.order": chance.choice([1, 2, 2]),
        "scheme.interface": chance.choice(["sharp", "compressed", "diffuse"]),
        "scheme.limiter": chance.choice(["monotone", "monotone", "none"]),
        "scheme.low_mach": chance.choice(["on", "off"]),
        "contact.default": chance.choice(["sliding", "adherence", '{ type = "friction", coefficient = 0.3 }']),
    }


def halves(chance):
    """Two bodies, of any materials, that meet in a plane of any direction; on any mesh, between any boundaries."""
    case = chance.choice(list(HALVES))
    speed, free = HALVES[case]
    settings = scheme(chance)
    file, elements, sizes = chance.choice([("box", (3, 4), (8, 32)), ("box_space", (0, 4, 8), (4, 9))])
    element = chance.choice(elements)
    d = 3 if file == "box_space" else 2
    settings["mesh"] = f"../meshes/{file}.geo"
    settings["mesh_parameters"] = f"{{ n = {number(chance, *sizes)}, element = {element} }}"
    materials = {name: chance.choice([name, *SOLIDS, *FLUIDS]) for name in free}
    settings |= {f"phase.{name}.material": material for name, material in materials.items()}
    if settings["scheme.interface"] == "diffuse" and chance.random() < 0.3:
        settings["alpha_min"] = number(chance, 1e-10, 1e-3)
    if settings["scheme.interface"] == "diffuse" and len(free) == 2 and chance.random() < 0.3:
        rates = f'velocity = "stiff", pressure = {chance.choice([0.0, 1e-3])}'
        settings["relaxation"] = f"{{ {'-'.join(free)} = {{ {rates} }} }}"
    settings["region.1.point"] = array(chance.uniform(0.3, 0.7) for _ in range(d))
    settings["region.1.normal"] = array(chance.choice([chance.uniform(-1, 1), 1.0]) for _ in range(d))
    speed *= number(chance, 0.01, 20.0)
    for region in (0, 1):
        settings[f"region.{region}.velocity"] = array(speed * chance.uniform(-1, 1) for _ in range(d))
    sides = [["left", "right"], ["bottom", "top"], ["back", "front"]][:d]
    solid = any(material in SOLIDS for material in materials.values())
    others = chance.choice(["wall", "symmetry", "transmissive"] + ["no_slip"] * solid)
    joined = [pair for pair in sides if element == (4 if d == 2 else 8) and chance.random() < 0.3]
    entries = [f'{low} = {{ type = "periodic", with = "{high}" }}' for low, high in joined]
    if len(joined) < d:
        entries.append(f'"*" = "{others}"')
    settings["boundary"] = "{ " + ", ".join(entries) + " }"
    settings |= {"line.0.from": array([0.05] * d), "line.0.to": array([0.95] * d), "line.0.points": 20}
    pulled = chance.random() < 0.2
    if pulled:
        settings["gravity"] = array(speed * chance.uniform(-100, 100) for _ in range(d))
    return case, settings, not pulled


def bodies(chance):
    """A case with other numbers of its mesh and another velocity."""
    case = chance.choice(list(BODIES))
    sizes, moves, driven = BODIES[case]
    settings = scheme(chance)
    settings |= {f"mesh_parameters.{key}": number(chance, *size) for key, size in sizes.items()}
    settings["mesh_parameters.element"] = chance.choice([4, 8] if case == "droplet" else [3, 4])
    if moves:
        region, velocity, fastest = moves
        speed = number(chance, fastest / 30, fastest)
        settings[f"region.{region}.velocity"] = array(text.format(speed) for text in velocity)
    return case, settings, not driven
