#!/usr/bin/python3
"""Measures what accuracy costs: error against seconds of one core, by scheme, mesh and element.

Runs every entry of CASES in tradeoff_cases.py and leaves tradeoff.csv (a row per run; of a failed one its exit status
and last words), tradeoff.md, and a picture per case, in which the runs that no other run beats in both error and time
are joined. The error of a run is the mean over its case's quantities. Times are the solver's steps alone, on one rank.
Runs follow one another; two at a time (--jobs 2) are done sooner but share caches and memory, and time is what is
measured.
"""
import argparse
import concurrent.futures
import csv
import dataclasses
import math
import os
import re
import shutil
import sys
import time

import numpy

from common.program import run_case
from common.readme import into_readme
from common.results import ROOT, Failure
from tradeoff_cases import CASES, QUICK

ROUND_OFF = 2.0**-53  # no smaller error counts as smaller


@dataclasses.dataclass
class Run:
    case: str
    scheme: str
    element: str
    size: float
    keys: dict
    exit: int = None
    seconds: float = math.nan
    cells: int = 0
    steps: int = 0
    error: float = math.nan
    errors: dict = dataclasses.field(default_factory=dict)
    words: str = ""

    def good(self):
        return self.exit == 0 and math.isfinite(self.error) and self.seconds > 0

    def order(self):
        return 1 if self.scheme.startswith("order 1") else 2

    def label(self):
        return f"{self.size:g} {self.element[:3]}"


def perform(run, program, scratch, limit):
    """Runs the case and fills in what came of it."""
    name = f"{run.case} {run.scheme} {run.element} {run.size}"
    directory = os.path.join(scratch, re.sub(r"[^a-z0-9.]+", "_", name.lower()))
    settings = run.keys | {"output.count": "1", "output.precision": '"float64"'}
    outcome = run_case(program, run.case, directory, settings, limit)
    run.exit, summary = outcome.exit, outcome.summary
    if run.exit == 0:
        try:
            run.seconds, run.cells, run.steps = (
                float(summary["seconds"]),
                int(summary["cells"]),
                int(summary["steps"]),
            )
            run.errors = CASES[run.case].errors(directory)
            run.error = float(numpy.mean(list(run.errors.values())))
            if math.isfinite(run.error):
                run.error = max(run.error, ROUND_OFF)
            else:
                run.words = "the error is not a number"
        except (Failure, KeyError, OSError, ValueError) as error:
            run.words = f"no error measured: {error!r}"
    else:
        run.words = outcome.words
    shutil.rmtree(directory, ignore_errors=True)
    return run


COLUMNS = ["case", "scheme", "element", "size", "cells", "steps", "seconds", "exit", "error", "errors", "keys", "words"]


def write(runs, file):
    with open(file, "w", newline="") as lines:
        table = csv.writer(lines)
        table.writerow(COLUMNS)
        for run in runs:
            errors = " ".join(f"{name}={value:.6g}" for name, value in run.errors.items())
            keys = " ".join(f"{key}={value}" for key, value in run.keys.items())
            row = [run.case, run.scheme, run.element, run.size, run.cells, run.steps, run.seconds]
            table.writerow(row + [run.exit, run.error, errors, keys, run.words])


def read(file):
    runs = []
    try:
        with open(file, newline="") as lines:
            for row in csv.DictReader(lines):
                errors = {name: float(value) for name, value in re.findall(r"(\S+)=(\S+)", row["errors"])}
                run = Run(row["case"], row["scheme"], row["element"], float(row["size"]), {})
                run.exit, run.cells, run.steps = int(row["exit"]), int(row["cells"]), int(row["steps"])
                run.seconds, run.error, run.errors = float(row["seconds"]), float(row["error"]), errors
                run.words = row["words"]
                runs.append(run)
    except (OSError, KeyError, ValueError) as error:
        raise Failure(f"{file}: {error!r}") from None
    return runs


def front(runs):
    """Those that no other run beats in both error and time, by time."""
    best, chosen = math.inf, []
    for run in sorted((run for run in runs if run.good()), key=lambda run: (run.seconds, run.error)):
        if run.error < best:
            best = run.error
            chosen.append(run)
    return chosen


def draw(case, runs, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plot

    figure, axis = plot.subplots(figsize=(9, 6.5))
    schemes, elements = list(CASES[case].schemes), list(CASES[case].elements)
    palette = plot.get_cmap("tab10" if len(schemes) <= 10 else "tab20")
    for s, scheme in enumerate(schemes):
        for element, marker in zip(elements, "s^Dv"):
            points = [run for run in runs if run.good() and (run.scheme, run.element) == (scheme, element)]
            axis.plot(
                [run.seconds for run in points], [run.error for run in points],
                color=palette(s), marker=marker, markersize=5, linewidth=0.8, alpha=0.8,
            )
        axis.plot([], [], color=palette(s), linewidth=3, label=scheme)
    for element, marker in zip(elements, "s^Dv"):
        axis.plot([], [], color="grey", marker=marker, linestyle="none", label=element)
    best = front(runs)
    axis.plot(
        [run.seconds for run in best], [run.error for run in best], color="black", linestyle="--", marker="o",
        markersize=11, markerfacecolor="none", linewidth=1.2, label="front",
    )
    for run in best:
        axis.annotate(run.label(), (run.seconds, run.error), xytext=(7, 7), textcoords="offset points", fontsize=7)
    if best:
        axis.set_xscale("log")
        axis.set_yscale("log")
    axis.set_xlabel("seconds of one core")
    axis.set_ylabel("error")
    failed = sum(not run.good() for run in runs)
    axis.set_title(f"{case}: {len(runs)} runs" + (f", {failed} failed (not shown)" if failed else ""), fontsize=10)
    axis.grid(which="both", alpha=0.25)
    axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)
    plot.close(figure)


def where_it_stopped(words):
    """The step and the phase of a run that turned unphysical; else what it said."""
    stopped = re.search(r"stopped: (step \d+), .*?(phase '\w+')", words)
    return f"{stopped[1]}, {stopped[2]}" if stopped else words


def table(runs):
    """Markdown: the runs on each case's front, and the ones that failed."""
    lines = ["| case | error | core seconds | scheme | mesh | same error with order 1 |", "|---|---|---|---|---|---|"]
    for case in CASES:
        of_case = [run for run in runs if run.case == case]
        plain = front([run for run in of_case if run.order() == 1])
        for run in front(of_case):
            first = next((other for other in plain if other.error <= run.error), None)
            if first is None:
                cost = f"not by {plain[-1].seconds:.3g} s ({100 * plain[-1].error:.3g} %)" if plain else "—"
            else:
                cost = "itself" if first is run else f"{first.seconds:.3g} s, {first.seconds / run.seconds:.2g} times"
            mesh = f"{CASES[case].unit} = {run.size:g}{' mm' if CASES[case].unit == 'h' else ''}, {run.element}"
            lines.append(f"| {case} | {100 * run.error:.3g} % | {run.seconds:.3g} | {run.scheme} | {mesh} | {cost} |")
    failed = [run for run in runs if not run.good()]
    lines += ["", f"{len(runs)} runs, {len(failed)} failed{':' if failed else '.'}"]
    if failed:
        lines.append("")
    lines += [
        f"- {run.case}, {run.scheme}, {run.label()}: exit status {run.exit}; {where_it_stopped(run.words)}"
        for run in failed
    ]
    return "\n".join(lines) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--program", default=os.path.join(ROOT, "build/release/cobasis"))
    options.add_argument("--output", default=os.path.join(ROOT, "out/tradeoff"), help="default: out/tradeoff")
    options.add_argument("--quick", action="store_true", help=f"only the {QUICK} coarsest meshes of each kind")
    options.add_argument("--only", action="append", choices=list(CASES), help="a case; can be given more than once")
    options.add_argument("--limit", type=float, default=600, help="seconds that a run may take (default: 600)")
    options.add_argument("--jobs", type=int, default=1, help="runs at a time; more than one disturbs the times")
    options.add_argument("--redraw", action="store_true", help="tables and pictures from an earlier tradeoff.csv")
    options.add_argument("--readme", action="store_true", help="put the table into cases/README.md too")
    given = options.parse_args()
    if given.jobs < 1:
        options.error(f"--jobs {given.jobs}; allowed: from 1")
    os.makedirs(given.output, exist_ok=True)
    sheet = os.path.join(given.output, "tradeoff.csv")
    chosen = given.only or list(CASES)
    try:
        if given.redraw:
            runs = [run for run in read(sheet) if run.case in chosen]
        else:
            runs = [
                Run(case, scheme, element, size, keys)
                for case in chosen
                for scheme, element, size, keys in CASES[case].runs()
                if not given.quick or size in CASES[case].sizes[element][:QUICK]
            ]
            start = time.monotonic()
            with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
                done = [pool.submit(perform, run, given.program, given.output, given.limit) for run in runs]
                for i, future in enumerate(done):
                    run = future.result()
                    result = f"{100 * run.error:.4g} % in {run.seconds:.3g} s"
                    if not run.good():
                        result = f"exit status {run.exit}; {run.words}"
                    print(f"{i + 1}/{len(runs)} {run.case}, {run.scheme}, {run.label()}: {result}", flush=True)
                    write(runs[: i + 1], sheet)
            print(f"{len(runs)} runs in {(time.monotonic() - start) / 60:.1f} minutes")
        for case in chosen:
            draw(case, [run for run in runs if run.case == case], os.path.join(given.output, case + ".png"))
        text = table(runs)
        with open(os.path.join(given.output, "tradeoff.md"), "w") as out:
            out.write(text)
        if given.readme:
            into_readme("tradeoff", text)
        print(text, end="")
    except Failure as failure:
        sys.exit(f"tradeoff: {failure}")


if __name__ == "__main__":
    main()
