"""Tetrahedra inside a triangle surface (TetGen), the surface kept as it is."""

import numpy as np
import tetgen

from surface import Surface


def fill(surface: Surface, inner: Surface | None = None, ratio: float = 1.2, dihedral: float = 10.0):
    """Nodes (N, 3), the first V being the surface's vertices, and tetrahedra (T, 4) of positive volume.

    `inner`: a closed surface inside the body that the elements follow; its vertices come after the surface's. `ratio` is
    the largest circumradius over shortest edge, `dihedral` the smallest dihedral angle in degrees (both are aims: where
    the given surface does not allow them, TetGen keeps the surface)."""
    vertices, faces = surface.vertices, surface.faces
    if inner is not None:
        faces = np.vstack([faces, inner.faces + len(vertices)])
        vertices = np.vstack([vertices, inner.vertices])
    # Points nearer than `T` times the body's size are one to TetGen; which value it gets along with differs.
    for tolerance in (1e-10, 1e-8, 1e-12, 1e-14):
        try:
            generator = tetgen.TetGen(vertices, faces.astype(np.int32))
            nodes, tets = generator.tetrahedralize(
                quality=True, nobisect=True, minratio=ratio, mindihedral=dihedral, epsilon=tolerance, steinerleft=-1
            )[:2]
            break
        except RuntimeError as error:
            failure = error
    else:
        raise failure
    if not np.array_equal(nodes[: len(vertices)], vertices):
        raise RuntimeError("TetGen moved or renumbered the vertices of the surface")
    return nodes, positive(nodes, tets)


def volumes(nodes: np.ndarray, tets: np.ndarray) -> np.ndarray:
    p = nodes[tets]
    return np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6


def positive(nodes: np.ndarray, tets: np.ndarray) -> np.ndarray:
    tets = np.array(tets, dtype=np.int64)
    wrong = volumes(nodes, tets) < 0
    tets[wrong] = tets[wrong][:, [0, 1, 3, 2]]
    return tets


def smallest_dihedral(nodes: np.ndarray, tets: np.ndarray) -> np.ndarray:
    """Smallest dihedral angle of each tetrahedron in degrees."""
    p = nodes[tets]
    normals = []
    for face in ((1, 3, 2), (0, 2, 3), (0, 3, 1), (0, 1, 2)):
        a, b, c = (p[:, k] for k in face)
        n = np.cross(b - a, c - a)
        normals.append(n / np.linalg.norm(n, axis=1)[:, None])
    cosines = [-(normals[i] * normals[j]).sum(1) for i in range(4) for j in range(i)]
    return np.degrees(np.arccos(np.clip(np.max(cosines, axis=0), -1, 1)))
