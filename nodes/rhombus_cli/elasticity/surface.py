"""Triangle surfaces: reading, normals, a ball; and the rigid discs pressed on them."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull


@dataclass
class Surface:
    """Vertices (V, 3) in metres and triangles (T, 3), counter-clockwise seen from outside."""

    vertices: np.ndarray
    faces: np.ndarray

    def face_normals(self) -> np.ndarray:
        p = self.vertices[self.faces]
        n = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        return n / np.linalg.norm(n, axis=1)[:, None]

    def vertex_normals(self) -> np.ndarray:
        """Unit normals: those of the adjoining faces weighted by their angles, as the product has them."""
        normals = np.zeros_like(self.vertices)
        for k in range(3):
            here = self.vertices[self.faces[:, k]]
            a = self.vertices[self.faces[:, (k + 1) % 3]] - here
            b = self.vertices[self.faces[:, (k + 2) % 3]] - here
            cross = np.cross(a, b)
            length = np.linalg.norm(cross, axis=1)
            angle = np.arctan2(length, (a * b).sum(1))
            np.add.at(normals, self.faces[:, k], cross * (angle / length)[:, None])
        return normals / np.linalg.norm(normals, axis=1)[:, None]


def read_obj(path: Path) -> Surface:
    """Vertices and triangles of a Wavefront OBJ file, in the order of the file."""
    vertices, faces = [], []
    for line in Path(path).read_text().splitlines():
        if line.startswith("v "):
            vertices.append([float(x) for x in line.split()[1:4]])
        elif line.startswith("f "):
            faces.append([int(x.split("/")[0]) - 1 for x in line.split()[1:4]])
    return Surface(np.array(vertices), np.array(faces, dtype=np.int64))


def icosphere(centre: np.ndarray, radius: float, level: int = 2) -> Surface:
    """A sphere as a polyhedron of the same volume: an icosahedron with its faces divided into four `level` times."""
    golden = (1 + 5**0.5) / 2
    corners = [(s, t * golden, 0) for s in (-1, 1) for t in (-1, 1)]
    points = np.array([np.roll(c, k) for k in range(3) for c in corners], dtype=float)
    faces = ConvexHull(points).simplices.astype(np.int64)
    for _ in range(level):
        edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2)
        unique, place = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
        middle = len(points) + place.reshape(-1, 3)
        points = np.vstack([points, points[unique].sum(axis=1)])
        points /= np.linalg.norm(points, axis=1)[:, None]
        (a, b, c), (d, e, f) = faces.T, middle.T
        faces = np.concatenate([np.stack(x, axis=1) for x in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))])
    points /= np.linalg.norm(points, axis=1)[:, None]
    p = points[faces]
    signed = np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2]))
    faces[signed < 0] = faces[signed < 0][:, ::-1]
    points *= radius * (4 * np.pi / (np.abs(signed).sum() / 2)) ** (1 / 3)
    return Surface(points + centre, faces)


@dataclass
class Disc:
    """Where a rigid flat disc touches: the near side of the surface within `radius` of `point`.

    Near side: |tangential distance| <= radius, height over the tangent plane >= -radius, face turned towards `normal`.
    """

    point: np.ndarray
    normal: np.ndarray
    radius: float

    def polar(self, x: np.ndarray):
        """Tangential distance from the axis and height over the tangent plane, metres."""
        r = x - self.point
        height = r @ self.normal
        return np.linalg.norm(r - height[..., None] * self.normal, axis=-1), height


def tangents(normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors that make a right-handed frame with `normal`: normal, first, second."""
    e = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    e /= np.linalg.norm(e)
    return e, np.cross(normal, e)
