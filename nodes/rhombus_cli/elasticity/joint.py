"""The chains' coefficients at all sites at once.

A press determines only a few of the coefficients at its site well. So they are not fitted site by site and averaged afterwards:
they are a Gaussian field over the surface (as tensors in space, see directions.py), and what is most likely given all
presses together lets every press say what it says and no more. With the press at site i u_i = D_i theta_i + noise,
theta = mean + a field of covariance C:

    theta = mean + C L (L^T C L + s I)^-1 L^-1 D^T (u - D mean),    L L^T = D^T D,  s: variance of the noise

What chains leave (the noise) is no white noise but smooth over the surface, so `noise` is relative to the square of a whole
displacement field, not of one number. That the contact moves by its depth (sum over the chains of a_0 = 1) holds in the mean, and
the field of deviations has none other."""

from dataclasses import dataclass

import numpy as np

from directions import Chains, Contact, carriers
from kriging import Places, solve_positive


@dataclass(frozen=True)
class Smoothness:
    """length: of the field, m; noise: see above, for a field of coefficients of variance 1."""

    length: float
    noise: float


class Presses:
    """Unit presses at sites. vertices, normals (V, 3); sites (S,); arcs (S, V) m; displacement (S, V, 3)."""

    def __init__(self, vertices, normals, sites, arcs, displacement, contact: Contact):
        self.vertices, self.all, self.contact = vertices, Places(vertices, normals), contact
        self.sites, self.places = sites, self.all[sites]
        self.arcs = arcs.astype(float)
        self.fields = displacement.reshape(len(sites), -1)
        self.rise = np.repeat(contact.rise(arcs), 3, axis=1).astype("f4")
        self.square = float(np.mean([np.vdot(u, u) for u in self.fields]))
        self.size = float(np.linalg.norm(np.ptp(vertices, axis=0)))

    def __len__(self) -> int:
        return len(self.sites)


class Joint:
    """One choice of chains, ready to be fitted to any of the presses."""

    def __init__(self, presses: Presses, chains: Chains):
        self.presses, self.chains = presses, chains
        count, size = len(presses), chains.count * chains.per_chain
        self.designs, self.grams, self.seen = [], np.empty((count, size, size)), np.empty((count, size))
        for k, (vertex, arcs) in enumerate(zip(presses.sites, presses.arcs)):
            normal = presses.places.normals[k]
            design = presses.contact.fields(chains, presses.vertices, vertex, normal, arcs).astype("f4")
            self.designs.append(design)
            self.grams[k], self.seen[k] = design.T @ design, design.T @ presses.fields[k]
        values, vectors = np.linalg.eigh(self.grams)
        roots = np.sqrt(np.maximum(values, 1e-9 * values[:, -1:]))[:, None, :]
        self._inverse = (vectors / roots).transpose(0, 2, 1)
        loads = (vectors * roots).reshape(count, chains.count, chains.per_chain, -1)
        # (S, P D, P C): what combines the coefficients of each site, as tensors.
        tensors = carriers(presses.places.normals, chains.harmonics)
        self._loads = np.einsum("sdc,spcr->spdr", tensors, self.closed(loads), optimize=True).reshape(count, -1, size)
        flat = self._loads.transpose(1, 0, 2).reshape(self._loads.shape[1], -1).astype("f4")
        self._overlap = flat.T @ flat

    def closed(self, deviations: np.ndarray) -> np.ndarray:
        """(n, P, C, ..) without what would add to sum a_0."""
        deviations = deviations.copy()
        deviations[:, :, 0] -= deviations[:, :, 0].mean(axis=1, keepdims=True)
        return deviations

    def fit(self, which: np.ndarray, smooth: Smoothness) -> "Fitted":
        """To the presses `which` (indices)."""
        mean = self._mean(which)
        noise = smooth.noise * self.presses.square
        known = self.seen[which] - self.grams[which] @ mean
        known = np.einsum("srn,sn->sr", self._inverse[which], known).ravel()
        places, size = self.presses.places[which], self._loads.shape[2]
        likeness = places.likeness(places, smooth.length).astype("f4")
        rows = (which[:, None] * size + np.arange(size)).ravel()
        matrix = self._overlap[np.ix_(rows, rows)]
        blocks = matrix.reshape(len(which), size, len(which), size)
        blocks *= likeness[:, None, :, None]
        matrix[np.diag_indices(len(matrix))] += noise
        x = solve_positive(matrix, known).reshape(len(which), size, 1)
        tensors = (self._loads[which] @ x).reshape(len(which), self.chains.count, -1)
        return Fitted(self, places, smooth.length, mean, tensors)

    def _mean(self, which: np.ndarray) -> np.ndarray:
        """The best coefficients if they were constant and without harmonics, with sum a_0 = 1."""
        chains = self.chains
        closed = np.arange(chains.count) * chains.per_chain
        used = np.concatenate([closed, closed + 1 + 2 * chains.harmonics])
        gram = self.grams[which].sum(axis=0)[np.ix_(used, used)]
        unit = np.trace(gram) / len(used)
        border = unit * (np.arange(len(used)) < chains.count)
        system = np.block([[gram + 1e-6 * unit * np.eye(len(used)), border[:, None]], [border[None], np.zeros((1, 1))]])
        mean = np.zeros(chains.count * chains.per_chain)
        mean[used] = np.linalg.solve(system, np.append(self.seen[which].sum(axis=0)[used], unit))[:-1]
        return mean

    def displacement(self, site: int, coefficients: np.ndarray) -> np.ndarray:
        """(3 V,) of a unit press there."""
        return self.designs[site] @ coefficients.astype("f4")


@dataclass
class Fitted:
    """mean (P C,); tensors (n, P, D): weights of the field at the places it was fitted to."""

    joint: Joint
    places: Places
    length: float
    mean: np.ndarray
    tensors: np.ndarray

    def at(self, places: Places) -> np.ndarray:
        """Coefficients (n, P C), in the tangent frames of the normals there."""
        chains = self.joint.chains
        tensors = np.einsum("ns,spd->npd", places.likeness(self.places, self.length), self.tensors, optimize=True)
        carried = np.einsum("ndc,npd->npc", carriers(places.normals, chains.harmonics), tensors, optimize=True)
        return self.joint.closed(carried).reshape(len(tensors), -1) + self.mean
