"""What tools/analyse refuses before it installs or builds anything. Run by CTest."""
import os
import subprocess
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def run_tool(name, *arguments):
    return subprocess.run([os.path.join(ROOT, "tools", name), *arguments], capture_output=True, text=True)


class Options(unittest.TestCase):
    def test_mistakes_are_refused_with_what_is_allowed(self):
        for arguments, said in {("--only", "spelling"): "--only 'spelling'; allowed: warnings sanitizers tidy",
                                ("--only",): "--only ''; allowed: warnings sanitizers tidy",
                                ("--fast",): "no option '--fast'; allowed: --only, --quick, --help",
                                ("--only", "tidy", "--quick"): "--quick is for sanitizers"}.items():
            done = run_tool("analyse", *arguments)
            self.assertEqual((done.returncode, done.stderr.strip()), (2, f"tools/analyse: {said}"))

    def test_help_names_every_stage(self):
        done = run_tool("analyse", "--help")
        self.assertEqual(done.returncode, 0)
        for stage in ("warnings", "sanitizers", "tidy", "--quick"):
            self.assertIn(stage, done.stdout)

    def test_setup_refuses_what_it_does_not_know(self):
        done = run_tool("setup", "--analyze")
        self.assertEqual((done.returncode, done.stderr.strip()),
                         (2, "tools/setup: no option '--analyze'; allowed: --analyse"))


if __name__ == "__main__":
    unittest.main()
