"""The committed reference solutions keep their contract and the laws of elasticity. Needs numpy and pytest only."""

from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).parent
ROUNDING = 2.0**-12
LIVER = ["liver_r5.npz", "liver_r2.npz", "liver_nu.npz", "liver_inclusion.npz", "liver_two.npz"]
BODIES = ["block_r5.npz", "wedge_r5.npz"]
NONLINEAR = "liver_nonlinear.npz"
RESULTS = LIVER + BODIES + [NONLINEAR]
TETS = [500, 1000, 3116]


def read(name: str) -> dict:
    with np.load(HERE / name) as data:
        return dict(data)


@pytest.fixture(params=RESULTS)
def result(request):
    return read(f"results/{request.param}")


def contacts(result: dict):
    """Solution, vertex, normal, stiffness of every contact; liver_two has two for each solution."""
    solutions = len(result["site_vertex"])
    each = result["site_vertex"].reshape(solutions, -1).shape[1]
    for s in range(solutions):
        for c in range(each):
            yield (
                s,
                result["site_vertex"].reshape(solutions, each)[s, c],
                result["normal"].reshape(solutions, each, 3)[s, c],
                result["stiffness"].reshape(solutions, each)[s, c],
            )


def angle_weighted_normals(vertices, faces):
    normals = np.zeros_like(vertices)
    for k in range(3):
        a, b = (vertices[faces[:, (k + j) % 3]] - vertices[faces[:, k]] for j in (1, 2))
        cross = np.cross(a, b)
        length = np.linalg.norm(cross, axis=1)
        np.add.at(normals, faces[:, k], cross * (np.arctan2(length, (a * b).sum(1)) / length)[:, None])
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def test_arrays_have_the_shapes_and_types_of_the_contract(result):
    vertices, solutions = len(result["vertices"]), len(result["site_vertex"])
    each = result["site_vertex"].shape
    assert result["vertices"].shape == (vertices, 3) and result["vertices"].dtype == "<f8"
    assert result["faces"].shape == (2 * vertices - 4, 3) and result["faces"].dtype == "<i4"
    assert result["fixed"].shape == (vertices,) and result["fixed"].dtype == "u1"
    assert result["site_vertex"].dtype == "<i4"
    assert result["point"].shape == result["normal"].shape == (*each, 3)
    assert result["stiffness"].shape == each and result["stiffness"].dtype == "<f8"
    for name in ("contact_radius", "young", "poisson", "held_out"):
        assert result[name].shape == (solutions,), name
    assert result["displacement"].shape == (solutions, vertices, 3) and result["displacement"].dtype == "<f4"
    assert all(np.isfinite(value).all() for value in result.values())


def test_sites_are_vertices_with_the_normals_of_the_mesh(result):
    normals = angle_weighted_normals(result["vertices"], result["faces"])
    assert np.array_equal(result["point"], result["vertices"][result["site_vertex"]])
    assert np.allclose(result["normal"], normals[result["site_vertex"]], atol=1e-12)


@pytest.mark.parametrize("name", [*LIVER, NONLINEAR])
def test_the_base_of_the_liver_is_its_underside(name):
    result = read(f"results/{name}")
    normals = angle_weighted_normals(result["vertices"], result["faces"])
    assert np.array_equal(result["fixed"] == 1, normals[:, 2] < -0.7)


def test_the_block_is_held_at_its_lowest_face_and_the_wedge_in_the_middle_of_its_underside():
    block, wedge = (read(f"results/{name}") for name in BODIES)
    height = block["vertices"][:, 2]
    assert np.array_equal(block["fixed"] == 1, height < height.min() + 1e-9)
    radius = np.linalg.norm(wedge["vertices"][:, :2] / [0.0775, 0.0475], axis=1)
    assert np.array_equal(wedge["fixed"] == 1, (radius <= 0.6) & (wedge["vertices"][:, 2] < 0))


@pytest.mark.parametrize("name", BODIES)
def test_the_other_bodies_have_eight_sites_all_held_out_and_clear_of_the_base(name):
    result = read(f"results/{name}")
    assert len(set(result["site_vertex"])) == 8 and result["held_out"].all()
    base = result["vertices"][result["fixed"] == 1]
    assert np.linalg.norm(result["point"][:, None] - base, axis=2).min() >= 0.010


def test_the_wedge_is_the_committed_mesh():
    lines = (HERE / "meshes" / "wedge.obj").read_text().splitlines()
    vertices = np.array([line.split()[1:] for line in lines if line.startswith("v ")], dtype=float)
    faces = np.array([line.split()[1:] for line in lines if line.startswith("f ")], dtype=int) - 1
    result = read("results/wedge_r5.npz")
    assert np.array_equal(vertices, result["vertices"]) and np.array_equal(faces, result["faces"])


def test_the_thin_edge_gives_way_more_than_the_middle():
    """The edge bends besides being indented: less than 60 % of a half-space's 2 E r / (1 - nu^2), the middle more than it."""
    result = read("results/wedge_r5.npz")
    ratio = result["stiffness"] * (1 - result["poisson"] ** 2) / (2 * result["young"] * result["contact_radius"])
    radius = np.linalg.norm(result["point"][:, :2] / [0.0775, 0.0475], axis=1)
    assert (radius > 0.95).sum() >= 2 and (ratio[radius > 0.95] < 0.6).all()
    upper = (radius < 0.6) & (result["normal"][:, 2] > 0.5)
    assert upper.sum() >= 2 and (ratio[upper] > 1).all()


def test_touched_vertices_follow_the_disc_and_fixed_ones_do_not_move(result):
    normals = angle_weighted_normals(result["vertices"], result["faces"])
    assert (result["displacement"][:, result["fixed"] == 1] == 0).all()
    for s, vertex, normal, _ in contacts(result):
        r = result["vertices"] - result["vertices"][vertex]
        height = r @ normal
        radius = result["contact_radius"][s]
        # The rim of the mesh is set back by 2.25 % of the radius; see README.md.
        inside = np.linalg.norm(r - height[:, None] * normal, axis=1) < 0.97 * radius
        touched = inside & (height > -radius) & (normals @ normal > 0.3)
        assert touched[vertex]
        depth = result["displacement"][s, touched].astype(float) @ normal
        assert np.allclose(depth, -1, atol=4 * ROUNDING)


def test_pressing_takes_force_and_nothing_moves_much_further_than_the_disc(result):
    for s, _, _, stiffness in contacts(result):
        assert stiffness > 0
        assert np.linalg.norm(result["displacement"][s], axis=1).max() < 1.5


def test_a_larger_disc_is_stiffer_at_every_site():
    five, two = read("results/liver_r5.npz"), read("results/liver_r2.npz")
    assert np.array_equal(five["site_vertex"], two["site_vertex"])
    assert np.array_equal(five["held_out"], two["held_out"])
    assert (five["stiffness"] > 1.5 * two["stiffness"]).all()
    # Neither far from a half-space's 2 E r / (1 - nu^2): the body is large against the discs.
    for result in (five, two):
        half_space = 2 * result["young"] * result["contact_radius"] / (1 - result["poisson"] ** 2)
        assert ((result["stiffness"] > 0.7 * half_space) & (result["stiffness"] < 2 * half_space)).all()


def test_eight_sites_are_held_out_and_at_least_24_are_not():
    for name in ("liver_r5.npz", "liver_r2.npz"):
        held_out = read(f"results/{name}")["held_out"]
        assert held_out.sum() == 8 and (held_out == 0).sum() >= 24
    assert read("results/liver_nu.npz")["held_out"].all()


def test_solutions_obey_bettis_reciprocity():
    """A small disc acts on what is far away like its resultant force: k_j n_j . u_i(x_j) = k_i n_i . u_j(x_i)."""
    result = read("results/liver_r2.npz")
    site, normal, stiffness = result["site_vertex"], result["normal"], result["stiffness"]
    at_sites = result["displacement"][:, site].astype(float)  # (pressed, seen, 3)
    work = np.einsum("ijx,jx,j->ij", at_sites, normal, stiffness)
    distance = np.linalg.norm(result["point"][:, None] - result["point"], axis=2)
    far = distance > 0.015
    difference = np.linalg.norm((work - work.T)[far]) / np.linalg.norm(work[far])
    assert difference < 0.03


def test_nearly_incompressible_tissue_is_stiffer():
    """At equal Young's modulus the contact modulus E / (1 - nu^2) rises with nu."""
    result, middle = read("results/liver_nu.npz"), read("results/liver_r5.npz")
    for vertex in np.unique(result["site_vertex"]):
        mine = result["site_vertex"] == vertex
        assert sorted(result["poisson"][mine]) == [0.30, 0.49]
        soft, hard = (result["stiffness"][mine & (result["poisson"] == nu)][0] for nu in (0.30, 0.49))
        assert soft < middle["stiffness"][middle["site_vertex"] == vertex][0] < hard


def test_a_stiff_ball_is_felt_everywhere_and_most_above_it():
    result = read("results/liver_inclusion.npz")
    ratio = result["stiffness"] / result["stiffness_without"]
    assert len(ratio) >= 8
    assert (ratio >= 1 - 1e-3).all()
    assert ratio.argmax() == 0
    ball = result["point"][0] - result["inclusion_centre"]
    assert np.linalg.norm(ball) == pytest.approx(0.012)


def test_two_discs_need_less_force_each_than_alone_where_one_pulls_the_other_down():
    result, alone = read("results/liver_two.npz"), read("results/liver_r5.npz")
    for s, (first, _) in enumerate(result["site_vertex"]):
        single = np.flatnonzero(alone["site_vertex"] == first)[0]
        sinks = -(alone["displacement"][single, result["site_vertex"][s, 1]].astype(float) @ result["normal"][s, 1])
        if sinks > 0.05:
            assert result["stiffness"][s, 0] < alone["stiffness"][single]


def test_large_strain_starts_at_the_linear_solution_and_leaves_it_steadily_with_depth():
    result = read(f"results/{NONLINEAR}")
    assert result["held_out"].all() and result["depth"].shape == result["stiffness"].shape == result["linear_stiffness"].shape
    assert result["linear_displacement"].shape == (3, *result["vertices"].shape)
    alone = read("results/liver_r5.npz")
    assert np.array_equal(result["linear_site_vertex"], alone["site_vertex"][alone["held_out"] == 1][:3])
    for k, vertex in enumerate(result["linear_site_vertex"]):
        mine = result["site_vertex"] == vertex
        depth, linear = result["depth"][mine], result["linear_displacement"][k].astype(float)
        assert depth[0] == 0.001 and depth[-1] >= 0.005 and (np.diff(depth) > 0).all()
        field = result["displacement"][mine].astype(float)
        away = np.linalg.norm(field - linear, axis=(1, 2)) / np.linalg.norm(linear)
        assert away[0] < 0.05 and (np.diff(away) > 0).all()
        force = result["stiffness"][mine] * depth
        assert (np.diff(force) > 0).all()
        assert force[0] / depth[0] == pytest.approx(result["linear_stiffness"][mine][0], rel=0.05)
        # The mesh is coarser than that of liver_r5.npz (README.md: 0.4 to 1.1 % less stiff), the body the same.
        fine = alone["stiffness"][alone["site_vertex"] == vertex][0]
        assert result["linear_stiffness"][mine][0] == pytest.approx(fine, rel=0.015)


@pytest.mark.parametrize("vertices", TETS)
def test_tetrahedra_fill_the_surface_exactly(vertices):
    mesh = read(f"tets/liver_{vertices}.npz")
    nodes, tets = mesh["nodes"], mesh["tets"]
    assert mesh["fixed"].shape == (vertices,) and 0 < mesh["fixed"].sum() < vertices
    p = nodes[tets]
    volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
    assert (volume > 0).all()
    faces = np.concatenate([tets[:, list(f)] for f in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))])
    _, where, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    assert count.max() == 2
    outside = faces[where[count == 1]]
    assert outside.max() < vertices and len(outside) == 2 * vertices - 4 and len(np.unique(outside)) == vertices
    a, b, c = (nodes[outside[:, k]] for k in range(3))
    assert np.einsum("ij,ij", a, np.cross(b, c)) / 6 == pytest.approx(volume.sum(), rel=1e-9)
    if vertices == 3116:
        body = read("results/liver_r5.npz")
        assert np.array_equal(nodes[:vertices], body["vertices"])
        assert {frozenset(f) for f in outside.tolist()} == {frozenset(f) for f in body["faces"].tolist()}
        assert np.array_equal(mesh["fixed"], body["fixed"])
