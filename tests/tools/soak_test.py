"""What tools/soak takes for a find, and that it repeats its scenes. Run by CTest."""
import os
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HISTORY = "step,time,dt,energy.gas\\n0,0,0,{first}\\n9,1,1,{last}"


def finishing(first="8", last="8", mass="0"):
    history = HISTORY.format(first=first, last=last)
    return f"printf '{history}\\n' > \"$5/history.csv\"; echo cobasis: steps=9 time=1 mass_error={mass}"


class Soak(unittest.TestCase):
    program = os.environ.get("COBASIS_PROGRAM")

    def run_tool(self, program, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, os.path.join(ROOT, "tools/soak"), "--program", program, "--output", folder]
            command += ["--only", "scenes", "--minutes", "0", *arguments]
            return subprocess.run(command, capture_output=True, text=True)

    def found(self, does):
        """Of a program whose first rank does so with its output's folder: exit status and what the tool says."""
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "program")
            with open(program, "w") as out:
                out.write(f'#!/bin/sh\n[ "${{OMPI_COMM_WORLD_RANK:-0}}" = 0 ] || exit 0\nmkdir -p "$5"\n{does}\n')
            os.chmod(program, stat.S_IRWXU)
            done = self.run_tool(program, "--scenes", "1", "--seed", "4")
            return done.returncode, done.stdout + done.stderr

    def test_a_run_that_finishes_or_stops_with_a_reason_is_no_find(self):
        code, said = self.found(finishing())
        self.assertEqual(code, 0, said)
        code, said = self.found(finishing() + "; echo why >&2; exit 3")
        self.assertEqual(code, 0, said)
        self.assertIn("1 scenes (1 stopped with a reason): nothing found", said)

    def test_what_is_lost_or_no_number_or_ends_without_a_reason_is(self):
        for does, what in {finishing(last="nan"): "not a number in the history",
                           finishing(mass="1e-9"): "mass changes by 1e-9",
                           "exit 3": "exit status 3: no reason told",
                           "echo why >&2; exit 4": "exit status 4: why",
                           "kill -SEGV $$": "exit status -11: no reason told"}.items():
            code, said = self.found(does)
            self.assertEqual(code, 1, does)
            self.assertIn(f"soak: seed 4: {what}\n  ", said)
            self.assertIn("--set cfl=", said)

    def test_what_differs_on_several_ranks_is(self):
        code, said = self.found(finishing() + '; echo "$OMPI_COMM_WORLD_SIZE" > "$5/a.csv"')
        self.assertEqual(code, 1, said)
        self.assertRegex(said, "seed 4: on [23] ranks other than on one: a.csv\n  mpirun ")

    @unittest.skipUnless(program, "needs COBASIS_PROGRAM")
    def test_of_the_program_nothing_is_found_in_a_few_scenes(self):
        done = self.run_tool(self.program, "--scenes", "3", "--seed", "1")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("nothing found", done.stdout)


if __name__ == "__main__":
    unittest.main()
