"""The solver against closed forms of the elastic half-space, each on a row of finer meshes.

    python validate.py            writes results/validation.csv

The half-space is a box 4000 contact radii wide and 2000 deep, held at its sides and bottom; what this changes (less than
0.1 % of the stiffness) is part of the errors listed. Closed forms: K. L. Johnson, Contact Mechanics
(1985), sections 3.2 (Boussinesq), 3.4 (uniform pressure on a circle, flat punch) and 4.2 (Hertz)."""

from pathlib import Path

import numpy as np
import scipy.sparse
import skfem
from scipy.spatial import cKDTree
from scipy.special import ellipe, ellipk
from skfem.models.elasticity import linear_elasticity

import shared  # noqa: F401

import contact
import elasticity
import volume
from divide import RIM_SET_BACK, SizeField, divide
from surface import Disc, Surface
from tables import percent, write_csv

YOUNG, POISSON = 10e3, 0.45
RADIUS = 0.005
CELLS = (4, 6, 8, 12)
TOP = (2, 3)
RESULTS = Path(__file__).parent / "results"


def box(half_width: float, depth: float) -> Surface:
    """A box under the plane z = 0."""
    x, y, z = half_width, half_width, depth
    vertices = np.array([[i * x, j * y, k * z] for k in (-1, 0) for j in (-1, 1) for i in (-1, 1)], dtype=float)
    faces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4]]
    faces += [[2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]  # TOP: the third and fourth
    faces = np.array(faces)
    vertices[:, :2] -= vertices[faces[TOP[0]], :2].mean(axis=0)  # the origin inside a face, far from its edges
    return Surface(vertices, faces)


class HalfSpace:
    """One mesh of the half-space with a disc of nodes that may be touched; `cells`: elements per radius at its rim; away
    from it they grow by 2.4 / `cells` of the distance, so that the whole mesh gets finer."""

    def __init__(self, cells: float, radius: float, poisson: float = POISSON, inside=None):
        surface = box(2000 * RADIUS, 2000 * RADIUS)
        self.disc = Disc(np.zeros(3), np.array([0.0, 0.0, 1.0]), radius)
        size = SizeField([self.disc], cells, inside, 2.4 / cells)
        self.surface, parent = divide(surface, size)
        nodes, self.tets = volume.fill(self.surface)
        self.model = elasticity.assemble(nodes, self.tets, YOUNG, poisson)
        self.faces6 = contact.surface_nodes(self.model, self.surface)
        top = np.isin(parent, TOP)
        held = np.unique(self.faces6[~top])
        self.nodes = contact.touched_nodes(self.model, self.surface, self.faces6, self.disc)
        self.patches = contact.Patches(self.model, held, [self.disc.normal], [self.nodes])
        self.top = np.setdiff1d(np.unique(self.faces6[top]), held)
        self.rho = np.linalg.norm(self.model.nodes[:, :2], axis=1)

    def size(self):
        return {"elements": len(self.tets), "dofs": 3 * len(self.model.nodes)}


def contact_modulus(poisson: float) -> float:
    return YOUNG / (1 - poisson**2)


def relative_l2(found: np.ndarray, exact: np.ndarray) -> float:
    return float(np.linalg.norm(found - exact) / np.linalg.norm(exact))


def boussinesq(cells: float) -> dict:
    """Uniform pressure on a disc of total force 1 N: normal displacement inside and out to 20 radii, and the tangential
    displacement of Boussinesq's point force outside (exact there by symmetry)."""
    poisson = 0.3  # at 0.45 the tangential part is a tenth of the normal part
    half = HalfSpace(cells, RADIUS, poisson)
    inside = np.isin(half.faces6, half.nodes).all(axis=1)
    p = half.surface.vertices[half.surface.faces[inside]]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    load = np.zeros(len(half.model.nodes))
    np.add.at(load, half.faces6[inside][:, 3:], (area / 3)[:, None])  # consistent forces: corners get none
    u = half.patches.under(-load[half.nodes] / area.sum())
    radius = np.sqrt(area.sum() / np.pi)
    near = half.top[(half.rho[half.top] < 20 * RADIUS)]
    rho = half.rho[near] / radius
    pressure = 1 / area.sum()
    modulus = contact_modulus(poisson)
    with np.errstate(divide="ignore", invalid="ignore"):
        within = 4 * pressure * radius / (np.pi * modulus) * ellipe(np.minimum(rho, 1) ** 2)
        k = np.minimum(1 / rho, 1) ** 2
        out = 4 * pressure * radius * rho / (np.pi * modulus) * (ellipe(k) - (1 - k) * ellipk(k))
    normal = relative_l2(u[near, 2], -np.where(rho < 1, within, out))
    outside = near[rho > 1.2]
    radial = (u[outside, :2] * half.model.nodes[outside, :2]).sum(1) / half.rho[outside]
    exact = -(1 - 2 * poisson) * (1 + poisson) / (2 * np.pi * YOUNG * half.rho[outside])
    half.patches.close()
    return half.size() | {"normal_l2": normal, "tangential_l2": relative_l2(radial, exact)}


def punch(cells: float, set_back: float, poisson: float = POISSON) -> dict:
    """Rigid flat punch: K = 2 E a / (1 - nu^2), w = 2/pi asin(a/rho) outside. `set_back`: see RIM_SET_BACK."""
    half = HalfSpace(cells, RADIUS * (1 - set_back / cells), poisson)
    answer = half.patches.press(half.nodes)
    exact = 2 * contact_modulus(poisson) * RADIUS
    near = half.top[half.rho[half.top] < 20 * RADIUS]
    profile = 2 / np.pi * np.arcsin(np.minimum(RADIUS / np.maximum(half.rho[near], 1e-12), 1))
    half.patches.close()
    return half.size() | {
        "stiffness": answer.stiffness[0] / exact - 1,
        "normal_l2": relative_l2(answer.displacement[near, 2], -profile),
    }


def hertz(cells: float) -> dict:
    """A rigid paraboloid of curvature 1/R to depth a^2 / R: the contact radius is the smallest for which no node
    outside it is inside the sphere. F = 4/3 E* sqrt(R) depth^1.5, contact radius a."""
    a, curvature = RADIUS, 1 / (6 * RADIUS)
    depth = a * a * curvature
    half = HalfSpace(cells, 1.3 * a, inside=1 / cells)
    rho = half.rho[half.nodes]
    into = depth - rho**2 * curvature / 2
    few, many = 0.5 * a, 1.3 * a
    while many - few > 0.02 * a / cells:
        middle = (few + many) / 2
        touched = rho <= middle
        answer = half.patches.press(half.nodes[touched], into[touched])
        inside = ~touched & (answer.displacement[half.nodes, 2] > -into + 1e-6 * depth)
        few, many = (middle, many) if inside.any() else (few, middle)
    touched = rho <= many
    answer = half.patches.press(half.nodes[touched], into[touched])
    exact = 4 / 3 * contact_modulus(POISSON) * np.sqrt(1 / curvature) * depth**1.5
    near = half.top[half.rho[half.top] < 20 * RADIUS]
    r = half.rho[near] / a
    with np.errstate(invalid="ignore"):
        out = depth / np.pi * ((2 - r**2) * np.arcsin(1 / np.maximum(r, 1)) + np.sqrt(np.maximum(r**2 - 1, 0)))
    profile = -np.where(r < 1, depth - half.rho[near] ** 2 * curvature / 2, out)
    half.patches.close()
    return half.size() | {
        "force": answer.stiffness[0] / exact - 1,
        "contact_radius": many / a - 1,
        "normal_l2": relative_l2(answer.displacement[near, 2], profile),
    }


def same_matrix_as_scikit_fem() -> float:
    """Largest difference to scikit-fem's own elasticity form, relative to the largest entry."""
    mesh = skfem.MeshTet().refined(2)
    first, shear = elasticity.lame(YOUNG, POISSON)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTetP2()))
    theirs = linear_elasticity(first, shear).assemble(basis)
    ours = elasticity.assemble(mesh.p.T, mesh.t.T, YOUNG, POISSON).matrix()
    number = 3 * _place(basis.doflocs.T, skfem.Basis(mesh, skfem.ElementTetP2()).doflocs.T)
    for dofs in (basis.nodal_dofs, basis.edge_dofs):  # rows: components
        number[dofs] += np.arange(3)[:, None]
    permutation = scipy.sparse.csr_matrix((np.ones(len(number)), (number, np.arange(len(number)))))
    return float(abs(permutation @ theirs @ permutation.T - ours).max() / abs(theirs).max())


def _place(points: np.ndarray, among: np.ndarray) -> np.ndarray:
    distance, place = cKDTree(among).query(points)
    assert distance.max() == 0
    return place


def main() -> None:
    rows = []

    def add(case, cells, found):
        rows.append({"case": case, "cells": cells, "elements": found["elements"], "dofs": found["dofs"]})
        for key, value in found.items():
            if key not in ("elements", "dofs"):
                rows[-1][f"{key}_error_percent"] = percent(value)
        print(rows[-1], flush=True)

    for cells in CELLS:
        add("Boussinesq, pressure on a disc, nu = 0.3", cells, boussinesq(cells))
    for cells in CELLS:
        add("flat punch, rim not set back", cells, punch(cells, 0.0))
    for cells in CELLS:
        add("flat punch", cells, punch(cells, RIM_SET_BACK))
    for poisson in (0.3, 0.49):
        add(f"flat punch, nu = {poisson}", 8, punch(8, RIM_SET_BACK, poisson))
    for cells in CELLS:
        add("Hertz", cells, hertz(cells))
    rows.append({"case": "matrix against scikit-fem's form", "stiffness_error_percent": percent(same_matrix_as_scikit_fem())})
    write_csv(RESULTS / "validation.csv", rows)


if __name__ == "__main__":
    main()
