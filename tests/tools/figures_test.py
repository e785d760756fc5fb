"""What the tools for pictures compute. Run by CTest."""
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools"))

from common.contour import circulation  # noqa: E402
from common.exact import exact_in_tube  # noqa: E402
from gallery.long import measure_swings  # noqa: E402
from gallery.plate import crossings, schlieren  # noqa: E402


def squares(n):
    """Corners of n by n cells of the unit square."""
    x, y = (numpy.ravel(a) / n for a in numpy.meshgrid(numpy.arange(n), numpy.arange(n)))
    corners = [numpy.stack([x + dx / n, y + dy / n], axis=1) for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return numpy.stack(corners, axis=1)


def triangles(n):
    """The same squares, each cut along a diagonal; the last corner twice."""
    corners = squares(n)
    return numpy.concatenate([corners[:, [0, 1, 2, 2]], corners[:, [0, 2, 3, 3]]])


def turned_square(side, angle):
    turn = angle + math.pi / 2 * numpy.arange(4)
    return 0.5 + side / math.sqrt(2) * numpy.stack([numpy.cos(turn), numpy.sin(turn)], axis=1)


class Circulation(unittest.TestCase):
    def test_a_uniform_vector_has_none_on_any_mesh_and_contour(self):
        for cells in (squares(7), triangles(7)):
            vector = numpy.full((len(cells), 2), 3.0)
            for angle in (0.0, 0.3, math.pi / 4, 1.2):
                self.assertAlmostEqual(circulation(cells, vector, turned_square(0.6, angle)), 0, delta=1e-14)

    def test_a_jump_across_a_face_counts_by_the_exact_length_on_each_side(self):
        cells = squares(4)
        vector = numpy.zeros((len(cells), 2))
        vector[cells.mean(axis=1)[:, 0] > 0.5, 1] = 1.0  # e = (0, H(x - 0.5))
        contour = numpy.array([[0.1, 0.2], [0.9, 0.2], [0.9, 0.83], [0.1, 0.83]])
        self.assertAlmostEqual(circulation(cells, vector, contour), 0.63, delta=1e-14)

    def test_along_faces_it_takes_the_mean_of_both_cells_and_at_the_edge_the_one(self):
        cells = squares(2)
        vector = numpy.zeros((len(cells), 2))
        vector[cells.mean(axis=1)[:, 1] < 0.5, 0] = 1.0
        lower_half = numpy.array([[0, 0], [1, 0], [1, 0.5], [0, 0.5]], float)
        self.assertAlmostEqual(circulation(cells, vector, lower_half), 1 - 0.5, delta=1e-12)

    def test_a_rotation_gives_twice_the_area_up_to_the_size_of_cells(self):
        errors = []
        for n in (20, 40):
            cells = triangles(n)
            centre = cells[:, :3].mean(axis=1)
            vector = numpy.stack([-centre[:, 1], centre[:, 0]], axis=1)
            errors.append(abs(circulation(cells, vector, turned_square(0.6, 0.4)) - 2 * 0.36))
        self.assertLess(errors[0], 1e-2)
        self.assertLess(errors[1], errors[0])


class Curves(unittest.TestCase):
    def test_crossings_lie_where_the_line_between_two_values_does(self):
        found = crossings(numpy.array([0.0, 1.0, 2.0, 3.0]), numpy.array([3.0, 1.0, -3.0, 1.0]))
        numpy.testing.assert_allclose(found, [1.25, 2.75])

    def test_uniform_density_is_white_and_a_jump_dark(self):
        density = numpy.ones((20, 20))
        self.assertTrue((schlieren(density, 1e-3) == 1).all())
        density[:, 10:] = 1.2
        self.assertLess(schlieren(density, 1e-3).min(), 0.1)

    def test_exact_profiles_are_constant_between_their_waves(self):
        at = exact_in_tube("impact")(numpy.array([0.1, 0.3, 0.6, 0.9]))
        numpy.testing.assert_allclose(at["velocity.x"], [400, 239.55489884514304, 239.55489884514304, -200])


class Swings(unittest.TestCase):
    def test_a_swing_that_fades_has_its_period_and_loses_its_part_of_the_amplitude(self):
        time = numpy.linspace(0, 10, 20001)
        value = numpy.exp(-0.1 * time) * numpy.cos(math.pi * time)  # period 2
        value += 0.01 * numpy.sin(40 * math.pi * time)  # changes its sign some times at every end
        periods, loss = measure_swings(time, value, value**2, 0.3)
        self.assertEqual(len(periods), 8)
        for period in periods:
            self.assertAlmostEqual(period, 2, delta=0.01)
        self.assertAlmostEqual(loss, 1 - math.exp(-0.2), delta=0.01)


class Tool(unittest.TestCase):
    program = os.environ.get("COBASIS_PROGRAM")

    def run_tool(self, *arguments):
        command = [sys.executable, os.path.join(ROOT, "tools/figures.py"), "--program", self.program or "none"]
        return subprocess.run(command + list(arguments), capture_output=True, text=True)

    def test_an_unknown_figure_is_refused_with_those_there_are(self):
        done = self.run_tool("slidng")
        self.assertEqual(done.returncode, 2)
        allowed = "advection, impact, shear, sliding, plate, droplet, disc"
        self.assertIn(f"no figure 'slidng'; allowed: {allowed}", done.stderr)

    @unittest.skipUnless(program, "needs COBASIS_PROGRAM")
    def test_a_figure_is_computed_drawn_and_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_tool("sliding", "--quick", "--output", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(os.path.join(folder, "sliding.png"), "rb") as picture:
                self.assertTrue(picture.read().startswith(b"\x89PNG"))
            with open(os.path.join(folder, "figures.md")) as table:
                self.assertIn("| 100.000000 | 100 |", table.read())

    @unittest.skipUnless(program, "needs COBASIS_PROGRAM")
    def test_a_run_that_fails_is_told_in_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_tool("sliding", "--quick", "--limit", "1e-3", "--output", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("1 run stopped:\n\n- sliding: exit status 124: stopped after 0.001 s", done.stdout)


if __name__ == "__main__":
    unittest.main()
