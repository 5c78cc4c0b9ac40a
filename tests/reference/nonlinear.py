"""Pressing deeper than small strain allows: three sites of the liver, neo-Hookean at large strain.

    python nonlinear.py [--depths 5] [--rhombus PROGRAM]     writes results/liver_nonlinear.npz and liver_nonlinear.csv

The first three held-out sites of liver_r5.npz. The mesh is coarser than there, so the linear solution on the same mesh goes with
it. Equilibria are kept in `solutions/`, so that a longer series goes on where a shorter one ended. Checks that are part of the
run: 0.1 mm against the linear solution, what is left of the forces in equilibrium, and the work of the force down to each
depth against the energy there."""

import argparse
from dataclasses import asdict

import numpy as np
from scipy.interpolate import CubicSpline

import shared  # noqa: F401

import sites
from liver import HERE, POISSON, RADII, RESULTS, YOUNG, kept, make_liver, rounded, write
from mesh import Mesh
from neo_hookean import Body, Inverted, Press, State
from surface import Surface
from tables import percent, write_csv

DEPTHS = (1e-3, 2.5e-3, 5e-3, 7.5e-3, 10e-3)
SMALL = 0.1e-3
MESH = {"cells": 4.0, "growth": 0.6, "ratio": 1.4}


def relative(found, exact) -> float:
    return float(np.linalg.norm(found - exact) / np.linalg.norm(exact))


def press(body: Surface, vertex: int, depths) -> dict:
    """Arrays over the depths reached."""
    mesh = Mesh(body, sites.base(body), [vertex], RADII[:1], **MESH)
    patches = mesh.assemble(YOUNG, POISSON)
    linear = patches.press(mesh.touched[0][0])
    patches.close()
    count = len(body.vertices)
    disc = Press(Body(mesh.nodes, mesh.tets, YOUNG, POISSON), mesh.fixed, mesh.touched[0][0], mesh.normals[0])

    def to(depth: float) -> State:
        disc.state = State(**kept(f"nonlinear_{vertex}_{1e3 * depth:.1f}", lambda: asdict(disc.to(depth))))
        return disc.state

    small, reached = to(SMALL), []
    for depth in depths:
        try:
            reached.append(to(depth))
        except Inverted:
            print(f"site {vertex}: no equilibrium found beyond {1e3 * disc.state.depth:.2f} mm", flush=True)
            break
    disc.close()
    found = {name: np.array([getattr(s, name) for s in reached]) for name in ("depth", "force", "energy", "residual")}
    curve = CubicSpline([0, SMALL, *found["depth"]], [0, small.force, *found["force"]])
    return found | {
        "displacement": np.array([rounded(s.displacement[:count] / s.depth) for s in reached]),
        "work": np.array([curve.integrate(0, depth) for depth in found["depth"]]),
        "linear_stiffness": linear.stiffness[0],
        "linear_displacement": rounded(linear.displacement[:count]),
        "small_stiffness": small.force / SMALL / linear.stiffness[0] - 1,
        "small_displacement": relative(small.displacement / SMALL, linear.displacement),
        "dofs": mesh.size["dofs"],
    }


def run(body: Surface, depths) -> None:
    chosen = sites.choose(body, sites.COUNT)[sites.held_out(sites.COUNT)][:3]
    done = [press(body, int(vertex), depths) for vertex in chosen]
    each = [len(d["depth"]) for d in done]
    depth, force = (np.concatenate([d[name] for d in done]) for name in ("depth", "force"))
    write(
        "liver_nonlinear.npz",
        body,
        np.repeat(chosen, each),
        RADII[0],
        POISSON,
        force / depth,
        np.concatenate([d["displacement"] for d in done]),
        np.ones(len(depth)),
        depth=depth,
        linear_stiffness=np.repeat([d["linear_stiffness"] for d in done], each),
        linear_site_vertex=chosen.astype("<i4"),
        linear_displacement=np.array([d["linear_displacement"] for d in done]),
    )
    rows = []
    for vertex, d in zip(chosen, done):
        linear = d["linear_displacement"].astype(float)
        rows.append(
            {
                "site_vertex": vertex,
                "depth_mm": SMALL * 1e3,
                "secant_against_linear_percent": percent(d["small_stiffness"]),
                "displacement_against_linear_percent": percent(d["small_displacement"]),
            }
        )
        for k, depth in enumerate(d["depth"]):
            secant = d["force"][k] / depth
            rows.append(
                {
                    "site_vertex": vertex,
                    "depth_mm": f"{depth * 1e3:.1f}",
                    "secant_against_linear_percent": percent(secant / d["linear_stiffness"] - 1),
                    "displacement_against_linear_percent": percent(relative(d["displacement"][k].astype(float), linear)),
                    "secant_n_per_m": f"{secant:.2f}",
                    "force_n": f"{d['force'][k]:.4f}",
                    "work_against_energy_percent": percent(d["work"][k] / d["energy"][k] - 1),
                    "residual_over_force": f"{d['residual'][k]:.1e}",
                }
            )
    write_csv(RESULTS / "liver_nonlinear.csv", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rhombus", default=str(HERE.parents[1] / "target" / "release" / "rhombus"))
    parser.add_argument("--depths", type=int, default=len(DEPTHS), help="how many of the depths, from the smallest on")
    options = parser.parse_args()
    run(make_liver(options.rhombus), DEPTHS[: options.depths])
