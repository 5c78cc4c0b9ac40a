"""Unit presses of a rigid frictionless flat disc at the sites of a calibration, one at a time.

    python press.py WORK          writes WORK/press_0.npz, press_1.npz, ...; what is there already stays

The sites of a batch share a mesh: it is fine around all of them, and factored once. See work.py for the folder."""

import resource
from pathlib import Path

import numpy as np
from pypardiso.pardiso_wrapper import PyPardisoError

import volume
from material import young
from mesh import Mesh, SiteError
from surface import Surface
from work import Refused, Work, run, save

# Coarser than the reference solutions': at 40 of their sites on the liver the displacement differs by 1.7 % (median; at most 4.7 %), the
# stiffness by 0.6 % (1.2 %). The second where TetGen or the solver cannot do with the first.
MESHES = ({"cells": 4.0, "growth": 0.6, "ratio": 1.4}, {"cells": 5.0, "growth": 0.5, "ratio": 1.6})
MEMORY = 12 << 30
# What dividing a surface, TetGen and the solver raise when they fail.
FAILURES = (RuntimeError, ValueError, IndexError, ArithmeticError, np.linalg.LinAlgError, PyPardisoError, MemoryError)


def main(folder: Path, say) -> None:
    """Works through the batches that have no file yet."""
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, resource.getrlimit(resource.RLIMIT_DATA)[1]))
    work = Work.read(folder)
    batches = work.job["batches"]
    todo = [k for k, batch in enumerate(batches) if not is_done(work, k, batch)]
    done = len(batches) - len(todo)
    say(done=done, of=len(batches))
    for k in todo:
        displacement, stiffness = press(work, work.sites[batches[k]])
        save(
            work.press_file(k),
            site=np.array(batches[k], dtype="<i4"),
            stiffness=stiffness.astype("<f8"),
            displacement=displacement.astype("<f4"),
        )
        done += 1
        say(done=done, of=len(batches))


def is_done(work: Work, k: int, batch: list[int]) -> bool:
    """Whether the file of a batch is there and is of these sites."""
    try:
        with np.load(work.press_file(k)) as found:
            fits = np.array_equal(found["site"], batch)
            return fits and found["displacement"].shape == (len(batch), *work.vertices.shape)
    except (OSError, ValueError, KeyError, EOFError):
        return False


def press(work: Work, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement (n, V, 3) and stiffness (n,) of unit presses at `vertices`: together if possible, else each on a mesh of
    its own."""
    meshes = MESHES if len(vertices) == 1 else MESHES[:1]
    for options in meshes:
        try:
            return solve(work, vertices, options)
        except SiteError as error:
            raise Refused(str(error), error.vertex) from None
        except FAILURES as error:
            failure = error
    if len(vertices) > 1:
        parts = [press(work, vertices[k : k + 1]) for k in range(len(vertices))]
        return tuple(np.concatenate(part) for part in zip(*parts))
    raise refusal(work, vertices[0], failure)


def solve(work: Work, vertices: np.ndarray, options: dict) -> tuple[np.ndarray, np.ndarray]:
    """The same on one mesh."""
    job, body = work.job, Surface(work.vertices, work.faces)
    mesh = Mesh(body, work.held, vertices, (job["contact_radius_m"],), normals=work.normals, **options)
    patches = mesh.assemble(young(job, mesh.nodes, mesh.tets), job["poisson"])
    try:
        answers = patches.press_each([of_site[0] for of_site in mesh.touched])
    finally:
        patches.close()
    displacement = np.array([answer.displacement[: len(body.vertices)] for answer in answers])
    stiffness = np.array([answer.stiffness[k] for k, answer in enumerate(answers)])
    # Flat elements can make a factor worthless; the vertex at the middle of a disc moves as prescribed if it is not.
    depth = -(displacement[np.arange(len(vertices)), vertices] * work.normals[vertices]).sum(1)
    if not (np.isfinite(displacement).all() and np.abs(depth - 1).max() < 1e-6 and (stiffness > 0).all()):
        raise ArithmeticError("the elements are too flat to be solved")
    return displacement, stiffness


def refusal(work: Work, vertex: int, failure: Exception) -> Refused:
    """Says whether it is the surface as a whole or what the disc makes of it."""
    if isinstance(failure, MemoryError):
        return Refused(f"a press at vertex {vertex} needs more than {MEMORY >> 30} GB: take a surface of fewer triangles")
    try:
        volume.fill(Surface(work.vertices, work.faces), ratio=MESHES[0]["ratio"])
    except FAILURES as error:
        return Refused(f"TetGen finds no tetrahedra for this surface: {sentence(error)}")
    x, y, z = work.vertices[vertex]
    where = f"vertex {vertex} (counted from 0, at {x:.4g} {y:.4g} {z:.4g} m)"
    return Refused(f"no mesh around a disc at {where}: {sentence(failure)}", vertex)


def sentence(failure: Exception) -> str:
    """The first line of what a library says."""
    lines = str(failure).strip().splitlines()
    return lines[0] if lines else type(failure).__name__


if __name__ == "__main__":
    run(main)
