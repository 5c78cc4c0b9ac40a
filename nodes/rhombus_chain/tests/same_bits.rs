//! A recording replays to the same bits, so the model gives the same bits in every build and on every CPU.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;
mod common;

use chains::TISSUE;
use common::{Random, body, bumpy, tissue};
use rhombus_chain::{
    Body, ChainParameters, ContactLaw, ContactShape, Formulation, Interaction, StiffnessMap,
    SurfaceParameters,
};

/// FNV-1a over the bits of each number.
struct Fingerprint(u64);

impl Fingerprint {
    fn add(&mut self, value: f64) {
        for byte in value.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// Run with `--release` too: the expected number is the same. It changes only with the arithmetic of the model, and
/// then so does what every recording replays to: the change belongs in the changelog.
#[test]
fn laws_and_fields_have_the_same_bits_in_debug_and_release() {
    let chains = [0.55, 0.8, 0.93].map(|ratio| ChainParameters {
        ratio,
        angle_rad: 0.4 + 0.3 * ratio,
        weight: 1.0 / 3.0,
        ..TISSUE
    });
    let mut fingerprint = Fingerprint(0xcbf2_9ce4_8422_2325);
    for formulation in [Formulation::Published, Formulation::Energy] {
        let law = ContactLaw::new(formulation, &chains).expect("accepted");
        let surface = SurfaceParameters { contact_radius_m: 0.002, ..SurfaceParameters::default() };
        let mut shape = ContactShape::new(&law, &surface).expect("a valid surface");
        for step in -60_i32..=60 {
            let depth_m = 1e-3 * f64::from(step);
            let response = law.at_depth(depth_m).expect("a finite depth");
            fingerprint.add(response.force_n);
            fingerprint.add(response.stiffness_n_per_m);
            fingerprint.add(response.energy_j);
            fingerprint.add(law.depth_for_force(response.force_n).expect("a force in reach"));
            shape.set_depth(&law, depth_m).expect("a finite depth");
            for ring in 0..20_i32 {
                let arc_m = 3e-3 * f64::from(ring);
                let moved = shape.displacement(shape.s_m(arc_m), arc_m);
                fingerprint.add(moved.normal_m);
                fingerprint.add(moved.tangential_m);
            }
        }
    }
    assert_eq!(fingerprint.0, 0x6c6d_ead4_a15a_097a, "{:#018x}", fingerprint.0);
}

/// Slides, presses, grasps, pulls and releases on a body; what a recording of it replays to.
fn session(body: &Body) -> u64 {
    let tissue = tissue();
    let mut random = Random(41);
    let mut fingerprint = Fingerprint(0xcbf2_9ce4_8422_2325);
    for _ in 0..20 {
        let at = random.surface_point(body.mesh());
        let (normal, mut interaction) = (body.mesh().normal(at), Interaction::new());
        let along = normal.any_orthonormal_vector();
        for k in 0..200_i32 {
            let share = f64::from(k) / 200.0;
            let way = along * (0.03 * share) - normal * (0.006 * libm::sin(9.0 * share));
            let probe = body.mesh().position(at) + normal * 0.005 + way;
            let step = interaction
                .step(body, &tissue, i64::from(k) * 3_000_000, probe, (90..130).contains(&k))
                .expect("an answer");
            let local_n = step.local_law.force_n(tissue.law(), probe + along * 1e-4);
            for vector in [step.force_n, step.normal, step.proxy, local_n] {
                vector.to_array().into_iter().for_each(|value| fingerprint.add(value));
            }
            fingerprint.add(step.depth_m);
            fingerprint.add(step.stiffness_n_per_m);
        }
    }
    fingerprint.0
}

#[test]
fn a_session_on_a_body_has_the_same_bits_in_debug_and_release() {
    let found = session(&body(bumpy(3)));
    assert_eq!(found, 0x1725_c83b_dd2a_5fa0, "{found:#018x}");
}

#[test]
fn a_session_on_a_regionally_stiff_body_has_the_same_bits_in_debug_and_release() {
    let body = body(bumpy(3));
    let factors = body.mesh().vertices().iter().map(|p| 2.0 + libm::sin(40.0 * p.x) * libm::cos(60.0 * p.y));
    let map = StiffnessMap::new(factors.collect(), body.mesh()).expect("accepted factors");
    let found = session(&body.with_stiffness(map).expect("its own map"));
    assert_eq!(found, 0x1f90_52e4_4690_b13e, "{found:#018x}");
}
