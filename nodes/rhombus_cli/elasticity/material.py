"""What a body is made of: one material, or two by region."""

import numpy as np

from work import Refused


def young(job: dict, nodes: np.ndarray, tets: np.ndarray) -> np.ndarray:
    """Young's modulus of each tetrahedron, Pa: the second one where its centroid lies in that region."""
    second = job.get("second")
    if second is None:
        return np.full(len(tets), job["young_pa"])
    inside = within(second["region"], nodes[tets].mean(axis=1))
    if not inside.any():
        raise Refused("no part of the body lies in the region of the second material")
    return np.where(inside, second["young_pa"], job["young_pa"])


def within(region: dict, x: np.ndarray) -> np.ndarray:
    """Which points (n, 3) lie in a region: {"plane": [nx, ny, nz, d]} n.x <= d, {"box": [low, high]}, {"ball": [centre, radius]}."""
    ((kind, numbers),) = region.items()
    numbers = np.array(numbers, dtype=float)
    if kind == "plane":
        return x @ numbers[:3] <= numbers[3]
    if kind == "box":
        return ((x >= numbers[:3]) & (x <= numbers[3:])).all(axis=1)
    if kind == "ball":
        return np.linalg.norm(x - numbers[:3], axis=1) <= numbers[3]
    raise Refused(f"region {kind}; accepted: plane, box or ball")
