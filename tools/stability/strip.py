"""Meshes that are exact images of each other in any unit of length; Gmsh's own end where coordinates are tiny."""
import collections
import itertools

GMSH_TYPES = {2: 1, 3: 2, "quadrilaterals": 3, "triangles": 2, "tetrahedra": 4}  # of faces, by corners; of cells


def simplices(d):
    """Corners, by bits, of those that make a square or a cube: along the paths of edges between opposite corners."""
    for order in itertools.permutations(range(d)):
        path = [sum(1 << axis for axis in order[:k]) for k in range(d + 1)]
        odd = sum(order[i] > order[j] for i in range(d) for j in range(i + 1, d)) % 2
        yield path[:-2] + path[:-3:-1] if odd else path


def strip_of(element, n, across, length):
    """Text of a .msh: as many cells along x, `across` of the same size in other directions."""
    d = 3 if element == "tetrahedra" else 2
    counts = [n] + [across] * (d - 1)
    points = list(itertools.product(*(range(count + 1) for count in counts)))
    number = {point: i + 1 for i, point in enumerate(points)}
    size = length / n
    cells = []
    for low in itertools.product(*(range(count) for count in counts)):
        corner = [number[tuple(low[axis] + (bits >> axis & 1) for axis in range(d))] for bits in range(1 << d)]
        if element == "quadrilaterals":
            cells.append([corner[0], corner[1], corner[3], corner[2]])
        else:
            cells += [[corner[bits] for bits in path] for path in simplices(d)]
    lines = []
    groups = ["left", "right", "bottom", "top", "back", "front"][: 2 * d]
    for face in boundary(cells, d, element):
        at = [points[i - 1] for i in face]
        axis = next(axis for axis in range(d) if len({point[axis] for point in at}) == 1)
        group = 2 * axis + (1 if at[0][axis] else 0) + 1
        lines.append(f"{GMSH_TYPES[d]} 2 {group} {group} " + " ".join(map(str, face)))
    lines += [f"{GMSH_TYPES[element]} 2 9 9 " + " ".join(map(str, cell)) for cell in cells]
    text = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat", f"$PhysicalNames\n{len(groups) + 1}"]
    text += [f'{d - 1} {i + 1} "{name}"' for i, name in enumerate(groups)]
    text += [f'{d} 9 "domain"\n$EndPhysicalNames', f"$Nodes\n{len(points)}"]
    text += [f"{number[p]} " + " ".join(repr(size * x) for x in (*p, 0, 0)[:3]) for p in points]
    text += [f"$EndNodes\n$Elements\n{len(lines)}"] + [f"{i + 1} {line}" for i, line in enumerate(lines)]
    return "\n".join(text) + "\n$EndElements\n"


def boundary(cells, d, element):
    """Faces of one cell only."""
    found = collections.Counter()
    for cell in cells:
        if element == "quadrilaterals":
            faces = [(cell[i], cell[(i + 1) % 4]) for i in range(4)]
        else:
            faces = itertools.combinations(cell, d)
        found.update(tuple(sorted(face)) for face in faces)
    return [face for face, count in found.items() if count == 1]
