"""Large-strain elasticity on quadratic tetrahedra: compressible neo-Hookean bodies and Newton's method.

Energy per reference volume, F the deformation gradient and J its determinant,

    W = mu/2 (F : F - 3) - mu ln J + lambda/2 (ln J)^2,      P = dW/dF = mu F + (lambda ln J - mu) F^-T,

which for small strain is the isotropic material with the same Lame parameters. Gradients and quadrature are scikit-fem's
(`ElementTetP2`, 14 points, all weights positive), numbering is that of `elasticity.Model`; the contraction is done for all
elements at once as in elasticity.py."""

from dataclasses import dataclass

import numpy as np
import pypardiso
import scipy.sparse as sparse
import skfem
from pypardiso.pardiso_wrapper import PyPardisoError

import shared  # noqa: F401

import elasticity
from contact import frame


NOT_POSITIVE = -4  # Pardiso: a pivot of Cholesky's factor is not


class Inverted(Exception):
    """The deformation turns some element inside out, or Newton's method finds no equilibrium without that."""


class Body:
    """Energy, forces and stiffness of a body; `nodes`, `tets` are the linear mesh, displacements (N, 3) are of all nodes."""

    def __init__(self, nodes: np.ndarray, tets: np.ndarray, young: float, poisson: float):
        mesh = skfem.MeshTet(np.ascontiguousarray(nodes.T), np.ascontiguousarray(tets.T))
        basis = skfem.Basis(mesh, skfem.ElementTetP2(), intorder=5)
        # (elements, points, functions, 3)
        self._gradients = np.ascontiguousarray(np.stack([phi[0].grad for phi in basis.basis]).transpose(2, 3, 0, 1))
        self._weight = basis.dx
        self.node = basis.element_dofs.T  # (elements, 10)
        self.count = basis.N
        self._first, self._shear = elasticity.lame(young, poisson)
        weighted = self._gradients * np.sqrt(self._weight)[:, :, None, None]
        flat = weighted.transpose(0, 2, 1, 3).reshape(*self.node.shape, -1)
        self._laplace = self._shear * np.matmul(flat, flat.transpose(0, 2, 1))

    def _deformed(self, u: np.ndarray):
        """F, its inverse and ln J at every point."""
        f = np.eye(3) + np.matmul(u[self.node].transpose(0, 2, 1)[:, None], self._gradients)
        j = np.linalg.det(f)
        if j.min() <= 0:
            raise Inverted
        return f, np.linalg.inv(f), np.log(j)

    def energy(self, u: np.ndarray) -> float:
        """Elastic energy, J."""
        f, _, log_j = self._deformed(u)
        density = self._shear / 2 * ((f**2).sum((2, 3)) - 3) - self._shear * log_j + self._first / 2 * log_j**2
        return float((self._weight * density).sum())

    def forces(self, u: np.ndarray) -> np.ndarray:
        """Derivative of the energy by every displacement (N, 3): what must be applied from outside, N."""
        f, inverse, log_j = self._deformed(u)
        stress = self._shear * f + (self._first * log_j - self._shear)[:, :, None, None] * inverse.transpose(0, 1, 3, 2)
        local = np.matmul(self._gradients, (stress * self._weight[:, :, None, None]).transpose(0, 1, 3, 2)).sum(axis=1)
        return np.stack(
            [np.bincount(self.node.ravel(), local[:, :, a].ravel(), minlength=self.count) for a in range(3)], axis=1
        )

    def element_stiffness(self, u: np.ndarray) -> np.ndarray:
        """Second derivative of every element's energy, (elements, 30, 30), numbered 3 function + axis."""
        _, inverse, log_j = self._deformed(u)
        elements, functions = self.node.shape
        h = np.matmul(self._gradients, inverse)  # gradients by the deformed position
        h = h.reshape(elements, -1, 3 * functions)

        def products(factor):
            return np.matmul((h * (self._weight * factor)[:, :, None]).transpose(0, 2, 1), h)

        local = products(np.full_like(log_j, self._first))
        turned = products(self._shear - self._first * log_j).reshape(elements, functions, 3, functions, 3)
        local += turned.transpose(0, 1, 4, 3, 2).reshape(local.shape)
        blocks = local.reshape(elements, functions, 3, functions, 3)
        for a in range(3):
            blocks[:, :, a, :, a] += self._laplace
        return local


@dataclass
class State:
    """Equilibrium at one depth: displacement (N, 3) in m, energy in J, force on the hand along the normal in N, and what is
    left of the forces on free nodes, relative to `force`."""

    depth: float
    displacement: np.ndarray
    energy: float
    force: float
    residual: float


class Press:
    """A rigid flat disc without friction: u . normal = -depth on the `touched` nodes, which slide freely; `held` stay.

    Degrees of freedom are 3 node + axis, at touched nodes along the normal and two tangents."""

    TOLERANCE, ITERATIONS = 1e-6, 40

    def __init__(self, body: Body, held: np.ndarray, touched: np.ndarray, normal: np.ndarray):
        self._body, self._touched, self._frame = body, touched, frame(normal)
        free = np.ones((body.count, 3), dtype=bool)
        free[held] = False
        free[touched, 0] = False
        self._free, self._pushed = np.flatnonzero(free.ravel()), 3 * touched
        self._dofs = (3 * body.node[:, :, None] + np.arange(3)).reshape(len(body.node), -1)
        on = np.isin(body.node, touched)
        self._turned = np.flatnonzero(on.any(axis=1))  # elements with a touched node, and their frames
        self._frames = np.zeros((len(self._turned), *2 * self._dofs.shape[1:]))
        for k in range(on.shape[1]):
            mine = on[self._turned, k][:, None, None]
            self._frames[:, 3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = np.where(mine, self._frame, np.eye(3))
        self._pattern(free)
        self._solver = None
        self.state = State(0.0, np.zeros((body.count, 3)), 0.0, 0.0, 0.0)

    def _pattern(self, free: np.ndarray) -> None:
        """Where the entries of the element matrices go in the upper half of the matrix of the free degrees of freedom."""
        number = np.where(free.ravel(), free.ravel().cumsum() - 1, -1)[self._dofs]
        rows, columns = number[:, :, None], number[:, None, :]
        self._upper = (rows >= 0) & (columns >= rows)
        size = len(self._free)
        key, self._slot = np.unique((rows * size + columns)[self._upper], return_inverse=True)
        start = np.searchsorted(key // size, np.arange(size + 1))
        self._matrix = sparse.csr_matrix((np.zeros(len(key)), key % size, start), shape=(size, size))

    def _forces(self, u: np.ndarray) -> np.ndarray:
        forces = self._body.forces(u)
        forces[self._touched] = forces[self._touched] @ self._frame.T
        return forces.ravel()

    def _step(self, u: np.ndarray, forces: np.ndarray, pushed: float, stiffer: float = 0.0) -> np.ndarray | None:
        """Newton's step (N, 3) where the touched nodes go `pushed` along the normal; None where the matrix is not positive
        definite. `stiffer`: what is added to the diagonal, as a fraction of it."""
        local = self._body.element_stiffness(u)
        local[self._turned] = self._frames @ local[self._turned] @ self._frames.transpose(0, 2, 1)
        found = np.zeros(3 * len(u))
        found[self._pushed] = pushed
        moved = np.matmul(local, found[self._dofs][:, :, None])
        right = -(forces + np.bincount(self._dofs.ravel(), moved.ravel(), minlength=len(found)))[self._free]
        self._matrix.data = np.bincount(self._slot, local[self._upper])
        diagonal = self._matrix.indptr[:-1]  # first of the upper half of each row
        self._matrix.data[diagonal] += stiffer * np.abs(self._matrix.data[diagonal])
        if self._solver is None:
            self._solver = pypardiso.PyPardisoSolver(mtype=2)
            self._solver._check_A(self._matrix)
            self._solver.set_phase(11)  # the order of elimination, the same for all
            self._solver._call_pardiso(self._matrix, right)
        self._solver.set_phase(23)
        try:
            found[self._free] = self._solver._call_pardiso(self._matrix, right).ravel()
        except PyPardisoError as error:
            if error.value == NOT_POSITIVE:
                return None
            raise
        step = found.reshape(-1, 3)
        step[self._touched] = step[self._touched] @ self._frame
        return step

    def close(self) -> None:
        if self._solver is not None:
            self._solver.free_memory(everything=True)

    def _equilibrium(self, depth: float) -> State:
        """One load step by Newton's method: steps are halved until they lower the energy; where the matrix is not positive
        definite it is stiffened until it is. Raises Inverted if it fails."""
        u = self.state.displacement
        ahead = self._step(u, self._forces(u), self.state.depth - depth)
        if ahead is None:
            raise Inverted
        u = u + ahead
        forces = self._forces(u)
        energy, stiffer = self._body.energy(u), 0.0
        for _ in range(self.ITERATIONS):
            left, force = np.linalg.norm(forces[self._free]), -forces[self._pushed].sum()
            if left <= self.TOLERANCE * abs(force):
                return State(depth, u, energy, force, left / abs(force))
            step = self._step(u, forces, 0.0, stiffer)
            found = None if step is None else self._lower(u, step, energy)
            if found is None:
                stiffer = max(4 * stiffer, 1e-2)
                continue
            u, energy = found
            forces, stiffer = self._forces(u), stiffer / 4 if stiffer > 1e-2 else 0.0
        raise Inverted

    def _lower(self, u: np.ndarray, step: np.ndarray, energy: float):
        """The longest of some parts of a step that lowers the energy, as displacement and energy; None if there is none."""
        for part in 0.5 ** np.arange(6):
            try:
                tried = self._body.energy(u + part * step)
            except Inverted:
                continue
            # At the end energies differ by rounding only.
            if tried < energy * (1 - 1e-9) or (part == 1 and tried < energy * (1 + 1e-9)):
                return u + part * step, tried
        return None

    def to(self, depth: float, least: float = 0.1e-3) -> State:
        """Presses on to `depth`, at once or, where Newton's method fails, in steps halved until it does not; raises Inverted
        below `least`."""
        step = depth - self.state.depth
        while self.state.depth != depth:
            ahead = depth - self.state.depth
            target = depth if ahead <= 1.01 * step else self.state.depth + step
            try:
                self.state = self._equilibrium(target)
            except Inverted:
                step = (target - self.state.depth) / 2
                if step < least:
                    raise
        return self.state
