"""From markers to geometry for the rasteriser, in the frame of the picture."""

import numpy
from raster import linear, unit


def of_triangles(points, colours):
    """A triangle list with a colour for each corner; equal corners are merged so that the surface is shaded smoothly."""
    merged, index = numpy.unique(numpy.round(points, 9), axis=0, return_inverse=True)
    index = index.reshape(-1)
    triangles = index.reshape(-1, 3)
    a, b, c = (merged[triangles[:, corner]] for corner in range(3))
    faces = numpy.cross(b - a, c - a)
    normals = numpy.zeros_like(merged)
    for corner in range(3):
        numpy.add.at(normals, triangles[:, corner], faces)
    merged_colours = numpy.zeros((len(merged), 3))
    merged_colours[index] = linear(colours)
    return {"points": merged, "normals": unit(normals), "colours": merged_colours, "triangles": triangles}


def of_spheres(centres, radius, colour):
    """Equal spheres."""
    return {"points": centres, "radius": radius, "colours": numpy.tile(linear(colour), (len(centres), 1))}


def of_tube(start, end, radii, colour, sides=12):
    """A tube, or a cone when the two radii differ. The ends are open."""
    axis = unit(end - start)
    across = unit(numpy.cross(axis, [1.0, 0, 0] if abs(axis[0]) < 0.8 else [0, 1.0, 0]))
    around = numpy.linspace(0, 2 * numpy.pi, sides, endpoint=False)[:, None]
    spokes = numpy.cos(around) * across + numpy.sin(around) * numpy.cross(axis, across)
    slope = (radii[0] - radii[1]) / max(numpy.linalg.norm(end - start), 1e-12)
    normals = unit(spokes + slope * axis)
    rows = numpy.stack([start + radii[0] * spokes, end + radii[1] * spokes])
    return lattice(rows, numpy.stack([normals, normals]), colour)


def of_arrow(start, end, shaft, head, head_length, colour):
    """Diameters of shaft and head as in an ARROW marker."""
    neck = end - unit(end - start) * head_length
    return [
        of_tube(start, neck, (shaft / 2, shaft / 2), colour, 24),
        of_tube(neck, neck + (end - neck) * 1e-3, (0, head / 2), colour, 24),
        of_tube(neck, end, (head / 2, 0), colour, 24),
    ]


def lattice(points, normals, colour):
    """Rows of points that close around; neighbouring rows are joined."""
    rows, columns = points.shape[:2]
    here = numpy.arange(columns)
    right = (here + 1) % columns
    triangles = []
    for row in range(rows - 1):
        low, high = row * columns, (row + 1) * columns
        triangles.append(numpy.stack([low + here, low + right, high + here], 1))
        triangles.append(numpy.stack([low + right, high + right, high + here], 1))
    return {
        "points": points.reshape(-1, 3),
        "normals": normals.reshape(-1, 3),
        "colours": numpy.tile(linear(colour), (rows * columns, 1)),
        "triangles": numpy.concatenate(triangles),
    }
