"""A calibrated body from unit presses: chains that differ by direction and over the surface, and body modes.

    python fit.py WORK            reads WORK/press_*.npz and WORK/arcs.f32, writes WORK/fit.npz

What is chosen (chains, harmonics, modes, and how smooth each field is) is chosen by K-fold cross-validation: by the errors at
sites that the estimate has not seen. Errors are relative L2 over all vertices, and over those within `near_m` of the site; a choice's
score is the sum of the two medians. See work.py for the folder."""

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from directions import Chains, Contact
from joint import Fitted, Joint, Presses, Smoothness
from modes import Likeness, Modes
from work import Refused, Work, run, save

# How smooth the fields may be, lengths relative to the diagonal of the body's box. The chains' are looked for from the middle on,
# with the candidate of middle size for all of them: the errors hardly depend on it (on the liver half or twice the length, or a third
# or three times the noise, changes the score by up to 7 %). Those of the modes cost little and are all tried.
LENGTHS, NOISES = (0.15, 0.3, 0.6), (0.002, 0.006, 0.02)
MODE_LENGTHS, MODE_NOISES = (0.1, 0.2, 0.4), (0.001, 0.01, 0.1)
# A smaller response is taken when its score is within this factor of the best.
NEARLY = 1.02


@dataclass(eq=False)
class Trial:
    """One combination: errors (S, 2), each when its fold was not used; `numbers`: of the response, for each vertex."""

    chains: Chains
    modes: int
    smooth: Smoothness
    likeness: Likeness
    errors: np.ndarray
    seconds: float

    @property
    def score(self) -> float:
        return float(np.median(self.errors, axis=0).sum())

    @property
    def numbers(self) -> int:
        return self.chains.count * self.chains.per_chain + 4 * self.modes

    def row(self) -> list[float]:
        """P, H, J, median full, median near, worst full, seconds."""
        full, near = np.median(self.errors, axis=0)
        return [self.chains.count, self.chains.harmonics, self.modes, full, near, self.errors[:, 0].max(), self.seconds]


class Judge:
    """Errors at held-out sites."""

    def __init__(self, presses: Presses, near_m: float):
        self._presses = presses
        apart = np.linalg.norm(presses.vertices[None] - presses.places.points[:, None], axis=2)
        self._near = np.repeat(apart < near_m, 3, axis=1)

    def errors(self, site: int, found: np.ndarray) -> tuple[float, float]:
        """Relative L2 of a field (3 V,): whole, near."""
        truth, near = self._presses.fields[site], self._near[site]
        off = found - truth
        return np.linalg.norm(off) / np.linalg.norm(truth), np.linalg.norm(off[near]) / np.linalg.norm(truth[near])


class Validation:
    """Cross-validation of one choice of chains. Every `folds`-th site is one fold: the sites are in farthest-point order, so
    each fold is spread over the body."""

    def __init__(self, presses: Presses, chains: Chains, judge: Judge, folds: int):
        self.presses, self.chains, self.judge = presses, chains, judge
        self.joint = Joint(presses, chains)
        order = np.arange(len(presses))
        self.folds = [(order[order % folds != k], order[order % folds == k]) for k in range(folds)]

    def chains_alone(self, smooth: Smoothness) -> tuple[float, list]:
        """Score without modes, and for each fold what was fitted and what it says at the sites it has not seen."""
        errors, fits = np.empty((len(self.presses), 2)), []
        for known, unknown in self.folds:
            fitted = self.joint.fit(known, smooth)
            coefficients = fitted.at(self.presses.places[unknown])
            found = [self.joint.displacement(site, here) for site, here in zip(unknown, coefficients)]
            errors[unknown] = [self.judge.errors(site, field) for site, field in zip(unknown, found)]
            fits.append((fitted, found))
        return float(np.median(errors, axis=0).sum()), fits

    def smoothest(self) -> Smoothness:
        """Goes downhill in LENGTHS and NOISES from their middle."""
        scores = {}

        def of(place):
            return Smoothness(LENGTHS[place[0]] * self.presses.size, NOISES[place[1]])

        def score(place):
            if place not in scores:
                scores[place] = self.chains_alone(of(place))[0]
            return scores[place]

        here, before = (len(LENGTHS) // 2, len(NOISES) // 2), None
        while here != before:
            before = here
            for axis, count in enumerate((len(LENGTHS), len(NOISES))):
                line = [here[:axis] + (here[axis] + step,) + here[axis + 1 :] for step in (0, -1, 1)]
                here = min((place for place in line if 0 <= place[axis] < count), key=score)
        return of(here)

    def with_modes(self, counts: list[int], smooth: Smoothness, fits: list) -> list[Trial]:
        """One trial for each number of modes, each with the amplitudes' smoothness that does best."""
        grid = [Likeness(a * self.presses.size, b) for a in MODE_LENGTHS for b in MODE_NOISES]
        errors = {count: np.empty((len(grid) if count else 1, len(self.presses), 2)) for count in counts}
        spent = dict.fromkeys(counts, 0.0)
        for (known, unknown), (fitted, found) in zip(self.folds, fits):
            left = residuals(self.joint, fitted, known) if any(counts) else None
            for count in counts:
                start = time.perf_counter()
                modes = Modes.of(left, self.presses.rise[known], self.presses.places[known], count) if count else None
                for number, likeness in enumerate(grid if count else grid[:1]):
                    fields = found
                    if modes:
                        fields = found + self.presses.rise[unknown] * modes.show(self.presses.places[unknown], likeness)
                    errors[count][number, unknown] = [self.judge.errors(*pair) for pair in zip(unknown, fields)]
                spent[count] += time.perf_counter() - start
        best = {count: int(np.median(e, axis=1).sum(axis=1).argmin()) for count, e in errors.items()}
        return [Trial(self.chains, n, smooth, grid[best[n]], errors[n][best[n]], spent[n]) for n in counts]


def residuals(joint: Joint, fitted: Fitted, sites: np.ndarray) -> np.ndarray:
    """(n, 3 V): what chains leave at sites."""
    coefficients = fitted.at(joint.presses.places[sites])
    return np.array([joint.presses.fields[k] - joint.displacement(k, here) for k, here in zip(sites, coefficients)])


def choose(trials: list[Trial]) -> Trial:
    """The smallest response that does nearly as well as the best one."""
    best = min(trial.score for trial in trials)
    return min((t for t in trials if t.score <= NEARLY * best), key=lambda trial: (trial.numbers, trial.score))


def closed(coefficients: np.ndarray, chains: Chains) -> np.ndarray:
    """(V, P, 2 + 6 H) in single precision such that the sum of a_0 is 1 in whatever order it is taken."""
    coefficients = coefficients.reshape(-1, chains.count, chains.per_chain).astype("f4")
    shares = coefficients[:, :, 0].astype(float)
    # Multiples of a step so large that no sum of them needs more digits than a single has.
    step = 2.0 ** (np.ceil(np.log2(1 + np.abs(shares).sum(axis=1).max())) - 23)
    shares = np.round(shares / step) * step
    shares[:, -1] = 1 - shares[:, :-1].sum(axis=1)
    coefficients[:, :, 0] = shares
    return coefficients


def try_all(presses: Presses, job: dict, say) -> list[Trial]:
    """Every candidate with every number of modes."""
    judge, trials = Judge(presses, job["near_m"]), []
    candidates = [Chains(tuple(c["decays_m"]), tuple(c["reaches_m"]), c["harmonics"]) for c in job["candidates"]]
    fewest = len(presses) - -(-len(presses) // job["folds"])
    counts = [count for count in sorted(job["modes"]) if count < fewest]
    steps = len(candidates) + 2
    say(done=0, of=steps)
    middle = sorted(candidates, key=lambda chains: chains.count * chains.per_chain)[len(candidates) // 2]
    smooth = Validation(presses, middle, judge, job["folds"]).smoothest()
    say(done=1, of=steps)
    for chains in candidates:
        began = time.perf_counter()
        validation = Validation(presses, chains, judge, job["folds"])
        found = validation.with_modes(counts, smooth, validation.chains_alone(smooth)[1])
        shared = time.perf_counter() - began - sum(trial.seconds for trial in found)
        for trial in found:
            trial.seconds += shared
        trials += found
        say(done=len(trials) // len(counts) + 1, of=steps)
    return trials


def check(work: Work) -> None:
    """What no fit can be made of."""
    job = work.job
    if not 2 <= job["folds"] <= len(work.sites):
        raise Refused(f"{job['folds']} folds; accepted: 2 to the number of sites, {len(work.sites)}")
    if not job["candidates"] or not job["modes"]:
        raise Refused("no chains or no numbers of modes to choose from")
    if min(job["modes"]) >= len(work.sites) - -(-len(work.sites) // job["folds"]):
        raise Refused(f"{min(job['modes'])} body modes of {len(work.sites)} sites: take more sites")


def main(folder: Path, say) -> None:
    """Chooses, fits to all sites, writes."""
    work = Work.read(folder)
    check(work)
    job = work.job
    displacement, _ = work.presses()
    contact = Contact(job["contact_radius_m"], job["ramp_m"])
    presses = Presses(work.vertices, work.normals, work.sites, work.arcs(), displacement, contact)
    trials = try_all(presses, job, say)
    chosen, steps = choose(trials), len(job["candidates"]) + 2
    save(folder / "fit.npz", **final(presses, chosen), choices=np.array([t.row() for t in trials]), chosen=trials.index(chosen))
    say(done=steps, of=steps)


def final(presses: Presses, chosen: Trial) -> dict:
    """The response of the whole body from all sites."""
    every, chains = np.arange(len(presses)), chosen.chains
    joint = Joint(presses, chains)
    fitted = joint.fit(every, chosen.smooth)
    fields, amplitudes = np.zeros((0, len(presses.vertices), 3)), np.zeros((len(presses.vertices), 0))
    if chosen.modes:
        modes = Modes.of(residuals(joint, fitted, every), presses.rise, presses.places, chosen.modes)
        # The product multiplies by the depth with its sign: a press is a negative elongation.
        fields = -modes.fields.reshape(chosen.modes, -1, 3)
        amplitudes = modes.at(presses.all, chosen.likeness)
    return {
        "decays_m": np.array(chains.decays),
        "reaches_m": np.array(chains.reaches),
        "harmonics": np.array(chains.harmonics),
        "coefficients": closed(fitted.at(presses.all), chains),
        "amplitudes": amplitudes.astype("<f4"),
        "modes": fields.astype("<f4"),
        "site_errors": chosen.errors,
    }


if __name__ == "__main__":
    run(main)
