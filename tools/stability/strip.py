"""Meshes of strips and bars, corner by corner: exact images of each other in any unit of length (Gmsh's own end where
coordinates are tiny), and with cells that no mesher would make."""
import itertools
import math
import random

# Of faces, by corners; of cells.
GMSH_TYPES = {2: 1, 3: 2, 4: 3, "quadrilaterals": 3, "triangles": 2, "tetrahedra": 4, "hexahedra": 5}
SQUARE = [0, 1, 3, 2]  # corners, by bits of x, y, z, in Gmsh's order
CUBE = SQUARE + [4 + bits for bits in SQUARE]
SIDES = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], SQUARE, CUBE[4:]]  # of a cube


def simplices(d):
    """Corners, by bits, of those that make a square or a cube: along the paths of edges between opposite corners."""
    for order in itertools.permutations(range(d)):
        path = [sum(1 << axis for axis in order[:k]) for k in range(d + 1)]
        odd = sum(order[i] > order[j] for i in range(d) for j in range(i + 1, d)) % 2
        yield path[:-2] + path[:-3:-1] if odd else path


def leaning(angle):
    """Rows lean to the right and to the left in turn, their cells with that angle [degrees] between faces; a row is
    lower where its cells would else lean over more than one."""
    slope = math.tan(math.radians(angle))
    height = min(1.0, slope)
    return lambda x, y, *z: (x + y % 2 * height / slope, y * height, *z)


def graded(n, jump):
    """An eighth of the cells, in the middle, are shorter by that factor."""
    fine = n // 8
    begin = (n - fine) // 2
    lost = fine * (1 - 1 / jump)  # the others stay where they are on the left and close up from the right

    def place(x, *others):
        inside = min(max(x - begin, 0), fine)
        return (x - inside + inside / jump + lost / 2, *others)

    return place


def shaken(counts, share):
    """Corners are moved at random in every direction by up to that share of a cell, but not out of the boundary."""

    def place(*point):
        chance = random.Random(str(point))
        moves = [chance.uniform(-share, share) for _ in point]
        return tuple(x + move * (0 < x < count) for x, move, count in zip(point, moves, counts))

    return place


def strip_of(element, n, across, length, place=lambda *point: point):
    """Text of a .msh: as many cells along x, `across` of the same size in other directions; corners go where `place`
    moves their numbers, in cells."""
    d = 3 if element in ("tetrahedra", "hexahedra") else 2
    counts = [n] + [across] * (d - 1)
    points = list(itertools.product(*(range(count + 1) for count in counts)))
    number = {point: i + 1 for i, point in enumerate(points)}
    size = length / n
    cells = []
    for low in itertools.product(*(range(count) for count in counts)):
        corner = [number[tuple(low[axis] + (bits >> axis & 1) for axis in range(d))] for bits in range(1 << d)]
        if element in ("quadrilaterals", "hexahedra"):
            cells.append([corner[bits] for bits in (SQUARE if d == 2 else CUBE)])
        else:
            cells += [[corner[bits] for bits in path] for path in simplices(d)]
    lines = []
    groups = ["left", "right", "bottom", "top", "back", "front"][: 2 * d]
    for face in boundary(cells, element):
        at = [points[i - 1] for i in face]
        axis = next(axis for axis in range(d) if len({point[axis] for point in at}) == 1)
        group = 2 * axis + (1 if at[0][axis] else 0) + 1
        lines.append(f"{GMSH_TYPES[len(face)]} 2 {group} {group} " + " ".join(map(str, face)))
    lines += [f"{GMSH_TYPES[element]} 2 9 9 " + " ".join(map(str, cell)) for cell in cells]
    text = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat", f"$PhysicalNames\n{len(groups) + 1}"]
    text += [f'{d - 1} {i + 1} "{name}"' for i, name in enumerate(groups)]
    text += [f'{d} 9 "domain"\n$EndPhysicalNames', f"$Nodes\n{len(points)}"]
    text += [f"{number[p]} " + " ".join(repr(size * x) for x in (*place(*p), 0, 0)[:3]) for p in points]
    text += [f"$EndNodes\n$Elements\n{len(lines)}"] + [f"{i + 1} {line}" for i, line in enumerate(lines)]
    return "\n".join(text) + "\n$EndElements\n"


def boundary(cells, element):
    """Faces of one cell only."""
    found = {}
    for cell in cells:
        if element == "quadrilaterals":
            faces = [(cell[i], cell[(i + 1) % 4]) for i in range(4)]
        elif element == "hexahedra":
            faces = [tuple(cell[CUBE.index(bits)] for bits in side) for side in SIDES]
        else:
            faces = itertools.combinations(cell, len(cell) - 1)
        for face in faces:
            found.setdefault(tuple(sorted(face)), []).append(face)
    return [faces[0] for faces in found.values() if len(faces) == 1]
