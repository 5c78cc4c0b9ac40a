"""Small-strain isotropic elasticity on quadratic tetrahedra (scikit-fem).

Elements, numbering and quadrature are scikit-fem's `ElementTetP2`, three components per node as in
`ElementVector(ElementTetP2())`. The stiffness of all elements is contracted at once from the gradients and added up in
blocks of 3 x 3, which is several times faster than a form for each pair of functions; `validate.py` holds it against
scikit-fem's own elasticity form.
"""

from dataclasses import dataclass

import numpy as np
import pypardiso
import scipy.sparse as sparse
import skfem


@dataclass
class Model:
    """A body of quadratic tetrahedra.

    nodes (N, 3): the mesh's nodes, then the middle of every edge; edges (M, 2): pairs of mesh nodes;
    stiffness: blocks of 3 x 3 (N/m) for each pair of nodes `rows <= columns` (the matrix is symmetric)."""

    nodes: np.ndarray
    edges: np.ndarray
    rows: np.ndarray
    columns: np.ndarray
    blocks: np.ndarray

    def matrix(self) -> sparse.csr_matrix:
        """The whole stiffness matrix, degrees of freedom numbered 3 node + axis."""
        other = self.rows < self.columns
        return _from_blocks(
            np.concatenate([self.rows, self.columns[other]]),
            np.concatenate([self.columns, self.rows[other]]),
            np.concatenate([self.blocks, self.blocks[other].transpose(0, 2, 1)]),
            len(self.nodes),
        )


def lame(young: float, poisson: float) -> tuple[float, float]:
    """Lame's first parameter and the shear modulus, Pa."""
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


def assemble(nodes: np.ndarray, tets: np.ndarray, young, poisson: float) -> Model:
    """`young` in Pa: one number, or one for each tetrahedron."""
    mesh = skfem.MeshTet(np.ascontiguousarray(nodes.T), np.ascontiguousarray(tets.T))
    basis = skfem.Basis(mesh, skfem.ElementTetP2(), intorder=2)
    gradients = np.stack([phi[0].grad for phi in basis.basis])  # (10, 3, elements, points)
    functions, _, elements, points = gradients.shape
    weight = basis.dx * np.broadcast_to(np.asarray(young, dtype=float), (elements,))[:, None]
    g = gradients.transpose(2, 0, 1, 3).reshape(elements, 3 * functions, points)
    products = np.matmul(g * weight[:, None, :], g.transpose(0, 2, 1))
    products = products.reshape(elements, functions, 3, functions, 3).transpose(0, 1, 3, 2, 4)
    node = basis.element_dofs.T
    rows, columns = np.repeat(node, functions, axis=1), np.tile(node, (1, functions))
    upper = rows <= columns
    products = products.reshape(elements, functions**2, 3, 3)[upper]  # integral of d_a phi_i d_b phi_j
    first, shear = lame(1.0, poisson)
    local = first * products + shear * products.transpose(0, 2, 1)
    local += shear * np.einsum("naa->n", products)[:, None, None] * np.eye(3)
    count = basis.N
    key = rows[upper].astype(np.int64) * count + columns[upper]
    order = key.argsort(kind="stable")
    key = key[order]
    first_of = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    blocks = np.add.reduceat(local[order], first_of, axis=0)
    positions, edges = basis.doflocs.T, mesh.edges.T
    middle = 0.5 * (nodes[edges[:, 0]] + nodes[edges[:, 1]])
    if not (np.allclose(positions[: len(nodes)], nodes) and np.allclose(positions[len(nodes) :], middle)):
        raise RuntimeError("scikit-fem numbers its nodes otherwise than expected")
    return Model(positions, edges, key[first_of] // count, key[first_of] % count, blocks)


def _from_blocks(rows, columns, blocks, count) -> sparse.csr_matrix:
    order = np.lexsort((columns, rows))
    start = np.searchsorted(rows[order], np.arange(count + 1))
    return sparse.bsr_matrix((blocks[order], columns[order], start), shape=(3 * count, 3 * count)).tocsr()


class Factor:
    """Cholesky factor of a body's stiffness matrix with some nodes held, by MKL Pardiso, and its Schur complement.

    `held`: nodes that do not move. `turned` (node, frame): nodes whose first component is along frame[0].
    `kept`: nodes whose first component makes up the Schur complement `schur`, in this order: the forces along it that
    unit displacements along it need, everything else being free."""

    def __init__(self, model: Model, held: np.ndarray, turned: np.ndarray, frames: np.ndarray, kept: np.ndarray):
        count = len(model.nodes)
        free = np.ones(count, dtype=bool)
        free[held] = False
        if not free[kept].all() or not free[turned].all():
            raise ValueError("a disc touches the fixed base")
        frame = np.zeros(count, dtype=np.int64)
        frame[turned] = 1 + np.arange(len(turned))
        frames = np.concatenate([np.eye(3)[None], frames])
        use = free[model.rows] & free[model.columns]
        rows, columns, blocks = model.rows[use], model.columns[use], model.blocks[use]
        turn = np.flatnonzero((frame[rows] > 0) | (frame[columns] > 0))
        left, right = frames[frame[rows[turn]]], frames[frame[columns[turn]]]
        blocks[turn] = left @ blocks[turn] @ right.transpose(0, 2, 1)
        number = np.cumsum(free) - 1
        upper = sparse.triu(_from_blocks(number[rows], number[columns], blocks, int(free.sum())), format="csr")
        upper.sort_indices()
        self._free, self._matrix, self._turned, self._frames = np.flatnonzero(free), upper, turned, frames[1:]
        self._count = count
        solver = pypardiso.PyPardisoSolver(mtype=2)
        # Metis ordering, scaled pivots as usual for symmetric matrices, Schur complement together with the whole factor.
        for parameter, value in ((1, 1), (2, 2), (10, 8), (18, -1), (21, 1), (36, 2)):
            solver.set_iparm(parameter, value)
        self._dofs = 3 * number[kept]
        solver.perm = np.zeros(upper.shape[0], dtype=np.int32)
        solver.perm[self._dofs] = 1
        solver._check_A(upper)
        solver.set_phase(12)
        by_dof = solver._call_pardiso(upper, np.zeros((len(kept), len(kept)), order="F"))
        place = np.argsort(np.argsort(self._dofs))  # Pardiso orders the complement by degree of freedom
        self.schur = by_dof[np.ix_(place, place)]
        self._solver = solver

    def displacement(self, forces: np.ndarray) -> np.ndarray:
        """Displacement (N, 3) of all nodes under forces (N) along the first component of the kept nodes."""
        return self.displacements(forces[None])[0]

    def displacements(self, forces: np.ndarray) -> np.ndarray:
        """The same of several cases at once: (cases, N, 3) under forces (cases, kept nodes)."""
        right = np.zeros((self._matrix.shape[0], len(forces)), order="F")
        right[self._dofs] = forces.T
        self._solver.set_phase(33)
        u = np.zeros((len(forces), self._count, 3))
        u[:, self._free] = self._solver._call_pardiso(self._matrix, right).T.reshape(len(forces), -1, 3)
        u[:, self._turned] = np.einsum("nij,cni->cnj", self._frames, u[:, self._turned])
        return u

    def close(self) -> None:
        self._solver.free_memory(everything=True)
