"""The reference solutions of the liver.

    python liver.py sites|nu|inclusion|two|convergence|tets [--rhombus PROGRAM] [--sites 48]

Every solution is kept in `solutions/` (not committed), so that an interrupted run goes on where it was; the committed
files in `results/` are written from them. `sites` writes liver_r5.npz and liver_r2.npz after every eighth site."""

import argparse
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import contact
import elasticity
import sites
import volume
from divide import RIM_SET_BACK, SizeField, divide
from surface import Disc, Surface, icosphere, read_obj
from tables import percent, write_csv

HERE = Path(__file__).parent
RESULTS = HERE / "results"
SOLUTIONS = HERE / "solutions"
YOUNG, POISSON = 10e3, 0.45
RADII = (0.005, 0.002)
INCLUSION_FACTOR, INCLUSION_RADIUS, INCLUSION_DEPTH = 10.0, 0.008, 0.012


class Mesh:
    """The liver divided around some sites, every disc's rim set back (see RIM_SET_BACK). `discs`: [site][radius]."""

    def __init__(self, body: Surface, vertices, radii=RADII, cells=8.0, growth=0.5, ratio=1.3, most=np.inf, inner=None):
        normals = body.vertex_normals()
        back = 1 - RIM_SET_BACK / cells
        self.normals = [normals[v] for v in vertices]
        self.discs = [[Disc(body.vertices[v], normals[v], back * r) for r in radii] for v in vertices]
        size = SizeField([d for of_site in self.discs for d in of_site], cells, growth=growth, most=most)
        self.surface, parent = divide(body, size)
        self.nodes, self.tets = volume.fill(self.surface, inner, ratio)
        self._corners, self._base = body.faces[parent], body.base()

    def assemble(self, young, poisson) -> contact.Patches:
        """Model and factor; afterwards `model`, the nodes `held`, and `touched[site][radius]`, the nodes of each disc."""
        self.model = model = elasticity.assemble(self.nodes, self.tets, young, poisson)
        faces6 = contact.surface_nodes(model, self.surface)
        self.held = held = contact.fixed_nodes(faces6, self._corners, self._base)
        self.touched = [[contact.touched_nodes(model, self.surface, faces6, d) for d in of_site] for of_site in self.discs]
        self.size = {"elements": len(self.tets), "dofs": 3 * len(model.nodes)}
        return contact.Patches(model, held, self.normals, [of_site[0] for of_site in self.touched])


def rounded(x: np.ndarray) -> np.ndarray:
    """float32 with 12 bits of mantissa: what compresses away is below 0.02 % of each value."""
    mantissa, exponent = np.frexp(x)
    return np.ldexp(np.round(mantissa * 4096) / 4096, exponent).astype("<f4")


def kept(name: str, compute) -> dict:
    """A solution from `solutions/`, computed if it is not there."""
    SOLUTIONS.mkdir(exist_ok=True)
    path = SOLUTIONS / f"{name}.npz"
    if not path.exists():
        start = time.perf_counter()
        np.savez_compressed(path, **compute())
        print(f"{name}: {time.perf_counter() - start:.1f} s", flush=True)
    with np.load(path) as data:
        return dict(data)


def solve(body: Surface, vertices, radii, young=YOUNG, poisson=POISSON, **mesh_options) -> dict:
    """Unit depth at all `vertices` at once, for each radius: displacement (R, V, 3) and stiffness (R, sites)."""
    mesh = Mesh(body, vertices, radii, **mesh_options)
    patches = mesh.assemble(young, poisson)
    answers = [patches.press(np.concatenate([of_site[k] for of_site in mesh.touched])) for k in range(len(radii))]
    patches.close()
    return {
        "displacement": rounded(np.array([a.displacement[: len(body.vertices)] for a in answers])),
        "stiffness": np.array([a.stiffness for a in answers]),
        "elements": mesh.size["elements"],
        "dofs": mesh.size["dofs"],
    }


def write(name: str, body: Surface, site_vertex, radius, poisson, stiffness, displacement, held_out, **more) -> None:
    """One results file; see README.md for the arrays."""
    site_vertex = np.asarray(site_vertex)
    count = len(site_vertex)
    np.savez_compressed(
        RESULTS / name,
        vertices=body.vertices.astype("<f8"),
        faces=body.faces.astype("<i4"),
        fixed=body.base().astype("u1"),
        site_vertex=site_vertex.astype("<i4"),
        point=body.vertices[site_vertex],
        normal=body.vertex_normals()[site_vertex],
        contact_radius=np.full(count, radius),
        young=np.full(count, YOUNG),
        poisson=np.broadcast_to(np.asarray(poisson, dtype="<f8"), (count,)).copy(),
        stiffness=np.asarray(stiffness, dtype="<f8"),
        displacement=np.asarray(displacement, dtype="<f4"),
        held_out=np.asarray(held_out).astype("u1"),
        **more,
    )
    print(f"wrote {name}: {count} solutions, {(RESULTS / name).stat().st_size / 1e6:.2f} MB", flush=True)


def run_sites(body: Surface, count: int) -> None:
    chosen, done = sites.choose(body, count), []
    for vertex in chosen:
        done.append(kept(f"site_{vertex}", lambda: solve(body, [vertex], RADII)))
        if len(done) % 8 == 0 or len(done) == count:
            for k, radius in enumerate(RADII):
                write(
                    f"liver_r{radius * 1e3:.0f}.npz",
                    body,
                    chosen[: len(done)],
                    radius,
                    POISSON,
                    [d["stiffness"][k, 0] for d in done],
                    [d["displacement"][k] for d in done],
                    sites.held_out(len(done)),
                )


def run_nu(body: Surface, count: int) -> None:
    """The held-out sites again, nearly compressible and nearly incompressible."""
    chosen = sites.choose(body, count)[sites.held_out(count)]
    cases = [(vertex, poisson) for poisson in (0.30, 0.49) for vertex in chosen]
    done = [kept(f"nu{100 * p:.0f}_{v}", lambda: solve(body, [v], RADII[:1], poisson=p)) for v, p in cases]
    vertex, poisson = (np.array(x) for x in zip(*cases))
    stiffness, displacement = [d["stiffness"][0, 0] for d in done], [d["displacement"][0] for d in done]
    write("liver_nu.npz", body, vertex, RADII[0], poisson, stiffness, displacement, np.ones(len(cases)))


def around(body: Surface, vertex: int, distance: float, number: int) -> list[int]:
    """Vertices about `distance` from `vertex` in `number` directions evenly around its normal."""
    disc = Disc(body.vertices[vertex], body.vertex_normals()[vertex], distance)
    _, e, f = contact.frame(disc.normal)
    angle = 2 * np.pi * np.arange(number) / number
    wanted = disc.point + distance * (np.cos(angle)[:, None] * e + np.sin(angle)[:, None] * f)
    near = np.flatnonzero(body.vertex_normals() @ disc.normal > 0.3)
    rho = body.vertices[near] - ((body.vertices[near] - disc.point) @ disc.normal)[:, None] * disc.normal
    return [int(near[np.linalg.norm(rho - w, axis=1).argmin()]) for w in wanted]


def run_inclusion(body: Surface, count: int) -> None:
    """A stiff ball under the first site, felt there and at 8 and 20 mm around it."""
    top = int(sites.choose(body, 1)[0])
    chosen = [top] + [v for mm in (8, 20) for v in around(body, top, mm * 1e-3, 4)]
    centre = body.vertices[top] - INCLUSION_DEPTH * body.vertex_normals()[top]
    ball = icosphere(centre, INCLUSION_RADIUS)

    def one(vertex):
        mesh = Mesh(body, [vertex], RADII[:1], inner=ball)
        inside = np.linalg.norm(mesh.nodes[mesh.tets].mean(axis=1) - centre, axis=1) < INCLUSION_RADIUS
        found = {"ball_volume": volume.volumes(mesh.nodes, mesh.tets[inside]).sum()}
        for name, factor in (("", INCLUSION_FACTOR), ("_without", 1.0)):
            patches = mesh.assemble(np.where(inside, factor, 1.0) * YOUNG, POISSON)
            answer = patches.press(mesh.touched[0][0])
            patches.close()
            found["stiffness" + name] = answer.stiffness[0]
            found["displacement" + name] = rounded(answer.displacement[: len(body.vertices)])
        return found

    done = [kept(f"inclusion_{v}", lambda: one(v)) for v in chosen]
    write(
        "liver_inclusion.npz",
        body,
        chosen,
        RADII[0],
        POISSON,
        [d["stiffness"] for d in done],
        [d["displacement"] for d in done],
        np.arange(len(chosen)) % 4 == 3,
        stiffness_without=np.array([d["stiffness_without"] for d in done], dtype="<f8"),
        inclusion_centre=centre,
        inclusion_radius=np.array(INCLUSION_RADIUS),
        inclusion_factor=np.array(INCLUSION_FACTOR),
    )


def run_two(body: Surface, count: int) -> None:
    """Two discs at once: the first four held-out sites, each with a vertex about 16 and one about 35 mm away."""
    pairs = []
    clear = np.isin(np.arange(len(body.vertices)), sites.candidates(body))
    for k, vertex in enumerate(sites.choose(body, count)[sites.held_out(count)][:4]):
        for distance in (0.016, 0.035):
            partners = [v for v in around(body, vertex, distance, 8) if clear[v]]
            pairs.append((int(vertex), partners[k % len(partners)]))
    done = [kept(f"two_{a}_{b}", lambda: solve(body, [a, b], RADII[:1])) for a, b in pairs]
    stiffness, displacement = [d["stiffness"][0] for d in done], [d["displacement"][0] for d in done]
    write("liver_two.npz", body, pairs, RADII[0], POISSON, stiffness, displacement, np.ones(len(pairs)))


def make_liver(rhombus: str, vertices: int = 3116) -> Surface:
    """The product's own liver."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "liver.obj"
        subprocess.run([rhombus, "mesh", "make", "liver", "--vertices", str(vertices), "--output", path], check=True)
        return read_obj(path)


# The mesh of the results, and others to judge it by.
MESHES = {
    "coarser": {"cells": 6.0, "growth": 0.6, "ratio": 1.4},
    "as used": {},
    "finer at the disc": {"cells": 12.0, "growth": 0.35, "ratio": 1.2},
    "finer everywhere": {"cells": 8.0, "growth": 0.5, "ratio": 1.3, "most": 0.003},
}


def run_convergence(body: Surface, count: int) -> None:
    """The top and the last two held-out sites (upper side, left end) on other meshes, compared with the one used."""
    chosen = sites.choose(body, count)
    rows = []
    for vertex in [chosen[0], *chosen[sites.held_out(count)][-2:]]:
        used = kept(f"site_{vertex}", lambda: solve(body, [vertex], RADII))
        near = np.linalg.norm(body.vertices - body.vertices[vertex], axis=1) < 0.030
        for name, options in MESHES.items():
            if name == "finer everywhere" and vertex != chosen[0]:
                continue  # three times the unknowns
            other = used if not options else kept(
                f"convergence_{vertex}_{name.replace(' ', '_')}", lambda: solve(body, [vertex], RADII, **options)
            )
            for k, radius in enumerate(RADII):
                a, b = used["displacement"][k].astype(float), other["displacement"][k].astype(float)
                rows.append(
                    {
                        "site_vertex": vertex,
                        "contact_radius_mm": radius * 1e3,
                        "mesh": name,
                        "elements": other["elements"],
                        "dofs": other["dofs"],
                        "stiffness_n_per_m": f"{other['stiffness'][k, 0]:.3f}",
                        "stiffness_change_percent": percent(other["stiffness"][k, 0] / used["stiffness"][k, 0] - 1),
                        "displacement_change_percent": percent(np.linalg.norm(b - a) / np.linalg.norm(a)),
                        "within_30_mm_percent": percent(np.linalg.norm((b - a)[near]) / np.linalg.norm(a[near])),
                    }
                )
    write_csv(RESULTS / "liver_convergence.csv", rows)


RUNS = {"convergence": run_convergence, "sites": run_sites, "nu": run_nu, "inclusion": run_inclusion, "two": run_two}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", choices=[*RUNS, "tets"])
    parser.add_argument("--rhombus", default=str(HERE.parents[1] / "target" / "release" / "rhombus"))
    parser.add_argument("--sites", type=int, default=sites.COUNT)
    options = parser.parse_args()
    if options.run == "tets":
        for size in (500, 1000, 3116):
            volume.write_peers(make_liver(options.rhombus, size), HERE / "tets" / f"liver_{size}.npz")
    else:
        RUNS[options.run](make_liver(options.rhombus), options.sites)
