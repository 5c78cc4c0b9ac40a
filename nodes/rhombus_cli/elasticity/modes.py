"""Body modes: what chains leave, compressed, and how much of it appears where the body is touched."""

from dataclasses import dataclass

import numpy as np

from kriging import Places

# How often what no mode can show near its contact (modes rise from zero there) is filled in from the modes themselves.
FILLS = 2


@dataclass(frozen=True)
class Likeness:
    """length: of the amplitudes over the surface, m; noise: variance of what is not smooth of them, relative."""

    length: float
    noise: float


@dataclass
class Modes:
    """fields (J, 3 V); amplitudes (n, J) at the places they were made from."""

    places: Places
    fields: np.ndarray
    amplitudes: np.ndarray

    @classmethod
    def of(cls, left: np.ndarray, rise: np.ndarray, places: Places, most: int) -> "Modes":
        """The first `most` of what is left (n, 3 V), to be multiplied by `rise` (n, 3 V) at each place."""
        most = min(most, len(left))
        shown = left * rise
        filled = shown
        for _ in range(1 + FILLS):
            _, vectors = np.linalg.eigh((filled @ filled.T).astype(float))
            amplitudes = vectors[:, ::-1][:, :most].astype("f4")
            fields = amplitudes.T @ filled
            filled = shown + (1 - rise**2) * (amplitudes @ fields)
        return cls(places, fields, amplitudes)

    def at(self, places: Places, likeness: Likeness) -> np.ndarray:
        """Amplitudes (n, J) there."""
        known = self.places.likeness(self.places, likeness.length) + likeness.noise * np.eye(len(self.places.points))
        return places.likeness(self.places, likeness.length) @ np.linalg.solve(known, self.amplitudes.astype(float))

    def show(self, places: Places, likeness: Likeness) -> np.ndarray:
        """(n, 3 V): the modes' part there, before `rise`."""
        return self.at(places, likeness).astype("f4") @ self.fields
