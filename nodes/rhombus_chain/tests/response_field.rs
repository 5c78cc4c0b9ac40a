//! What else a calibrated body keeps: the parallel chains it is made of, boundary, expansion, grasp, stiffness.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod calibrated;
mod common;

use calibrated::{CHAINS, Pressed, calibrated, mesh, plain, press, tissue, turned};
use common::{Random, body, bumpy, icosphere, law, surface, tissue_with};
use glam::{DMat3, DVec3};
use rhombus_chain::{
    ArcLengths, Body, ChainParameters, ContactLaw, ContactShape, Formulation, Impression, Interaction,
    Response, ResponseParts, Spread, StiffnessMap, SurfaceField, SurfaceMesh, SurfaceParameters,
    SurfacePoint, Tissue,
};

const PRESS_M: f64 = 0.005;

fn tissue_of(surface: SurfaceParameters) -> Tissue {
    Tissue::new(law(CHAINS), surface, 0.005, 0.5).expect("acceptable settings")
}

/// Chains of `units` units.
fn chains_of(units: u32) -> ContactLaw {
    let law = law(CHAINS);
    let chains: Vec<ChainParameters> =
        law.chains().iter().map(|chain| ChainParameters { units, ..*chain.parameters() }).collect();
    ContactLaw::new(Formulation::Energy, &chains).expect("an acceptable law")
}

/// Where an arc length is that of the table.
fn at_vertex(mesh: &SurfaceMesh, face: usize) -> SurfacePoint {
    SurfacePoint { face: (face % mesh.triangles().len()) as u32, barycentric: DVec3::X }
}

/// Constant coefficients that stand for parallel chains pressed by `depth_m`: `a_p0 = w_p`, `c_p0 = w_p dw_1p / (2 DL)`.
fn parallel_chains(mesh: &SurfaceMesh, tissue: &Tissue, depth_m: f64) -> ResponseParts {
    let chains = tissue.law().chains();
    let here: Vec<f32> = chains
        .iter()
        .flat_map(|chain| {
            let weight = chain.parameters().weight;
            [weight, weight * chain.response(-depth_m).dw_1_m / (-2.0 * depth_m)]
        })
        .map(|number| number as f32)
        .collect();
    let coefficients = here.repeat(mesh.vertices().len());
    ResponseParts { chains: chains.len(), coefficients, ..ResponseParts::default() }
}

#[test]
fn constant_coefficients_without_harmonics_and_modes_are_parallel_chains() {
    let classic = body(bumpy(4));
    // What is left is the table's error; where a ramp, a chain or a boundary ends between two of its nodes, the corner is
    // rounded off: (units, cutoff, contact radius, share of the press).
    let cases =
        [(90, 0.0, 0.009, 1e-4), (90, 0.0, 0.0, 1e-3), (20, 0.0, 0.009, 1e-3), (20, 0.05, 0.009, 4e-3)];
    for (units, cutoff, contact_radius_m, allowed) in cases {
        let surface = SurfaceParameters { cutoff, contact_radius_m, ..SurfaceParameters::default() };
        let tissue = Tissue::new(chains_of(units), surface, 0.005, 0.5).expect("acceptable settings");
        let mesh = classic.mesh();
        let calibrated = calibrated(mesh.clone(), parallel_chains(mesh, &tissue, PRESS_M));
        let (mut one, mut other) = (Pressed::new(&classic, &tissue), Pressed::new(&calibrated, &tissue));
        let mut random = Random(31);
        for _ in 0..100 {
            let press = press(mesh, at_vertex(mesh, random.below(mesh.triangles().len())), PRESS_M);
            let (one, other) = (one.by(&[press]), other.by(&[press]));
            let most = one.iter().zip(&other).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(most <= allowed * PRESS_M, "{} of the press: {units} {cutoff}", most / PRESS_M);
        }
    }
}

#[test]
fn without_modes_only_what_is_within_the_boundary_moves_and_it_grows_steadily_with_the_depth() {
    let tissue = tissue();
    let mesh = mesh(bumpy(4));
    let mut parts = turned(&mesh, DMat3::IDENTITY);
    (parts.modes, parts.amplitudes, parts.mode_fields) = (0, Vec::new(), Vec::new());
    let body = calibrated(mesh.clone(), parts);
    let mut pressed = Pressed::new(&body, &tissue);
    let mut shape = ContactShape::new(tissue.law(), tissue.surface()).expect("a valid surface");
    let at = at_vertex(&mesh, 77);
    let mut before: Option<Vec<DVec3>> = None;
    let mut touched = 0;
    for step in 1..=500_u32 {
        let depth_m = 1e-5 * f64::from(step);
        let now = pressed.by(&[press(&mesh, at, depth_m)]);
        shape.set_depth(tissue.law(), depth_m).expect("a finite depth");
        let mut arcs = ArcLengths::new(&mesh);
        arcs.solve(&mesh, at, shape.reach_m() * (1.0 - 1e-6));
        assert!(now.iter().filter(|moved| moved.length() > 0.0).count() <= arcs.iter().len() + 2);
        touched = arcs.iter().len();
        if let Some(before) = &before {
            let most = now.iter().zip(before).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(most < 6e-5, "{most} m for a step of 1e-5 m at {depth_m} m");
        }
        before = Some(now);
    }
    assert!(touched > 50 && touched < mesh.vertices().len(), "{touched}");
}

#[test]
fn expansion_gives_back_its_share_of_what_a_calibrated_body_displaces() {
    let mesh = mesh(bumpy(4));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let press = press(&mesh, Random(14).surface_point(&mesh), PRESS_M);
    let field =
        |kappa: f64| Pressed::new(&body, &tissue_with(CHAINS, surface(kappa, Spread::Geodesic))).by(&[press]);
    let without = field(0.0);
    let displaced: f64 =
        without.iter().zip(mesh.vertex_areas()).map(|(moved, area)| area * moved.dot(press.normal)).sum();
    for kappa in [0.3, 1.0] {
        let (mut given_back, mut bulging) = (0.0, 0);
        for (vertex, (with, without)) in field(kappa).iter().zip(&without).enumerate() {
            let (bulge, normal) = (*with - *without, mesh.vertex_normals()[vertex]);
            given_back += mesh.vertex_areas()[vertex] * bulge.dot(normal);
            bulging += usize::from(bulge.length() > 1e-9);
            assert!(bulge.distance(normal * bulge.dot(normal)) < 1e-15, "along the vertex normal");
        }
        assert!((given_back + kappa * displaced).abs() < 1e-9 * displaced.abs(), "{given_back} {displaced}");
        assert!(bulging > 50 && bulging < mesh.vertices().len(), "{bulging}");
    }
}

#[test]
fn a_grasp_carries_a_calibrated_body_along_by_the_shares_of_its_chains() {
    let tissue = tissue();
    let mesh = mesh(bumpy(4));
    let body = calibrated(mesh.clone(), plain(&mesh, 0));
    let mut pressed = Pressed::new(&body, &tissue);
    let at = at_vertex(&mesh, 300);
    let still = press(&mesh, at, -0.003);
    let lateral_m = still.normal.any_orthonormal_vector() * 0.002;
    let (before, after) = (pressed.by(&[still]), pressed.by(&[Impression { lateral_m, ..still }]));
    let contact = mesh.triangles()[at.face as usize][0] as usize;
    assert!((after[contact] - before[contact]).distance(lateral_m) < 1e-17);
    for (before, after) in before.iter().zip(&after) {
        let share = before.dot(still.normal) / 0.003;
        assert!((*after - *before).distance(lateral_m * share) < 1e-9);
    }
}

#[test]
fn a_contact_that_stays_gives_the_same_bits_as_a_new_one() {
    let tissue = tissue();
    let mesh = mesh(bumpy(3));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let (mut stays, mut leaves) = (Pressed::new(&body, &tissue), Pressed::new(&body, &tissue));
    let mut random = Random(33);
    let [at, elsewhere] = [(); 2].map(|()| random.surface_point(&mesh));
    for depth_m in [0.004, 0.0041, -0.002, 0.004] {
        leaves.by(&[press(&mesh, elsewhere, 0.003)]);
        assert_eq!(stays.by(&[press(&mesh, at, depth_m)]), leaves.by(&[press(&mesh, at, depth_m)]));
    }
}

#[test]
fn another_part_of_the_body_that_no_way_leads_to_is_left_alone() {
    let (mut vertices, mut triangles) = icosphere(0.03, 3);
    let one = vertices.len();
    let (others, more) = icosphere(0.03, 3);
    vertices.extend(others.into_iter().map(|vertex| vertex + DVec3::X * 0.1));
    triangles.extend(more.into_iter().map(|corners| corners.map(|corner| corner + one as u32)));
    let mesh = mesh((vertices, triangles));
    let mut parts = turned(&mesh, DMat3::IDENTITY);
    parts.amplitudes.fill(0.0);
    let body = calibrated(mesh.clone(), parts);
    let tissue = tissue();
    let moved = Pressed::new(&body, &tissue).by(&[press(&mesh, at_vertex(&mesh, 5), PRESS_M)]);
    assert!(moved[..one].iter().any(|moved| moved.length() > 0.9 * PRESS_M));
    assert!(moved[one..].iter().all(|moved| *moved == DVec3::ZERO));
}

#[test]
fn the_force_is_that_of_the_stiffness_factor_and_its_gradient_whatever_the_response() {
    let plain = body(bumpy(3));
    let factors = plain.mesh().vertices().iter().map(|p| 1.5 + 10.0 * p.x).collect();
    let map = StiffnessMap::new(factors, plain.mesh()).expect("accepted factors");
    let stiff = plain.with_stiffness(map).expect("its own map");
    let response =
        Response::new(turned(stiff.mesh(), DMat3::IDENTITY), stiff.mesh()).expect("accepted numbers");
    let both = stiff.clone().with_response(response).expect("its own response");
    let tissue = tissue();
    let mut random = Random(34);
    let mut across = 0;
    for _ in 0..300 {
        let at = random.surface_point(stiff.mesh());
        let probe = stiff.mesh().position(at) + stiff.mesh().normal(at) * (0.001 + 0.003 * random.unit());
        let step = |body: &Body| Interaction::new().step(body, &tissue, 0, probe, false).expect("an answer");
        let (one, other) = (step(&stiff), step(&both));
        assert_eq!(one, other);
        let tangential_n = one.force_n - one.normal * one.force_n.dot(one.normal);
        across += usize::from(tangential_n.length() > 1e-4);
    }
    assert!(across > 200, "the gradient is felt: {across}");
}

#[test]
fn a_change_of_tissue_is_taken_over() {
    let mesh = mesh(bumpy(3));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let press = press(&mesh, Random(35).surface_point(&mesh), PRESS_M);
    let wide =
        tissue_of(SurfaceParameters { contact_radius_m: 0.007, cutoff: 0.0, ..SurfaceParameters::default() });
    let first = tissue();
    let mut field = SurfaceField::new(&body, &first);
    field.update(&body, &first, [press]);
    field.update(&body, &wide, [press]);
    let mut new = SurfaceField::new(&body, &wide);
    new.update(&body, &wide, [press]);
    assert_eq!(field.displacements(), new.displacements());
}

/// Run with `--release` too: the expected number is the same. What a recording of a calibrated body replays to changes with it.
#[test]
fn a_calibrated_field_has_the_same_bits_in_debug_and_release() {
    let mesh = mesh(bumpy(3));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let tissue = tissue();
    let (mut field, mut random) = (SurfaceField::new(&body, &tissue), Random(42));
    // FNV-1a over the bits of each number.
    let mut found = 0xcbf2_9ce4_8422_2325_u64;
    for step in 0..200 {
        let mut press = press(&mesh, random.surface_point(&mesh), 0.01 * random.unit() - 0.003);
        press.lateral_m = press.normal.any_orthonormal_vector() * (1e-4 * f64::from(step % 3));
        field.update(&body, &tissue, [press]);
        for byte in field.displacements().iter().flat_map(|moved| moved.to_array()).flat_map(f64::to_le_bytes)
        {
            found = (found ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    assert_eq!(found, 0xd498_edc5_dc9b_08ce, "{found:#018x}");
}
