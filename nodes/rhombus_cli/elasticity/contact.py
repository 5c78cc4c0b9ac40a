"""Rigid flat discs pressed on a body without friction, one unit of depth each."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from elasticity import Factor, Model
from surface import Disc, Surface, tangents


@dataclass
class Answer:
    """Response to unit depth: displacement of all nodes (N, 3), m per m, and the force on the hand of each patch along its
    normal, N per m of depth."""

    displacement: np.ndarray
    stiffness: np.ndarray


def surface_nodes(model: Model, surface: Surface) -> np.ndarray:
    """Nodes on each face: its corners and the middles of its edges, (T, 6)."""
    count = len(model.nodes)
    key = np.sort(model.edges, axis=1).astype(np.int64)
    key = key[:, 0] * count + key[:, 1]
    order = key.argsort()
    sides = np.stack([surface.faces, np.roll(surface.faces, -1, axis=1)], axis=2)
    sides.sort(axis=2)
    wanted = sides[:, :, 0] * count + sides[:, :, 1]
    found = order[np.searchsorted(key[order], wanted).clip(max=len(key) - 1)]
    if not np.array_equal(key[found], wanted):
        raise RuntimeError("an edge of the surface is not an edge of a tetrahedron")
    return np.hstack([surface.faces, count - len(model.edges) + found])


def fixed_nodes(faces6: np.ndarray, parent_faces: np.ndarray, base: np.ndarray) -> np.ndarray:
    """Nodes held: base vertices of the undivided surface, and everything on faces whose corners are all base vertices."""
    held = base[parent_faces].all(axis=1)
    return np.unique(np.concatenate([faces6[held].ravel(), np.flatnonzero(base)]))


def touched_nodes(model: Model, surface: Surface, faces6: np.ndarray, disc: Disc) -> np.ndarray:
    """Nodes of the near side within the disc (see Disc)."""
    towards = surface.face_normals() @ disc.normal > 0
    nodes = np.unique(faces6[towards])
    rho, height = disc.polar(model.nodes[nodes])
    return nodes[(rho <= disc.radius * (1 + 1e-9)) & (height >= -disc.radius)]


class Patches:
    """Factor once, press often: for each patch a normal and the nodes that may be touched there (patches are disjoint)."""

    def __init__(self, model: Model, fixed: np.ndarray, normals: list[np.ndarray], nodes: list[np.ndarray]):
        self._nodes = np.concatenate(nodes)
        if len(np.unique(self._nodes)) != len(self._nodes):
            raise ValueError("two discs touch the same place")
        self._patch = np.repeat(np.arange(len(nodes)), [len(n) for n in nodes])
        frames = np.concatenate([np.broadcast_to(frame(m), (len(n), 3, 3)) for m, n in zip(normals, nodes)])
        self._factor = Factor(model, fixed, self._nodes, frames, self._nodes)

    def press(self, touched: np.ndarray, depth: np.ndarray | None = None) -> Answer:
        """u . normal = -depth (1 if not given) on the touched nodes, tangentially free; the patches' other nodes carry no
        force."""
        forces = self._forces(touched, depth)
        return Answer(self._factor.displacement(forces), self._stiffness(forces))

    def press_each(self, touched: list[np.ndarray]) -> list[Answer]:
        """Unit depth, one set of touched nodes at a time."""
        forces = np.array([self._forces(nodes) for nodes in touched])
        moved = self._factor.displacements(forces)
        return [Answer(u, self._stiffness(f)) for u, f in zip(moved, forces)]

    def _forces(self, touched: np.ndarray, depth: np.ndarray | None = None) -> np.ndarray:
        """What pushes the body along the normals of the patches' nodes, N."""
        order = np.argsort(touched)
        on = np.isin(self._nodes, touched)
        if on.sum() != len(touched):
            raise ValueError("a touched node belongs to no patch")
        depths = np.ones(len(self._nodes))
        if depth is not None:
            depths[on] = depth[order][np.searchsorted(touched[order], self._nodes[on])]
        schur = self._factor.schur
        condensed = schur[np.ix_(on, on)]
        if not on.all():
            condensed = condensed - schur[np.ix_(on, ~on)] @ scipy.linalg.solve(
                schur[np.ix_(~on, ~on)], schur[np.ix_(~on, on)], assume_a="pos"
            )
        forces = np.zeros(len(on))
        forces[on] = -condensed @ depths[on]
        return forces

    def _stiffness(self, forces: np.ndarray) -> np.ndarray:
        # The hand feels the opposite of what pushes the body, and positive pushes it out.
        return -np.bincount(self._patch, weights=forces)

    def under(self, forces: np.ndarray) -> np.ndarray:
        """Displacement (N, 3) under given forces (N, along the normals) on the nodes of the patches."""
        return self._factor.displacement(forces)

    def close(self) -> None:
        self._factor.close()


def frame(normal: np.ndarray) -> np.ndarray:
    """Rows: the normal and two tangents."""
    return np.stack([normal, *tangents(normal)])
