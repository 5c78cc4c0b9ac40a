"""What `rhombus calibrate --body` fits is the model that the product runs. Needs numpy and pytest only; what needs the finite
elements is skipped without them."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import shared  # noqa: F401

import fit
from directions import Chains, Contact, carriers, tangent_frames
from joint import Joint, Presses, Smoothness
from kriging import Places, solve_positive
from material import within, young
from modes import Likeness, Modes
from work import Refused

PROGRAMS = Path(fit.__file__).parent
RADIUS, CONTACT = 0.05, Contact(0.004, 0.004)
CHAINS = Chains((0.008, 0.04), (0.112, 0.56), 2)
RNG = np.random.default_rng(7)


def rotation() -> np.ndarray:
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    return turn * np.linalg.det(turn)


class Ball:
    """Points spread over a sphere; `smooth`: coefficients of tensors that vary smoothly over it, in the frames of `normals`."""

    def __init__(self, count=500, sites=60, turn=np.eye(3)):
        z = 1 - (2 * np.arange(count) + 1) / count
        angle = np.pi * (3 - 5**0.5) * np.arange(count)
        flat = np.sqrt(1 - z**2)
        self.plain = np.stack([flat * np.cos(angle), flat * np.sin(angle), z], axis=1)
        self.turn, self.normals = turn, self.plain @ turn.T
        self.vertices = RADIUS * self.normals
        self.sites = np.random.default_rng(5).permutation(count)[:sites]

    def arcs(self, vertices):
        chord = np.linalg.norm(self.vertices[vertices][:, None] - self.vertices[None], axis=2)
        return 2 * RADIUS * np.arcsin(np.minimum(chord / (2 * RADIUS), 1))

    def smooth(self, vertices):
        """Of tensors linear in the position on a ball that is turned back."""
        carrier = carriers(self.normals[vertices], CHAINS.harmonics)
        fixed = np.random.default_rng(11).normal(size=(CHAINS.count, 38, 4)) * 0.2
        linear = np.einsum("pdk,nk->npd", fixed, np.concatenate([np.ones((len(vertices), 1)), self.plain[vertices]], axis=1))
        tensors = np.array([[self._turned(t) for t in of_vertex] for of_vertex in linear])
        found = np.einsum("ndc,npd->npc", carrier, tensors)
        found[:, :, 0] += (1 - found[:, :, 0].sum(axis=1, keepdims=True)) / CHAINS.count
        return found.reshape(len(vertices), -1)

    def _turned(self, tensor):
        """Scalars, vectors and 3 x 3 tensors in the order of `carriers`."""
        t, turned = self.turn, []
        for begin, size in ((0, 1), (1, 3), (4, 9), (13, 1), (14, 3), (17, 9), (26, 3), (29, 9)):
            part = tensor[begin : begin + size]
            turned.append(part if size == 1 else t @ part if size == 3 else (t @ part.reshape(3, 3) @ t.T).ravel())
        return np.concatenate(turned)

    def fields(self, vertices, coefficients):
        pairs = zip(vertices, self.arcs(vertices), coefficients)
        return np.array([CONTACT.fields(CHAINS, self.vertices, v, self.normals[v], a) @ c for v, a, c in pairs])

    def presses(self):
        fields = self.fields(self.sites, self.smooth(self.sites)).astype("f4")
        return Presses(self.vertices, self.normals, self.sites, self.arcs(self.sites), fields, CONTACT)


@pytest.fixture(scope="module")
def ball():
    return Ball()


def others(ball):
    return np.setdiff1d(np.arange(len(ball.vertices)), ball.sites)[::9]


def fitted(ball):
    return Joint(ball.presses(), CHAINS).fit(np.arange(len(ball.sites)), Smoothness(0.3 * 2 * RADIUS * 3**0.5, 1e-6))


def test_tangent_frames_are_those_of_the_product():
    # nodes/rhombus_chain/src/response.rs: across the axis to which the normal is least parallel, x before y before z.
    frames = tangent_frames(np.array([[0.0, 0, 1], [1, 0, 0], [0.6, 0, -0.8], [0.48, -0.6, 0.64]]))
    expected = [[[0, 1, 0], [-1, 0, 0]], [[0, 0, 1], [0, -1, 0]], [[0.8, 0, 0.6], [0, -1, 0]]]
    assert np.allclose(frames[:3], expected)
    normal, (first, second) = np.array([0.48, -0.6, 0.64]), frames[3]
    assert np.allclose(np.cross(first, second), normal) and first @ normal == pytest.approx(0) and first[0] == 0


def test_a_press_moves_the_contact_against_its_normal_and_each_coefficient_as_the_model_says():
    vertices = np.array([[0.0, 0, 0], [0, 0.02, 0], [-0.02, 0, 0]])  # the contact; along the first vector; along the second
    arcs, normal, chains = np.array([0, 0.02, 0.02]), np.array([0.0, 0, 1]), Chains((0.01,), (0.14,), 1)
    fields = CONTACT.fields(chains, vertices, 0, normal, arcs).reshape(3, 3, 8)
    assert np.array_equal(fields[0, :, 0], [0, 0, -1]) and (fields[0, :, 1:] == 0).all()
    end = np.exp(-14)
    g = (np.exp(-0.016 / 0.01) - end) / (1 - end)
    # a0 a1 b1, c0 c1 d1, e1 o1
    assert np.allclose(fields[1] / -g, np.array([[0, 0, 0, 0, 0, 0, -1, 0], [0, 0, 0, 1, 1, 0, 0, 0], [1, 1, 0, 0, 0, 0, 0, 0]]))
    assert np.allclose(fields[2] / -g, np.array([[0, 0, 0, -1, 0, -1, 0, 0], [0, 0, 0, 0, 0, 0, 0, -1], [1, 0, 1, 0, 0, 0, 0, 0]]))


def test_a_body_that_is_of_the_model_is_recovered_where_it_was_not_pressed(ball):
    unseen = others(ball)
    truth = ball.fields(unseen, ball.smooth(unseen))
    found = ball.fields(unseen, fitted(ball).at(Places(ball.vertices, ball.normals)[unseen]))
    off = np.linalg.norm(found - truth, axis=1) / np.linalg.norm(truth, axis=1)
    assert np.median(off) < 0.005 and off.max() < 0.03


def test_a_turned_body_answers_with_the_turned_field(ball):
    turned, unseen = Ball(turn=rotation()), others(ball)
    plain, found = (
        b.fields(unseen, fitted(b).at(Places(b.vertices, b.normals)[unseen])).reshape(len(unseen), -1, 3) for b in (ball, turned)
    )
    assert np.abs(found - plain @ turned.turn.T).max() < 2e-3


def test_the_shares_of_the_chains_add_up_to_one_in_single_precision_in_any_order():
    for size in (0.1, 3.0, 200.0):
        chains = Chains((1.0,) * 7, (14.0,) * 7, 1)
        raw = RNG.normal(size=(400, 7, 8)) * size
        raw[:, :, 0] += (1 - raw[:, :, 0].sum(axis=1, keepdims=True)) / 7
        exact = fit.closed(raw.reshape(400, -1), chains)
        assert exact.dtype == "f4" and np.abs(exact - raw).max() < 1e-5 * size * 10
        for order in (range(7), range(6, -1, -1), RNG.permutation(7)):
            total = np.zeros(400, dtype="f4")
            for p in order:
                total = total + exact[:, p, 0]
            assert (total == 1).all()


def test_modes_show_what_is_common_to_the_places_and_smooth_over_them(ball):
    places, count = Places(ball.vertices, ball.normals), len(ball.vertices)
    fields, rise = RNG.normal(size=(2, 3 * count)), np.repeat(CONTACT.rise(ball.arcs(np.arange(count))), 3, axis=1)
    amplitudes = np.stack([ball.normals[:, 0], 1 + ball.normals[:, 2] * ball.normals[:, 1]], axis=1)
    left = (rise * (amplitudes @ fields)).astype("f4")
    modes = Modes.of(left[ball.sites], rise[ball.sites].astype("f4"), places[ball.sites], 2)
    unseen = others(ball)
    found = rise[unseen] * modes.show(places[unseen], Likeness(0.06, 1e-4))
    assert np.linalg.norm(found - left[unseen]) < 0.02 * np.linalg.norm(left[unseen])


def test_the_solver_solves():
    root = RNG.normal(size=(300, 300))
    matrix, right = root @ root.T + np.eye(300), RNG.normal(size=300)
    assert np.allclose(solve_positive(matrix.copy(), right, block=64), np.linalg.solve(matrix, right))


def test_a_smaller_response_wins_when_it_is_within_two_percent():
    def trial(harmonics, modes, error):
        chains = Chains((0.01,), (0.14,), harmonics)
        return fit.Trial(chains, modes, None, None, np.full((5, 2), error), 0.0)

    large, nearly, worse = trial(2, 16, 0.100), trial(1, 8, 0.1015), trial(0, 0, 0.103)
    assert fit.choose([large, nearly, worse]) is nearly and fit.choose([large, worse]) is large


def test_a_second_material_fills_its_region():
    nodes, tets = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [4, 4, 4]]), np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
    job = {"young_pa": 1.0, "second": {"young_pa": 9.0, "region": {"ball": [1, 1, 1, 0.5]}}}
    assert young(job, nodes, tets).tolist() == [9, 1]
    x = np.array([[0.0, 0, 0], [1, 2, 3]])
    assert within({"plane": [0, 0, 1, 2]}, x).tolist() == [True, False]
    assert within({"box": [0.5, 1, 2, 3, 3, 3]}, x).tolist() == [False, True]
    job["second"]["region"] = {"ball": [9, 9, 9, 0.5]}
    with pytest.raises(Refused, match="no part of the body"):
        young(job, nodes, tets)


@pytest.fixture
def work(ball, tmp_path):
    """A folder as `rhombus calibrate --body` makes it, of a ball of the model."""
    count, sites = len(ball.vertices), ball.sites
    job = {"format": 1, "vertices": count, "faces": 1, "sites": sites.tolist(), "batches": [list(range(60))], "near_m": 0.03}
    job |= {"young_pa": 1e4, "poisson": 0.45, "second": None, "contact_radius_m": 0.004, "ramp_m": 0.004, "folds": 3}
    candidates = [Chains((0.02,), (0.28,), 0), CHAINS]
    job["candidates"] = [{"decays_m": c.decays, "reaches_m": c.reaches, "harmonics": c.harmonics} for c in candidates]
    job["modes"] = [0, 2]
    (tmp_path / "job.json").write_text(json.dumps(job))
    arrays = {"vertices.f64": ball.vertices, "normals.f64": ball.normals, "faces.i32": np.array([[0, 1, 2]], dtype="<i4")}
    arrays |= {"held.u8": np.zeros(count, dtype="u1"), "arcs.f32": ball.arcs(sites).astype("<f4")}
    for name, numbers in arrays.items():
        numbers.tofile(tmp_path / name)
    fields = ball.presses().fields.reshape(60, count, 3)
    np.savez(tmp_path / "press_0.npz", site=np.arange(60), stiffness=np.ones(60), displacement=fields)
    return tmp_path


def run(program, work):
    done = subprocess.run([sys.executable, PROGRAMS / program, work], capture_output=True, text=True)
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines()]


def test_the_program_chooses_the_model_the_body_is_of_and_writes_what_the_product_reads(ball, work):
    status, said = run("fit.py", work)
    assert status == 0 and said[0]["done"] == 0 and said[-1]["done"] == said[-1]["of"] and not list(work.glob("*.part"))
    with np.load(work / "fit.npz") as file:
        found = dict(file)
    count, modes = len(ball.vertices), found["amplitudes"].shape[1]
    assert found["coefficients"].shape == (count, 2, 14) and found["harmonics"] == 2
    assert found["modes"].shape == (modes, count, 3) and found["site_errors"].shape == (60, 2)
    assert found["choices"].shape == (4, 7) and found["choices"][found["chosen"], :3].tolist() == [2, 2, modes]
    unseen = others(ball)
    truth = ball.fields(unseen, ball.smooth(unseen))
    shown = ball.fields(unseen, found["coefficients"][unseen].reshape(len(unseen), -1))
    if modes:  # in the product a press is a negative elongation
        rise = np.repeat(CONTACT.rise(ball.arcs(unseen)), 3, axis=1)
        shown = shown - rise * (found["amplitudes"][unseen] @ found["modes"].reshape(modes, -1))
    off = np.linalg.norm(shown - truth, axis=1) / np.linalg.norm(truth, axis=1)
    assert np.median(off) < 1.5 * found["choices"][found["chosen"], 3] and np.median(off) < 0.05


def test_a_program_says_in_a_sentence_what_it_cannot_read(work):
    arcs = work / "arcs.f32"
    arcs.write_bytes(arcs.read_bytes()[:-4])
    status, said = run("fit.py", work)
    assert status == 2 and "arcs.f32" in said[-1]["error"] and said[-1]["vertex"] is None
    np.savez(work / "press_0.npz", site=np.arange(59), stiffness=np.ones(59), displacement=np.zeros((59, 500, 3)))
    status, said = run("fit.py", work)
    assert status == 2 and "no press at vertex" in said[-1]["error"] and not (work / "fit.npz").exists()


@pytest.fixture
def held_ball(tmp_path):
    """A folder of a ball of elastic material, held below; sites: the top, and a vertex on the rim of what is held."""
    pytest.importorskip("pypardiso")
    pytest.importorskip("tetgen")
    pytest.importorskip("skfem")
    from surface import icosphere

    body = icosphere(np.zeros(3), RADIUS, level=3)
    held = body.vertices[:, 2] < -0.6 * RADIUS
    height = body.vertices[:, 2]
    sites = [int(height.argmax()), int(np.where(held, np.inf, height).argmin())]
    job = {"format": 1, "vertices": len(held), "faces": len(body.faces), "sites": sites, "batches": [[0]], "young_pa": 1e4}
    job |= {"poisson": 0.45, "second": None, "contact_radius_m": 0.005}
    body.vertices.astype("<f8").tofile(tmp_path / "vertices.f64")
    body.vertex_normals().astype("<f8").tofile(tmp_path / "normals.f64")
    body.faces.astype("<i4").tofile(tmp_path / "faces.i32")
    held.astype("u1").tofile(tmp_path / "held.u8")
    return tmp_path, job, held


def press(work, job):
    (work / "job.json").write_text(json.dumps(job))
    status, said = run("press.py", work)
    assert status == 0 and said[-1] == {"done": len(job["batches"]), "of": len(job["batches"])}
    with np.load(work / "press_0.npz") as file:
        return dict(file)


def test_a_press_sinks_by_one_where_it_is_and_moves_nothing_that_is_held(held_ball):
    work, job, held = held_ball
    found = press(work, job)
    assert found["displacement"][0, job["sites"][0], 2] == pytest.approx(-1, abs=1e-5)
    assert (found["displacement"][0, held] == 0).all() and np.abs(found["displacement"]).max() < 1.5
    before = (work / "press_0.npz").stat().st_mtime_ns
    press(work, job)
    assert (work / "press_0.npz").stat().st_mtime_ns == before, "what is there stays"
    # The problem is linear in Young's modulus: twice as stiff everywhere, twice the force, the same field.
    (work / "press_0.npz").unlink()
    job["second"] = {"young_pa": 2e4, "region": {"plane": [0, 0, 1, 1]}}
    stiff = press(work, job)
    assert stiff["stiffness"][0] == pytest.approx(2 * found["stiffness"][0], rel=1e-9)
    assert np.abs(stiff["displacement"] - found["displacement"]).max() < 1e-6


def test_a_disc_on_what_is_held_is_refused_with_its_vertex(held_ball):
    work, job, _ = held_ball
    job["contact_radius_m"], job["batches"] = 0.02, [[0], [1]]
    (work / "job.json").write_text(json.dumps(job))
    status, said = run("press.py", work)
    assert status == 2 and said[-1]["vertex"] == job["sites"][1] and "held" in said[-1]["error"]
    assert (work / "press_0.npz").exists() and not (work / "press_1.npz").exists()
