"""Pictures with axes, by matplotlib."""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot

from common.results import Failure


def new_figure(count, columns=2, width=4.0, height=2.5):
    """(figure, axes) of so many panels."""
    rows = math.ceil(count / columns)
    figure, axes = plot.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False)
    for axis in list(axes.flat)[count:]:
        axis.set_axis_off()
    chosen = list(axes.flat)[:count]
    for axis in chosen:
        axis.tick_params(labelsize=7)
        axis.ticklabel_format(useOffset=False)
        axis.grid(alpha=0.3)
    return figure, chosen


def save(figure, picture, below=None, dpi=110):
    """Writes the PNG whole or not at all."""
    if below:
        figure.supxlabel(below, fontsize=8)
    figure.tight_layout()
    try:
        figure.savefig(picture + ".part", dpi=dpi, format="png")
        os.replace(picture + ".part", picture)
    except OSError as error:
        raise Failure(error) from None
    plot.close(figure)
