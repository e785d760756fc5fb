#!/usr/bin/python3
"""Computes the figures of Hank, Favrie & Massoni, J. Comput. Phys. (2017), anew.

Runs the cases that the chosen figures need (all by default) and leaves a picture of each, and figures.md, a table of
what was measured beside what is exact.
"""
import argparse
import concurrent.futures
import os
import sys
import time

from common.program import Outcome, run_case
from common.readme import into_readme
from common.results import ROOT, Failure
from common.views import need_display
from gallery import disc, droplet, long, plate, tubes
from gallery.run import Results

FAMILIES = {family.name: family for module in (tubes, plate, droplet, disc, long) for family in module.FAMILIES}
OUTCOME = "outcome"  # a file in the folder of a run: exit status; last words
GALLERY = os.path.join(ROOT, "cases/figures")


def perform(family, quick, given, pool):
    """Runs of a family in the pool: {name: future of its outcome}."""
    folder = os.path.join(given.output, "runs")

    def one(run):
        directory = os.path.join(folder, run.name)
        if given.redraw:
            try:
                with open(os.path.join(directory, OUTCOME)) as earlier:
                    status, words = earlier.read().split(";", 1)
                return Outcome(int(status), words, {})
            except (OSError, ValueError):
                return Outcome(2, "no results of an earlier run", {})
        start = time.monotonic()
        outcome = run_case(given.program, run.case, directory, run.settings, given.limit)
        words = f"{time.monotonic() - start:.1f} s"
        os.makedirs(directory, exist_ok=True)
        with open(os.path.join(directory, OUTCOME), "w") as file:
            file.write(f"{outcome.exit};{outcome.words}")
        if outcome.exit != 0:
            words += f", exit status {outcome.exit}: {outcome.words}"
        print(f"{run.name}: {words}", flush=True)
        return outcome

    return {run.name: pool.submit(one, run) for run in family.runs(quick)}


def table(rows, failures):
    lines = ["| quantity | measured | exact or asked | the paper |", "|---|---|---|---|"]
    lines += [f"| {row.quantity} | {row.measured} | {row.exact} | {row.paper} |" for row in rows]
    if failures:
        lines += ["", f"{len(failures)} run{'s' if len(failures) > 1 else ''} stopped:", ""]
        lines += [f"- {name}: {words}" for name, words in failures]
    return "\n".join(lines) + "\n"


def into_gallery(folder):
    """Small copies beside the cases: colours from a palette."""
    from PIL import Image

    os.makedirs(GALLERY, exist_ok=True)
    for name in sorted(os.listdir(folder)):
        if name.endswith(".png"):
            image = Image.open(os.path.join(folder, name)).convert("RGB")
            if image.width > 1000:
                image = image.resize((1000, round(image.height * 1000 / image.width)), Image.LANCZOS)
            image.quantize(64).save(os.path.join(GALLERY, name), optimize=True)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("names", nargs="*", metavar="NAME", help=f"of: {', '.join(FAMILIES)} (default: all)")
    options.add_argument("--quick", action="store_true", help="coarse meshes, fewer runs: minutes")
    options.add_argument("--program", default=os.path.join(ROOT, "build/release/cobasis"))
    options.add_argument("--output", default=os.path.join(ROOT, "out/figures"), help="default: out/figures")
    options.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time (default: one per core)")
    options.add_argument("--limit", type=float, default=3600, help="seconds that a run may take (default: 3600)")
    options.add_argument("--redraw", action="store_true", help="pictures and table from the runs of an earlier call")
    options.add_argument("--readme", action="store_true", help="pictures and table into cases/ too")
    given = options.parse_args()
    if given.jobs < 1:
        options.error(f"--jobs {given.jobs}; allowed: from 1")
    if given.readme and given.names:
        options.error("--readme renews the table of all figures; allowed: without names (--redraw spares the runs)")
    for name in given.names:
        if name not in FAMILIES:
            options.error(f"no figure '{name}'; allowed: {', '.join(FAMILIES)}")
    chosen = [FAMILIES[name] for name in given.names or FAMILIES]
    start = time.monotonic()
    rows, failures = [], []
    try:
        if any(family.name == "droplet" for family in chosen):
            need_display("tools/figures.py")
        os.makedirs(given.output, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            futures = [(family, perform(family, given.quick, given, pool)) for family in chosen]
            for family, of_family in futures:
                outcomes = {name: future.result() for name, future in of_family.items()}
                results = Results(os.path.join(given.output, "runs"), outcomes, given.output)
                rows += family.draw(results)
                failures += results.failures()
        text = table(rows, failures)
        with open(os.path.join(given.output, "figures.md"), "w") as out:
            out.write(text)
        if given.readme:
            into_gallery(given.output)
            into_readme("figures", text)
    except Failure as failure:
        sys.exit(f"figures: {failure}")
    print(text, end="")
    print(f"{(time.monotonic() - start) / 60:.1f} minutes; pictures: {given.output}")


if __name__ == "__main__":
    main()
