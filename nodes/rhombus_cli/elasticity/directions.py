"""The fields of a calibrated body's chains around one contact, as the product has them (nodes/rhombus_chain/src/response.rs),
and how their coefficients are carried over the surface.

A chain's coefficients at a vertex, `a_0 a_1 b_1 .. b_H`, `c_0 c_1 d_1 .. d_H`, `e_1 o_1 .. o_H` (2 + 6 H), count angles from the
first vector of the vertex's tangent frame. Frames at different vertices have nothing to do with one another, but the tensors behind
the coefficients have: a_0 is a number, (a_1, b_1) a tangent vector, (a_2, b_2) a symmetric tangent tensor without trace. As
such, in space, they can be compared and averaged."""

from dataclasses import dataclass

import numpy as np

# As in the product: where "away from the contact" loses its meaning because the surface turns away.
AWAY_FADES_BELOW = 0.2


def tangent_frames(normals: np.ndarray) -> np.ndarray:
    """(n, 2, 3): for each unit normal two vectors that make a right-handed frame with it: normal, first, second."""
    first = np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)])
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(normals, first)], axis=1)


@dataclass(frozen=True)
class Chains:
    """decays, reaches: (P,) m; harmonics: H, 0 to 2."""

    decays: tuple[float, ...]
    reaches: tuple[float, ...]
    harmonics: int

    @property
    def count(self) -> int:
        return len(self.decays)

    @property
    def per_chain(self) -> int:
        return 2 + 6 * self.harmonics

    def shapes(self, s: np.ndarray) -> np.ndarray:
        """g_p (P, n) at distances s (n), m."""
        decay, reach = (np.array(x)[:, None] for x in (self.decays, self.reaches))
        end = np.exp(-reach / decay)
        return np.where(s < reach, (np.exp(-s / decay) - end) / (1 - end), 0.0)


@dataclass(frozen=True)
class Contact:
    """What the field depends on besides the chains, m; `ramp`: arc over which all that has a direction, and the modes, rise."""

    radius: float
    ramp: float

    def rise(self, arcs: np.ndarray) -> np.ndarray:
        """w."""
        return np.minimum(1.0, arcs / self.ramp)

    def fields(self, chains: Chains, vertices, at: int, normal: np.ndarray, arcs: np.ndarray) -> np.ndarray:
        """(3 V, P (2 + 6 H)): displacement of all vertices (V, 3) for each coefficient when the surface is pressed by one
        unit at vertex `at`, whose distances to all vertices are `arcs` (V,)."""
        first, second = tangent_frames(normal[None])[0]
        offset = vertices - vertices[at]
        in_plane = offset - (offset @ normal)[:, None] * normal
        scale = np.maximum(np.linalg.norm(in_plane, axis=1), AWAY_FADES_BELOW * np.linalg.norm(offset, axis=1))
        away = in_plane / np.where(scale > 0, scale, 1.0)[:, None]
        around = np.cross(normal, away)
        cosine, sine = away @ first, away @ second
        waves = np.array([cosine, sine, cosine**2 - sine**2, 2 * cosine * sine])[: 2 * chains.harmonics]
        rise, one = self.rise(arcs), np.ones((1, len(vertices)))
        directed = rise * np.concatenate([waves, one, waves, waves])
        vectors = [np.broadcast_to(normal, away.shape)] * len(waves) + [away] * (1 + len(waves)) + [around] * len(waves)
        along = [normal * one.T] + [amount[:, None] * vector for amount, vector in zip(directed, vectors)]
        shapes = chains.shapes(np.maximum(arcs - self.radius, 0.0))
        # A press is a negative elongation.
        unit = -np.stack(along, axis=2)
        return (shapes.T[:, None, :, None] * unit[:, :, None, :]).reshape(3 * len(vertices), -1)


def carriers(normals: np.ndarray, harmonics: int) -> np.ndarray:
    """(n, D, 2 + 6 H): from one chain's coefficients at each of n vertices to tensors in space; columns are orthonormal."""
    frames = tangent_frames(normals)
    first, second = frames[:, 0], frames[:, 1]
    vector = np.stack([first, second], axis=2)
    outer = lambda a, b: np.einsum("ni,nj->nij", a, b).reshape(-1, 9)
    tensor = np.stack([outer(first, first) - outer(second, second), outer(first, second) + outer(second, first)], axis=2)
    waves = [vector, tensor / np.sqrt(2)][:harmonics]
    one = np.ones((len(normals), 1, 1))
    blocks = [one, *waves, one, *waves, *waves]
    carrier = np.zeros((len(normals), *np.sum([block.shape[1:] for block in blocks], axis=0)))
    row = column = 0
    for block in blocks:
        _, rows, columns = block.shape
        carrier[:, row : row + rows, column : column + columns] = block
        row, column = row + rows, column + columns
    return carrier
