"""Tables that tools put between markers of cases/README.md."""
import os

from common.results import ROOT, Failure

README = os.path.join(ROOT, "cases/README.md")


def into_readme(name, text):
    """Between <!-- name: begin --> and <!-- name: end -->."""
    markers = [f"<!-- {name}: {word} -->" for word in ("begin", "end")]
    with open(README) as lines:
        readme = lines.read()
    begin, end = (readme.find(marker) for marker in markers)
    if min(begin, end) < 0 or begin > end:
        raise Failure(f"{README}: has no '{markers[0]}' followed by '{markers[1]}'")
    with open(README, "w") as out:
        out.write(readme[: begin + len(markers[0])] + "\n" + text + readme[end:])
