#!/usr/bin/python3
"""Maps where runs finish and where they stop as numbers are taken to extremes.

Each point is a small case, of an axis and value, on quadrilaterals, triangles or tetrahedra, at first or second
order. It finishes; finishes sensitive to round-off, where other units change more than its last digits; stops with a
reason (exit status 3); is refused (2); crawls, with steps that become ever smaller; is unstable, at a CFL number above
the default; or is WRONG: it loses mass or energy, ends by a signal or without a reason, hangs, leaves what is no
number, or differs in units that are powers of two. Leaves extremes.csv (a row per point), extremes.md, extremes.png,
and in wrong/ the cases of points that are WRONG. Exit status 1: there are.
"""
import argparse
import concurrent.futures
import os
import shutil
import sys
import tempfile
import time

from common.readme import into_readme
from common.results import ROOT, Failure
from stability.axes import AXES
from stability.point import WRONG, Point, compare_units, measure
from stability.report import ELEMENTS, ORDERS, draw, read, table, write

GALLERY = os.path.join(ROOT, "cases/figures")


def into_gallery(picture):
    """With colours from a palette: small."""
    from PIL import Image

    os.makedirs(GALLERY, exist_ok=True)
    image = Image.open(picture).convert("RGB").quantize(32)
    image.save(os.path.join(GALLERY, os.path.basename(picture)), optimize=True)


def keep_wrong(points, folder):
    shutil.rmtree(folder, ignore_errors=True)
    for point in points:
        if point.verdict == WRONG:
            point.write(folder)


def perform(axes, given):
    """Runs all points of the axes and leaves what came of them."""
    points = [
        Point(axis, value, element, order)
        for axis in axes
        for value in (axis.quick if given.quick else axis.values)
        for element in ELEMENTS
        for order in ORDERS
    ]
    os.makedirs(given.output, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(lambda point: measure(point, given.program, folder, given.limit), points))
    compare_units(points)
    write(points, os.path.join(given.output, "extremes.csv"))
    keep_wrong(points, os.path.join(given.output, "wrong"))
    return points


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = "; ".join(axis.name for axis in AXES)
    options.add_argument("axes", nargs="*", metavar="AXIS", help=f"part of the name of one of: {names} (default: all)")
    options.add_argument("--quick", action="store_true", help="the extreme values only: a minute")
    options.add_argument("--program", default=os.path.join(ROOT, "build/release/cobasis"))
    options.add_argument("--output", default=os.path.join(ROOT, "out/extremes"), help="default: out/extremes")
    options.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time (default: one per core)")
    options.add_argument("--limit", type=float, default=600, help="seconds after which a run hangs (default: 600)")
    options.add_argument("--redraw", action="store_true", help="picture and table from extremes.csv of an earlier call")
    options.add_argument("--readme", action="store_true", help="picture and table into cases/ too")
    given = options.parse_args()
    if given.jobs < 1:
        options.error(f"--jobs {given.jobs}; allowed: from 1")
    for part in given.axes:
        if not any(part in axis.name for axis in AXES):
            options.error(f"no axis '{part}'; allowed: parts of: {names}")
    chosen = [axis for axis in AXES if not given.axes or any(part in axis.name for part in given.axes)]
    start = time.monotonic()
    try:
        if given.redraw:
            points = read(chosen, os.path.join(given.output, "extremes.csv"))
        else:
            points = perform(chosen, given)
        picture = os.path.join(given.output, "extremes.png")
        draw(points, chosen, picture)
        text = table(points, chosen)
        with open(os.path.join(given.output, "extremes.md"), "w") as out:
            out.write(text)
        if given.readme:
            into_gallery(picture)
            into_readme("extremes", text)
    except (Failure, OSError) as failure:
        sys.exit(f"extremes: {failure}")
    print(text, end="")
    print(f"{(time.monotonic() - start) / 60:.1f} minutes; picture: {picture}")
    sys.exit(1 if any(point.verdict == WRONG for point in points) else 0)


if __name__ == "__main__":
    main()
