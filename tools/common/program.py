"""Runs the program."""
import dataclasses
import os
import re
import shutil
import subprocess

from common.results import ROOT


@dataclasses.dataclass
class Outcome:
    exit: int
    words: str  # the last it said, of a run that failed
    summary: dict  # the numbers of its last line


def run_case(program, case, directory, settings, limit):
    """A case of cases/ on one rank; what was in the directory goes."""
    shutil.rmtree(directory, ignore_errors=True)
    command = [program, "run", os.path.join(ROOT, "cases", case + ".toml"), "--quiet", "--output", directory]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return Outcome(124, f"stopped after {limit} s", {})
    summary = dict(re.findall(r"(\w+)=(\S+)", done.stdout.splitlines()[-1])) if done.stdout.strip() else {}
    words = (done.stderr.strip().splitlines() or [""])[-1] if done.returncode else ""
    return Outcome(done.returncode, words, summary)
