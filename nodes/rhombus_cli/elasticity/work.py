"""The folder in which `rhombus calibrate --body` hands its work to these programs, and how they answer.

`job.json` and the raw arrays beside it (little-endian, C order, metres) come from there. Answers are files that appear whole or
not at all, and lines of JSON on standard output: {"done": i, "of": n}, or {"error": sentence, "vertex": v or null} and
exit status 2."""

import json
import os
import sys
import traceback
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FORMAT = 1


class Refused(Exception):
    """What cannot be done, in one sentence; `vertex`: of the surface, when it lies at one."""

    def __init__(self, sentence: str, vertex: int | None = None):
        super().__init__(sentence)
        self.vertex = None if vertex is None else int(vertex)


@dataclass
class Work:
    """`job`: see job.json; vertices, normals (V, 3); faces (T, 3); held (V,) bool; sites (S,): vertices."""

    folder: Path
    job: dict
    vertices: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    held: np.ndarray
    sites: np.ndarray

    @classmethod
    def read(cls, folder: Path) -> "Work":
        folder = Path(folder)
        job = json.loads((folder / "job.json").read_text())
        if job.get("format") != FORMAT:
            raise Refused(f"{folder / 'job.json'}: format {job.get('format')}; accepted: {FORMAT}")
        count = job["vertices"]
        return cls(
            folder,
            job,
            array(folder / "vertices.f64", "<f8", (count, 3)),
            array(folder / "normals.f64", "<f8", (count, 3)),
            array(folder / "faces.i32", "<i4", (job["faces"], 3)).astype(np.int64),
            array(folder / "held.u8", "u1", (count,)).astype(bool),
            np.array(job["sites"], dtype=np.int64),
        )

    def arcs(self) -> np.ndarray:
        """(S, V) m, from each site; 1e9 where nothing connects."""
        return array(self.folder / "arcs.f32", "<f4", (len(self.sites), len(self.vertices)))

    def press_file(self, batch: int) -> Path:
        return self.folder / f"press_{batch}.npz"

    def presses(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacement (S, V, 3), m per m of depth, and stiffness (S,), N/m, of all sites, from the files of all batches."""
        displacement = np.full((len(self.sites), len(self.vertices), 3), np.nan, dtype="f4")
        stiffness = np.full(len(self.sites), np.nan)
        for batch in range(len(self.job["batches"])):
            with np.load(self.press_file(batch)) as found:
                displacement[found["site"]] = found["displacement"]
                stiffness[found["site"]] = found["stiffness"]
        for of_site, vertex in zip(displacement, self.sites):
            if not np.isfinite(of_site).all():
                raise Refused(f"no press at vertex {vertex} in the files press_*.npz of {self.folder}", vertex)
        return displacement, stiffness


def array(path: Path, kind: str, shape: tuple) -> np.ndarray:
    """The numbers of a raw file."""
    wanted, found = np.dtype(kind).itemsize * int(np.prod(shape)), path.stat().st_size
    if found != wanted:
        raise Refused(f"{path}: {found} bytes; accepted: {wanted}")
    return np.fromfile(path, dtype=kind).reshape(shape)


def save(path: Path, **arrays) -> None:
    """Writes an .npz file that is there whole or not at all."""
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "wb") as file:
            np.savez(file, **arrays)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def run(main) -> None:
    """Runs `main(folder, say)` on the folder named on the command line; `say(**values)` prints a line of JSON."""
    # Libraries written in C print what they like; it goes where it is no answer.
    answers = os.fdopen(os.dup(1), "w")
    sys.stdout.flush()
    os.dup2(2, 1)

    def say(**values) -> None:
        print(json.dumps(values), file=answers, flush=True)

    if len(sys.argv) != 2:
        raise SystemExit(f"usage: {Path(sys.argv[0]).name} WORK")
    try:
        main(Path(sys.argv[1]), say)
    except Refused as refused:
        say(error=str(refused), vertex=refused.vertex)
        raise SystemExit(2) from None
    except Exception as failure:
        traceback.print_exc()
        say(error=f"{Path(sys.argv[0]).name}: {type(failure).__name__}: {failure}", vertex=None)
        raise SystemExit(2) from None
