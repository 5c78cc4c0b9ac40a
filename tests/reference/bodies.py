"""Two more bodies to judge calibrations by: a block with sharp edges, and a lens with a thin one.

    python bodies.py block|wedge|convergence [--rhombus PROGRAM]

Eight sites each, all held out, by the rule of sites.py; disc and material as for liver_r5.npz, and its mesh, with shorter edges
away from the disc (see `MOST_M`). Solutions are kept in `solutions/` as those of the liver."""

import argparse
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import shared  # noqa: F401

import sites
import wedge
from liver import HERE, POISSON, RADII, RESULTS, kept, solve, write
from surface import Surface, read_obj
from tables import percent, write_csv

BLOCK_VERTICES = 2616
# No edge of the surface above 1.5 times this. Without it the wedge is 2 % too stiff: it bends, and its sides are close together.
MOST_M = 0.003


@dataclass
class Held(Surface):
    """A surface with its own choice of the vertices held, (V,) bool."""

    held: np.ndarray


def make_block(rhombus: str) -> Held:
    """The product's block, 100 x 80 x 50 mm, held at all of its lowest face."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "block.obj"
        command = [rhombus, "mesh", "make", "block", "--vertices", str(BLOCK_VERTICES), "--output", path]
        subprocess.run(command, check=True)
        body = read_obj(path)
    height = body.vertices[:, 2]
    return Held(body.vertices, body.faces, height < height.min() + 1e-9)


def make_wedge(_rhombus: str) -> Held:
    """The committed lens, held in the middle of its underside."""
    body = read_obj(wedge.PATH)
    return Held(body.vertices, body.faces, wedge.held(body))


BODIES = {"block": make_block, "wedge": make_wedge}


def chosen_sites(body: Held) -> np.ndarray:
    return sites.choose(body, sites.COUNT)[sites.held_out(sites.COUNT)]


def solution(name: str, body: Held, vertex: int) -> dict:
    return kept(f"{name}_{vertex}", lambda: solve(body, [vertex], RADII[:1], most=MOST_M))


def run(name: str, body: Held) -> None:
    chosen = chosen_sites(body)
    done = [solution(name, body, vertex) for vertex in chosen]
    stiffness, displacement = [d["stiffness"][0, 0] for d in done], [d["displacement"][0] for d in done]
    write(f"{name}_r5.npz", body, chosen, RADII[0], POISSON, stiffness, displacement, np.ones(len(chosen)))


# The mesh of the results, and others to judge it by.
MESHES = {"edges as for the liver": {"most": np.inf}, "as used": None, "finer everywhere": {"most": 0.002}}


def run_convergence(bodies: dict[str, Held]) -> None:
    """The first and fourth sites of each body on other meshes, compared with the one used."""
    rows = []
    for name, body in bodies.items():
        for vertex in chosen_sites(body)[[0, 3]]:
            used = solution(name, body, vertex)
            near = np.linalg.norm(body.vertices - body.vertices[vertex], axis=1) < 0.030
            for mesh, options in MESHES.items():
                other = used if options is None else kept(
                    f"convergence_{name}_{vertex}_{mesh.replace(' ', '_')}",
                    lambda: solve(body, [vertex], RADII[:1], **options),
                )
                a, b = used["displacement"][0].astype(float), other["displacement"][0].astype(float)
                rows.append(
                    {
                        "body": name,
                        "site_vertex": vertex,
                        "mesh": mesh,
                        "elements": other["elements"],
                        "dofs": other["dofs"],
                        "stiffness_n_per_m": f"{other['stiffness'][0, 0]:.3f}",
                        "stiffness_change_percent": percent(other["stiffness"][0, 0] / used["stiffness"][0, 0] - 1),
                        "displacement_change_percent": percent(np.linalg.norm(b - a) / np.linalg.norm(a)),
                        "within_30_mm_percent": percent(np.linalg.norm((b - a)[near]) / np.linalg.norm(a[near])),
                    }
                )
    write_csv(RESULTS / "bodies_convergence.csv", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", choices=[*BODIES, "convergence"])
    parser.add_argument("--rhombus", default=str(HERE.parents[1] / "target" / "release" / "rhombus"))
    options = parser.parse_args()
    if options.run == "convergence":
        run_convergence({name: make(options.rhombus) for name, make in BODIES.items()})
    else:
        run(options.run, BODIES[options.run](options.rhombus))
