"""Tetrahedra inside a triangle surface (TetGen), the surface kept as it is."""

from pathlib import Path

import numpy as np
import tetgen

from surface import Surface


def fill(surface: Surface, ratio: float = 1.4, dihedral: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 3), the first V being the surface's vertices, and tetrahedra (T, 4) of positive volume.

    `ratio` is the largest circumradius over shortest edge, `dihedral` the smallest dihedral angle in degrees (both are
    aims: where the given surface does not allow them, TetGen keeps the surface)."""
    generator = tetgen.TetGen(surface.vertices, surface.faces.astype(np.int32))
    nodes, tets = generator.tetrahedralize(
        switches=f"pq{ratio}/{dihedral}YQ" if ratio else "pYQ", regionattrib=False
    )[:2]
    if not np.array_equal(nodes[: len(surface.vertices)], surface.vertices):
        raise RuntimeError("TetGen moved or renumbered the vertices of the surface")
    tets = positive(nodes, tets)
    return nodes, tets


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


def write_peers(surface: Surface, path: Path) -> None:
    """The coarse meshes the compared methods use: nodes, tets, fixed."""
    nodes, tets = fill(surface, ratio=1.8, dihedral=5.0)
    np.savez_compressed(
        path, nodes=nodes.astype("<f8"), tets=tets.astype("<i4"), fixed=surface.base().astype("u1")
    )
    angle = smallest_dihedral(nodes, tets)
    print(
        f"{path.name}: {len(surface.vertices)} surface and {len(nodes) - len(surface.vertices)} inner nodes, {len(tets)} "
        f"tetrahedra, smallest dihedral angle {angle.min():.1f} deg (1 % below {np.percentile(angle, 1):.1f} deg)"
    )
