"""Integrals along closed polygons through cells with constant values."""
import numpy


def circulation(corners, vector, polygon):
    """Of a vector field: corners (cells, k, 2) of convex cells, any repeated; vector (cells, 2); polygon (n, 2).
    Sums over its pieces in each cell. Where a side runs along faces it takes the mean of both cells, at the
    edge of the mesh the one cell."""
    return sum(_along(corners, vector, start, end) for start, end in zip(polygon, numpy.roll(polygon, -1, axis=0)))


def _along(corners, vector, start, end):
    length = numpy.linalg.norm(end - start)
    direction = (end - start) / length
    normal = numpy.array([-direction[1], direction[0]])
    beside = 1e-8 * length * normal
    reach = numpy.abs(corners - corners[:, :1]).max() * 2
    near = numpy.abs((corners[:, 0] - start) @ normal) < reach
    corners, vector = corners[near], vector[near]
    sums = [_sum_over_pieces(corners, vector, start + shift, direction, length) for shift in (beside, -beside)]
    covered = sum(part for _, part in sums)
    return sum(value for value, _ in sums) / covered * length


def _sum_over_pieces(corners, vector, start, direction, length):
    """(integral of vector · direction, length within cells) of the line from start."""
    normal = numpy.array([-direction[1], direction[0]])
    height = (corners - start) @ normal
    met = (height.min(axis=1) < 0) & (height.max(axis=1) > 0)
    height, along = height[met], (corners[met] - start) @ direction
    # The line enters and leaves a convex cell where its sides change the sign of the height.
    low, high = numpy.full(len(height), numpy.inf), numpy.full(len(height), -numpy.inf)
    for i in range(height.shape[1]):
        j = (i + 1) % height.shape[1]
        crosses = (height[:, i] < 0) != (height[:, j] < 0)
        h, g = height[crosses, i], height[crosses, j]
        x = (along[crosses, i] * g - along[crosses, j] * h) / (g - h)
        low[crosses] = numpy.minimum(low[crosses], x)
        high[crosses] = numpy.maximum(high[crosses], x)
    piece = numpy.clip(numpy.minimum(high, length) - numpy.maximum(low, 0), 0, None)
    return float(piece @ (vector[met] @ direction)), float(piece.sum())
