"""What tools/extremes tells of a run, and that nothing fails silently at the extreme values. Run by CTest."""
import csv
import math
import os
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools"))

from stability.axes import AXES, Axis  # noqa: E402
from stability.case import Grid  # noqa: E402
from stability.point import Point, compare_units, measure  # noqa: E402
from stability.report import ELEMENTS, ORDERS  # noqa: E402
from stability.strip import graded, leaning, shaken, strip_of  # noqa: E402

HISTORY = "step,time,dt,energy.gas,outflow.left.energy.gas\\n0,0,0,{first}\\n9,1,1,{last}"
DONE = "steps=9 time=1 mass_error={mass}"


def verdict_of(does, value=1.0, **options):
    """Of a program that does so with its output's folder."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "program")
        with open(program, "w") as out:
            out.write(f'#!/bin/sh\nmkdir -p "$5"\n{does}\n')
        os.chmod(program, stat.S_IRWXU)
        axis = Axis("axis", [value], lambda grid, order, value: "end_time = 1.0", [value], **options)
        point = measure(Point(axis, value, "triangles", 1), program, folder, 5)
        return point.verdict, point.words


def finishing(first="8,0", last="8,0", mass="0", columns=""):
    history = HISTORY.replace("energy.gas,", columns + "energy.gas,", 1).format(first=first, last=last)
    return f"printf '{history}\\n' > \"$5/history.csv\"; echo cobasis: {DONE.format(mass=mass)}"


class Verdicts(unittest.TestCase):
    def test_energy_that_left_through_a_boundary_is_not_lost(self):
        self.assertEqual(verdict_of(finishing(last="6,2"))[0], "finished")

    def test_what_is_lost_or_no_number_is_wrong(self):
        self.assertEqual(verdict_of(finishing(last="8.00001,0")), ("WRONG", "energy changes by 1.25e-06"))
        self.assertEqual(verdict_of(finishing(mass="1e-9")), ("WRONG", "mass changes by 1e-09"))
        self.assertEqual(verdict_of(finishing(last="nan,0")), ("WRONG", "not a number in the history"))
        self.assertEqual(verdict_of(finishing(mass="nan"))[0], "WRONG")

    def test_stops_need_a_reason(self):
        self.assertEqual(verdict_of("echo why >&2; exit 3"), ("stopped", "why"))
        self.assertEqual(verdict_of("echo why >&2; exit 2"), ("refused", "why"))
        self.assertEqual(verdict_of("exit 3")[0], "WRONG")
        self.assertEqual(verdict_of("echo why >&2; exit 4")[0], "WRONG")
        self.assertEqual(verdict_of("kill -SEGV $$")[0], "WRONG")

    def test_a_run_that_hangs_or_never_arrives_is_not_finished(self):
        self.assertEqual(verdict_of("exec sleep 60")[0], "WRONG")
        self.assertEqual(verdict_of(finishing().replace("time=1", "time=0.5"))[0], "crawls")

    def test_noise_that_grows_is_told_and_wrong_at_the_default_cfl_number(self):
        grown = finishing(first="1,8,0", last="2,8,0", columns="kinetic.gas,")
        self.assertEqual(verdict_of(grown, 1.2, grows=True), ("unstable", "kinetic energy grows 2 times"))
        self.assertEqual(verdict_of(grown, 0.8, grows=True)[0], "WRONG")
        self.assertEqual(verdict_of(grown, 1.2)[0], "finished")


class Units(unittest.TestCase):
    def verdicts(self, changes):
        """Of runs in other units, {unit: relative change of the mass}."""
        axis = next(axis for axis in AXES if axis.name == "unit of mass times")
        points = []
        for value, change in {1.0: 0.0, **changes}.items():
            last = {name: 3.0 * value for name in ("volume.a", "mass.a", "momentum.a.x", "energy.a")}
            last["volume.a"] = 3.0
            last["mass.a"] *= 1 + change
            points.append(Point(axis, value, "triangles", 1, "finished", last=last))
        compare_units(points)
        return [point.verdict for point in points[1:]]

    def test_powers_of_two_leave_every_bit(self):
        self.assertEqual(self.verdicts({2.0**30: 0.0, 2.0**-30: 1e-15}), ["finished", "WRONG"])

    def test_other_units_may_change_round_off_which_may_grow(self):
        exact = {2.0**30: 0.0}
        self.assertEqual(self.verdicts(exact | {1e9: 1e-12})[1], "finished")
        self.assertEqual(self.verdicts(exact | {1e9: 1e-8})[1], "sensitive")
        self.assertEqual(self.verdicts({2.0**30: 1e-15, 1e9: 1e-8})[1], "WRONG")

    def test_meshes_are_images_of_each_other_to_the_last_bit(self):
        for element in ELEMENTS:
            nodes = []
            for length in (1.0, 2.0**-30):
                text = strip_of(element, 6, 2, length)
                lines = text.split("$Nodes\n")[1].split("\n$EndNodes")[0].split("\n")[1:]
                nodes.append([[float(x) / length for x in line.split()[1:]] for line in lines])
            self.assertEqual(*nodes)


class Strips(unittest.TestCase):
    """Of corners at (x, y) in cells, that are moved."""

    def corners(self, place, n=16, across=4):
        return {(x, y): place(x, y) for x in range(n + 1) for y in range(across + 1)}

    def test_rows_lean_with_the_angle(self):
        at = self.corners(leaning(1.0))
        for y in range(4):
            (a, low), (b, high) = at[3, y], at[3, y + 1]
            self.assertAlmostEqual(math.degrees(math.atan2(high - low, abs(b - a))), 1.0)
        self.assertEqual(self.corners(leaning(90.0))[3, 1], (3, 1))

    def test_neighbours_differ_by_the_factor_and_the_middle_stays(self):
        x = [self.corners(graded(16, 100.0))[i, 0][0] for i in range(17)]
        lengths = [b - a for a, b in zip(x, x[1:])]
        self.assertAlmostEqual(max(b / a for a, b in zip(lengths, lengths[1:])), 100.0)
        self.assertAlmostEqual((x[7] + x[9]) / 2, 8.0)

    def test_only_corners_inside_are_moved(self):
        at = self.corners(shaken([16, 4], 0.3))
        for (i, j), (x, y) in at.items():
            self.assertEqual(x == i, i in (0, 16))
            self.assertEqual(y == j, j in (0, 4))
            self.assertLessEqual(max(abs(x - i), abs(y - j)), 0.3)

    def test_hexahedra_have_every_face_twice_or_on_the_boundary(self):
        text = strip_of("hexahedra", 3, 2, 1.0)
        types = [line.split()[1] for line in text.split("$Elements\n")[1].split("\n")[1:-1] if line[0].isdigit()]
        self.assertEqual(types.count("5"), 12)
        self.assertEqual(types.count("3"), 2 * (3 * 2 + 3 * 2 + 2 * 2))


class Tool(unittest.TestCase):
    program = os.environ.get("COBASIS_PROGRAM")

    def run_tool(self, *arguments):
        command = [sys.executable, os.path.join(ROOT, "tools/extremes.py"), "--program", self.program or "none"]
        return subprocess.run(command + list(arguments), capture_output=True, text=True)

    def test_an_unknown_axis_is_refused_with_those_there_are(self):
        done = self.run_tool("viscosity")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no axis 'viscosity'; allowed: parts of: density ratio of gases; impact", done.stderr)

    def test_names_of_points_are_different(self):
        names = [Point(axis, value, "triangles", 1).name() for axis in AXES for value in axis.values]
        self.assertEqual(len(set(names)), len(names))

    def test_all_extreme_values_are_among_the_values(self):
        for axis in AXES:
            self.assertLessEqual(set(axis.quick), set(axis.values), axis.name)
            for value in axis.values:
                self.assertIn("end_time", axis.text(Grid("tetrahedra"), 2, value))

    @unittest.skipUnless(program, "needs COBASIS_PROGRAM")
    def test_at_the_extreme_values_nothing_fails_silently(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_tool("--quick", "--output", folder)
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
            with open(os.path.join(folder, "extremes.png"), "rb") as picture:
                self.assertTrue(picture.read().startswith(b"\x89PNG"))
            with open(os.path.join(folder, "extremes.csv"), newline="") as table:
                rows = list(csv.DictReader(table))
            self.assertEqual(len(rows), len(ELEMENTS) * len(ORDERS) * sum(len(axis.quick) for axis in AXES))
            finished = sum(row["class"] == "finished" for row in rows)
            self.assertGreater(finished, 0.9 * len(rows))


if __name__ == "__main__":
    unittest.main()
