"""A body divided around the places where discs press it, filled with tetrahedra, and factored."""

import numpy as np

import contact
import elasticity
import volume
from divide import RIM_SET_BACK, SizeField, divide
from surface import Disc, Surface


class SiteError(RuntimeError):
    """A disc that cannot be pressed where it is; `vertex`: its middle."""

    def __init__(self, sentence: str, vertex: int):
        super().__init__(sentence)
        self.vertex = vertex


class Mesh:
    """`held` (V,) bool: vertices that do not move. `discs`: [site][radius], every rim set back (see RIM_SET_BACK). `cells`:
    elements per radius at a rim; `growth`, `most`: see SizeField; `inner`, `ratio`: see volume.fill. Lengths in m."""

    def __init__(
        self,
        body: Surface,
        held: np.ndarray,
        vertices,
        radii,
        cells=8.0,
        growth=0.5,
        ratio=1.3,
        most=np.inf,
        inner: Surface | None = None,
        normals: np.ndarray | None = None,
    ):
        normals = body.vertex_normals() if normals is None else normals
        back = 1 - RIM_SET_BACK / cells
        self._vertices = list(vertices)
        self.normals = [normals[v] for v in vertices]
        self.discs = [[Disc(body.vertices[v], normals[v], back * r) for r in radii] for v in vertices]
        size = SizeField([d for of_site in self.discs for d in of_site], cells, growth=growth, most=most)
        self.surface, parent = divide(body, size)
        self.nodes, self.tets = volume.fill(self.surface, inner, ratio)
        self._corners, self._held = body.faces[parent], held

    def assemble(self, young, poisson) -> contact.Patches:
        """Model and factor; afterwards the nodes `fixed` and `touched[site][radius]`, those of each disc. `young`: see elasticity.assemble.

        SiteError: a disc on what is held, or two on the same place."""
        model = elasticity.assemble(self.nodes, self.tets, young, poisson)
        faces6 = contact.surface_nodes(model, self.surface)
        self.fixed = contact.fixed_nodes(faces6, self._corners, self._held)
        self.touched = [[contact.touched_nodes(model, self.surface, faces6, d) for d in of_site] for of_site in self.discs]
        self._check(self.fixed)
        self.size = {"elements": len(self.tets), "dofs": 3 * len(model.nodes)}
        return contact.Patches(model, self.fixed, self.normals, [of_site[0] for of_site in self.touched])

    def _check(self, held: np.ndarray) -> None:
        taken = {}
        for vertex, (widest, *_) in zip(self._vertices, self.touched):
            if np.isin(widest, held).any():
                raise SiteError(f"the disc at vertex {vertex} (counted from 0) touches what is held", vertex)
            for node in widest.tolist():
                other = taken.setdefault(node, vertex)
                if other != vertex:
                    raise SiteError(f"the discs at vertices {other} and {vertex} (counted from 0) touch the same place", vertex)
