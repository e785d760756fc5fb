"""The map as a picture and as a table."""
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot
from matplotlib.patches import Patch, Rectangle

from common.plots import save
from common.results import Failure
from stability.point import CLASSES, COLUMNS, FINISHED, WRONG, Point

COLOURS = dict(zip(CLASSES, ["#a6dba0", "#4dac9a", "#fdb863", "#9ecae1", "#fff3a0", "#c2a5cf", "#d7191c"]))
ELEMENTS = ["quadrilaterals", "triangles", "hexahedra", "tetrahedra"]
ORDERS = [1, 2]


def write(points, file):
    try:
        with open(file, "w", newline="") as lines:
            table = csv.writer(lines)
            table.writerow(COLUMNS)
            table.writerows(point.row() for point in points)
    except OSError as error:
        raise Failure(error) from None


def read(axes, file):
    """Points of a table that `write` left, of these axes."""
    points = []
    try:
        with open(file, newline="") as lines:
            for row in csv.DictReader(lines):
                found = [(axis, value) for axis in axes if axis.name == row["axis"] for value in axis.values]
                found = [(axis, value) for axis, value in found if axis.label(value) == row["value"]]
                if found:
                    points.append(Point(*found[0], row["element"], int(row["order"]), row["class"], words=row["words"]))
    except (OSError, KeyError, ValueError) as error:
        raise Failure(f"{file}: {error!r}") from None
    return points


def draw(points, axes, picture):
    """Blocks per order and element; a row per axis, in it the values from mild to extreme."""
    widest = max(len({p.value for p in points if p.axis is axis}) for axis in axes)
    size = (2.6 + 3 * max(0.36 * widest, 1.5), 0.7 + 2 * (0.19 * len(axes) + 0.35))
    figure, blocks = plot.subplots(len(ORDERS), len(ELEMENTS), figsize=size, squeeze=False, sharey=True)
    for order, row in zip(ORDERS, blocks):
        for element, block in zip(ELEMENTS, row):
            block.set_title(f"{element}, order {order}", fontsize=8, pad=3)
            for y, axis in enumerate(axes):
                chosen = [p for p in points if p.axis is axis and p.element == element and p.order == order]
                for x, point in enumerate(chosen):
                    colour = COLOURS[point.verdict]
                    block.add_patch(Rectangle((x, y), 0.96, 0.9, color=colour, linewidth=0))
                    ink = "white" if point.verdict == WRONG else "black"
                    label = axis.label(point.value)
                    block.text(x + 0.48, y + 0.47, label, ha="center", va="center", fontsize=5.5, color=ink)
            block.set_xlim(0, widest)
            block.set_ylim(len(axes), 0)
            block.set_xticks([])
            block.set_yticks([y + 0.45 for y in range(len(axes))], [axis.name for axis in axes], fontsize=7)
            block.tick_params(length=0)
            for side in block.spines.values():
                side.set_visible(False)
    present = [name for name in CLASSES if any(point.verdict == name for point in points)]
    patches = [Patch(color=COLOURS[name], label=name) for name in present]
    figure.legend(handles=patches, loc="lower center", ncols=len(patches), fontsize=8, frameon=False)
    figure.supxlabel(" ", fontsize=8)
    save(figure, picture, dpi=110)


def finishes(points, axis, order):
    """Which values finish, in words; by element where they differ."""
    words = {}
    for element in ELEMENTS:
        chosen = [p for p in points if p.axis is axis and p.order == order and p.element == element]
        good = [axis.label(p.value) for p in chosen if p.verdict == FINISHED]
        bad = [axis.label(p.value) for p in chosen if p.verdict != FINISHED]
        text = "all" if not bad else "none" if not good else "all but " + ", ".join(bad)
        if len(bad) > len(good) > 0:
            text = "only " + ", ".join(good)
        words.setdefault(text, []).append(element)
    if len(words) == 1:
        return next(iter(words))
    return "; ".join(f"{', '.join(elements)}: {text}" for text, elements in words.items())


def beyond(points, axis):
    counts = {}
    for point in points:
        if point.axis is axis and point.verdict != FINISHED:
            counts[point.verdict] = counts.get(point.verdict, 0) + 1
    return ", ".join(f"{name} ({counts[name]})" for name in CLASSES if name in counts) or "–"


def table(points, axes):
    lines = ["| axis | values | finish at order 1 | finish at order 2 | the others (points) |", "|---|---|---|---|---|"]
    for axis in axes:
        values = list(dict.fromkeys(axis.label(p.value) for p in points if p.axis is axis))
        cells = [axis.name, ", ".join(values)] + [finishes(points, axis, order) for order in ORDERS]
        lines.append("| " + " | ".join(cells + [beyond(points, axis)]) + " |")
    counts = ", ".join(f"{sum(p.verdict == name for p in points)} {name}" for name in CLASSES)
    lines += ["", f"{len(points)} points: {counts}."]
    wrong = [point for point in points if point.verdict == WRONG]
    if wrong:
        lines += [""] + [f"- WRONG: {point.name()}: {point.words}" for point in wrong]
    return "\n".join(lines) + "\n"
