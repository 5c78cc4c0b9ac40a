"""Where the liver is pressed: a fixed rule that looks at no result.

Candidates are the vertices at least 10 mm from the fixed base (the largest disc has 5 mm). They are taken in
farthest-point order from the top: each new site is the candidate farthest from all before it, so that any first part of
the list covers lobes, edges and tip evenly. Of the 48 sites every sixth (the 5th, 11th, ... 47th: eight sites) is held out
of every calibration.
"""

import numpy as np

import shared  # noqa: F401

from surface import Surface

CLEARANCE_M = 0.010
COUNT, EVERY, FIRST = 48, 6, 4


def base(surface: Surface) -> np.ndarray:
    """Vertices held fixed: a body's own choice where it has one (`held`), else the flat underside, normal z < -0.7. (V,) bool."""
    held = getattr(surface, "held", None)
    return surface.vertex_normals()[:, 2] < -0.7 if held is None else held


def candidates(surface: Surface) -> np.ndarray:
    """Vertices far enough from the base."""
    points = surface.vertices
    fixed = points[base(surface)]
    clearance = np.array([np.linalg.norm(fixed - p, axis=1).min() for p in points])
    return np.flatnonzero(clearance >= CLEARANCE_M)


def choose(surface: Surface, count: int) -> np.ndarray:
    """`count` vertices in farthest-point order, starting at the highest one."""
    points, allowed = surface.vertices, candidates(surface)
    chosen = [int(allowed[points[allowed, 2].argmax()])]
    distance = np.linalg.norm(points[allowed] - points[chosen[0]], axis=1)
    while len(chosen) < count:
        chosen.append(int(allowed[distance.argmax()]))
        distance = np.minimum(distance, np.linalg.norm(points[allowed] - points[chosen[-1]], axis=1))
    return np.array(chosen)


def held_out(count: int) -> np.ndarray:
    """(count,) bool."""
    return np.arange(count) % EVERY == FIRST
