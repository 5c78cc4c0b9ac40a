"""Dividing a triangle surface around discs without moving it.

The rim of a disc (a circle in the tangent plane of the site, projected along the site's normal) becomes nodes of the mesh,
and the triangles get smaller towards it, because the pressure under a rigid punch grows without bound there. Every new
node lies on an old face or an old edge: the body stays the polyhedron it is.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from surface import Disc, Surface, tangents

# A row of touched nodes presses a little wider than it is: next to the rim the first element outside follows. With
# elements of size h at the rim a flat punch on a half-space acts as one wider by RIM_SET_BACK h (measured by
# validate.py), so the rim of the mesh is set back by that much.
RIM_SET_BACK = 0.18


@dataclass
class SizeField:
    """Edge length wanted at a point: radius / `cells` at the rim of a disc, growing by `growth` per metre away from it, and
    never above `inside` radii within a disc (default: 3 / cells, at most a third) nor above `most` metres anywhere."""

    discs: list[Disc]
    cells: float
    inside: float | None = None
    growth: float = 0.3
    most: float = np.inf

    def __call__(self, x: np.ndarray) -> np.ndarray:
        size = np.full(len(x), self.most)
        inside = self.inside or min(3 / self.cells, 1 / 3)
        for disc in self.discs:
            rho, height = disc.polar(x)
            below = np.maximum(-height - 0.5 * disc.radius, 0.0)
            rim = disc.radius / self.cells + self.growth * np.hypot(rho - disc.radius, below)
            centre = inside * disc.radius + self.growth * np.hypot(np.maximum(rho - disc.radius, 0.0), below)
            size = np.minimum(size, np.minimum(rim, centre))
        return size


def divide(surface: Surface, size: SizeField) -> tuple[Surface, np.ndarray]:
    """The same surface with smaller triangles where `size` asks for them; the first V vertices are the old ones.

    Returns the divided surface and, for each new triangle, the old face it is a part of."""
    refined, parent = _bisect(surface, size)
    divided, parent = _follow_rims(surface, refined, parent, size)
    sides = np.stack([divided.faces, np.roll(divided.faces, -1, axis=1)], axis=2).reshape(-1, 2)
    if len(np.unique(sides, axis=0)) != len(sides) or set(map(tuple, sides)) != set(map(tuple, sides[:, ::-1])):
        raise RuntimeError("the divided surface is not closed")
    return divided, parent


def _bisect(surface: Surface, size: SizeField):
    """Longest-edge bisection, conforming: a triangle is cut at its longest edge only together with its neighbour's cut."""
    points = surface.vertices.copy()
    faces = surface.faces.copy()
    parent = np.arange(len(faces))
    while True:
        p = points[faces]
        edges = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)
        length = np.linalg.norm(p - np.roll(p, -1, axis=1), axis=2)
        midpoints = 0.5 * (p + np.roll(p, -1, axis=1))
        wanted = np.minimum.reduce([size(midpoints[:, k]) for k in range(3)])
        longest = length.argmax(axis=1)
        marked = length.max(axis=1) > 1.5 * wanted
        if not marked.any():
            return Surface(points, faces), parent
        key = np.sort(edges, axis=2)
        key = key[:, :, 0] * (len(points) + 1) + key[:, :, 1]
        cut = set(key[np.flatnonzero(marked), longest[marked]].tolist())
        while True:  # a triangle with any cut edge must have its longest edge cut
            touched = np.isin(key, np.fromiter(cut, dtype=np.int64)).any(axis=1)
            more = set(key[np.flatnonzero(touched), longest[touched]].tolist()) - cut
            if not more:
                break
            cut |= more
        cut = np.array(sorted(cut), dtype=np.int64)
        ends = np.stack([cut // (len(points) + 1), cut % (len(points) + 1)], axis=1)
        middle = {int(k): len(points) + i for i, k in enumerate(cut)}
        points = np.vstack([points, 0.5 * (points[ends[:, 0]] + points[ends[:, 1]])])
        touched = np.isin(key, cut).any(axis=1)
        out, owner = [], []
        for t in np.flatnonzero(touched):
            k = int(longest[t])
            (a, b, c), m = np.roll(faces[t], -k), middle[int(key[t, k])]
            pieces = [(a, m, c), (m, b, c)]
            over_bc, over_ca = (middle.get(int(key[t, (k + j) % 3])) for j in (1, 2))
            if over_ca is not None:
                pieces = [(a, m, over_ca), (m, c, over_ca), pieces[1]]
            if over_bc is not None:
                pieces = pieces[:-1] + [(m, b, over_bc), (m, over_bc, c)]
            out += pieces
            owner += [parent[t]] * len(pieces)
        faces = np.vstack([faces[~touched], np.array(out, dtype=np.int64)])
        parent = np.concatenate([parent[~touched], np.array(owner, dtype=np.int64)])


def _follow_rims(old: Surface, refined: Surface, parent: np.ndarray, size: SizeField):
    """Puts nodes on the rims of the discs, removes those too near to them, and triangulates each old face again."""
    count = len(old.vertices)
    points = refined.vertices
    normals = old.face_normals()
    crossing = _faces_near(old, size)
    divided = np.bincount(parent, minlength=len(old.faces)) > 1
    pieces = divided[parent]
    edge_chains = _nodes_on_edges(old, refined, parent, np.flatnonzero(pieces))
    for t in crossing:  # an edge that was not cut may still cross a rim
        for a, b in zip(old.faces[t], np.roll(old.faces[t], -1)):
            edge_chains.setdefault((int(min(a, b)), int(max(a, b))), [])
    keep = np.ones(len(points), dtype=bool)
    keep[count:] = _far_from_rims(points[count:], size)
    added, total, on_edge = [points], len(points), {}
    for (a, b), chain in edge_chains.items():
        start, end = points[a], points[b]
        chain = [(t, i) for t, i in chain if keep[i]]
        for t, x in _rim_crossings(start, end, size):
            if min(t, 1 - t) * np.linalg.norm(end - start) > 0.35 * size(x[None])[0]:
                chain.append((t, total))
                added.append(x[None])
                total += 1
        if chain:
            on_edge[a, b] = [i for _, i in sorted(chain)]
    edge_nodes = {i for chain in edge_chains.values() for _, i in chain}
    inside = {}
    for t, corners in zip(parent[pieces], refined.faces[pieces]):
        for i in corners:
            if i >= count and keep[i] and i not in edge_nodes:
                inside.setdefault(int(t), set()).add(int(i))
    points, out, owner = np.vstack(added), [], []
    again = np.zeros(len(old.faces), dtype=bool)
    for t, corners in enumerate(old.faces):
        ring = []
        for a, b in zip(corners.tolist(), np.roll(corners, -1).tolist()):
            chain = on_edge.get((min(a, b), max(a, b)), [])
            ring += [a] + (chain if a < b else chain[::-1])
        free = sorted(inside.get(t, ()))
        if t in crossing:
            extra = _rim_nodes(old.vertices[corners], normals[t], points[ring], size)
            free += list(range(len(points), len(points) + len(extra)))
            points = np.vstack([points, extra])
        if len(ring) > 3 or free:
            again[t] = True
            out.append(_triangulate(points, ring, free, normals[t]))
            owner += [t] * len(out[-1])
    faces = np.vstack([old.faces[~again], *out])
    owner = np.concatenate([np.flatnonzero(~again), np.array(owner, dtype=np.int64)])
    used = np.unique(np.concatenate([np.arange(count), faces.ravel()]))
    new = np.full(len(points), -1)
    new[used] = np.arange(len(used))
    return Surface(points[used], new[faces]), owner


def _nodes_on_edges(old, refined, parent, pieces):
    """For each old edge that was cut: its nodes as (position from 0 to 1, node), from the smaller vertex on."""
    owners = {}
    for t, corners in zip(parent[pieces], refined.faces[pieces]):
        for i in corners[corners >= len(old.vertices)]:
            owners.setdefault(int(i), set()).add(int(t))
    chains = {}
    for i, faces in owners.items():
        if len(faces) == 2:
            a, b = sorted(set.intersection(*(set(old.faces[t].tolist()) for t in faces)))
            d = old.vertices[b] - old.vertices[a]
            chains.setdefault((a, b), []).append((float((refined.vertices[i] - old.vertices[a]) @ d / (d @ d)), i))
    return chains


def _on_near_side(disc, x):
    return disc.polar(x)[1] >= -disc.radius


def _far_from_rims(x, size):
    far = np.ones(len(x), dtype=bool)
    wanted = size(x)
    for disc in size.discs:
        rho, _ = disc.polar(x)
        far &= (np.abs(rho - disc.radius) > 0.6 * wanted) | ~_on_near_side(disc, x)
    return far


def _rim_crossings(a, b, size):
    """Points of the segment a-b on the rims, as (position from 0 to 1, point)."""
    found = []
    for disc in size.discs:
        d, r = b - a, a - disc.point
        d, r = d - (d @ disc.normal) * disc.normal, r - (r @ disc.normal) * disc.normal
        p, q, c = d @ d, d @ r, r @ r - disc.radius**2
        root = q * q - p * c
        if root > 0:
            for t in ((-q - np.sqrt(root)) / p, (-q + np.sqrt(root)) / p):
                x = a + t * (b - a)
                if 0 < t < 1 and _on_near_side(disc, x):
                    found.append((t, x))
    return found


def _faces_near(old, size):
    """Old faces turned towards a disc and near its rim."""
    near = set()
    p = old.vertices[old.faces]
    reach = np.linalg.norm(p - p.mean(axis=1)[:, None], axis=2).max(axis=1)
    for disc in size.discs:
        distance = np.linalg.norm(p.mean(axis=1) - disc.point, axis=1)
        towards = old.face_normals() @ disc.normal > 0.05
        near |= set(np.flatnonzero((distance < reach + 2 * disc.radius) & towards).tolist())
    return near


def _rim_nodes(corners, normal, ring, size):
    """Nodes on the rims inside one face, not too near to the nodes of its edges."""
    inverse = np.linalg.inv(np.stack([corners[0] - corners[2], corners[1] - corners[2], normal], axis=1))
    tree = cKDTree(ring)
    found = np.zeros((0, 3))
    for disc in size.discs:
        rim = size(disc.point[None] + disc.radius * tangents(disc.normal)[0])[0]
        number = int(np.ceil(2 * np.pi * disc.radius / rim))
        angle = 2 * np.pi * np.arange(number) / number
        e, f = tangents(disc.normal)
        x = disc.point + disc.radius * (np.cos(angle)[:, None] * e + np.sin(angle)[:, None] * f)
        x = x + (((corners[0] - x) @ normal) / (disc.normal @ normal))[:, None] * disc.normal
        b = (x - corners[2]) @ inverse.T
        inside = (b[:, 0] > 0) & (b[:, 1] > 0) & (b[:, 0] + b[:, 1] < 1) & _on_near_side(disc, x)
        x = x[inside]
        x = x[tree.query(x)[0] > 0.45 * rim] if len(x) else x
        if len(x) and len(found):
            x = x[cKDTree(found).query(x)[0] > 0.45 * rim]
        found = np.vstack([found, x])
    return found


def _triangulate(points, ring, free, normal):
    """Delaunay triangles of one flat face from the nodes of its edges and inside it, counter-clockwise about `normal`.

    The nodes of the edges are bent outwards by a hair first: exactly on a line they would be no convex hull."""
    e, f = tangents(normal)
    index = np.array(list(ring) + list(free))
    flat = np.stack([points[index] @ e, points[index] @ f], axis=1)
    flat -= flat[: len(ring)].mean(axis=0)
    scale = np.abs(flat).max()
    flat /= scale
    edge = flat[: len(ring)]
    r = np.linalg.norm(edge, axis=1)
    flat[: len(ring)] = edge * (1 + 1e-5 * (1.5 - r**2))[:, None]
    triangles = Delaunay(flat).simplices
    a, b, c = (flat[triangles[:, k]] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    longest = np.maximum.reduce([((a - b) ** 2).sum(1), ((b - c) ** 2).sum(1), ((c - a) ** 2).sum(1)])
    line = np.abs(area) < 1e-4 * longest  # three nodes of one edge
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    triangles = triangles[~line]
    return index[triangles]
