"""Exact solutions of the tests in tubes, from the tables of constant states in tests/verification/reference."""
import os

import numpy

from common.results import REFERENCE, columns

# A field of the results: the column of a table.
FIELDS = {
    "density": "density",
    "velocity.x": "velocity",
    "velocity.y": "tangential_velocity",
    "pressure": "pressure",
    "stress.xx": "stress_xx",
    "stress.xy": "stress_xy",
}


def exact_in_tube(case):
    """x along the tube -> {field: values}, of the mixture."""
    table = columns(os.path.join(REFERENCE, case + ".csv"))

    def at(x):
        state = numpy.searchsorted(table["to"], x)
        return {field: table[column][state] for field, column in FIELDS.items() if column in table}

    return at


def contact_in_tube(case):
    """Where the first phase ends, at the end of the case."""
    return {"advection": 0.7, "impact": 0.5119777449422571, "sliding": 0.52}[case]
