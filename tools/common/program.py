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


def command_of(program, case, directory, settings, ranks=1, restart=False):
    """Of a case of cases/."""
    command = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    command += [program, "run", os.path.join(ROOT, "cases", case + ".toml"), "--quiet", "--output", directory]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    return command + (["--restart"] if restart else [])


def run_case(program, case, directory, settings, limit, ranks=1, restart=False):
    """What was in the directory goes, unless the run goes on from there."""
    if not restart:
        shutil.rmtree(directory, ignore_errors=True)
    command = command_of(program, case, directory, settings, ranks, restart)
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    run = subprocess.Popen(command, text=True, env=environment, stdin=subprocess.DEVNULL,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip
    try:
        out, err = run.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        run.kill() if ranks == 1 else run.terminate()  # on SIGTERM mpirun ends its ranks, which may hang
        run.communicate()
        return Outcome(124, f"stopped after {limit} s", {})
    summary = dict(re.findall(r"(\w+)=(\S+)", out.splitlines()[-1])) if out.strip() else {}
    said = err.split("-" * 60)[0].strip().splitlines()  # what mpirun adds is between lines
    return Outcome(run.returncode, (said or [""])[-1] if run.returncode else "", summary)
