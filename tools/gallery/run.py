"""What a family of figures needs to be computed, and what comes of it."""
import dataclasses
import os


@dataclasses.dataclass
class Run:
    """A case with settings; results in `name` below the folder of runs."""

    name: str
    case: str
    settings: dict = dataclasses.field(default_factory=dict)


@dataclasses.dataclass
class Row:
    """Of the table in cases/README.md."""

    quantity: str
    measured: str
    exact: str  # or of a reference; or what is demanded
    paper: str


class Results:
    """Of the runs of a family."""

    def __init__(self, folder, outcomes, pictures):
        self.folder = folder
        self.outcomes = outcomes  # {name of a run: Outcome}
        self.pictures = pictures

    def directory(self, name):
        return os.path.join(self.folder, name)

    def picture(self, name):
        return os.path.join(self.pictures, name + ".png")

    def good(self, name):
        return self.outcomes[name].exit == 0

    def failures(self):
        """[(run, exit status and last words, up to where it was)]"""
        words = {name: outcome.words.split(": volume fraction")[0] for name, outcome in self.outcomes.items()}
        return [(name, f"exit status {o.exit}: {words[name]}") for name, o in self.outcomes.items() if o.exit != 0]
