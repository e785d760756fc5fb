"""ParaView itself opens what a run leaves. Skipped where there is no pvpython: Debian 12 does not install it (package
python3-paraview) beside python3-vtk9, which the pictures need. COBASIS_PVPYTHON names one. Run by CTest."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.environ.get("COBASIS_PROGRAM")
PVPYTHON = os.environ.get("COBASIS_PVPYTHON") or shutil.which("pvpython")

QUESTIONS = """
import json, sys
from paraview import simple
reader = simple.OpenDataFile(sys.argv[1])
times = list(reader.TimestepValues)
simple.UpdatePipeline(times[-1], reader)
cells = reader.CellData
arrays = {cells.GetArray(i).Name: cells.GetArray(i).GetNumberOfComponents() for i in range(cells.GetNumberOfArrays())}
line = simple.OpenDataFile(sys.argv[2])
line.UpdatePipeline()
print(json.dumps([times, arrays, cells.GetArray("alpha.copper").GetRange(), list(line.TimestepValues)]))
"""


@unittest.skipUnless(PROGRAM and PVPYTHON, "needs COBASIS_PROGRAM and pvpython")
class ParaView(unittest.TestCase):
    def test_a_run_opens_with_its_times_arrays_and_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            case = os.path.join(ROOT, "cases/sliding.toml")
            settings = ["mesh_parameters={ n = 50 }", "output.count=4"]
            subprocess.run([PROGRAM, "run", case, "--quiet", "--output", folder, "--set", *settings], check=True)
            script = os.path.join(folder, "questions.py")
            with open(script, "w") as file:
                file.write(QUESTIONS)
            files = [os.path.join(folder, name) for name in ("sliding.pvd", "axis.csv.series")]
            done = subprocess.run([PVPYTHON, script, *files], capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            times, arrays, alpha, of_line = json.loads(done.stdout.splitlines()[-1])
        for found in (times, of_line):
            self.assertEqual(len(found), 5)
            for i, time in enumerate(found):
                self.assertAlmostEqual(time, i * 25e-6, delta=1e-12)
        self.assertEqual(arrays["alpha.copper"], 1)
        self.assertEqual(arrays["velocity.aluminium"], 3)
        self.assertEqual(arrays["stress"], 6)
        self.assertEqual(alpha, [0, 1])


if __name__ == "__main__":
    unittest.main()
