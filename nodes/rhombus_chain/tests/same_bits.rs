//! A recording replays to the same bits, so the model gives the same bits in every build and on every CPU.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::TISSUE;
use rhombus_chain::{ChainParameters, ContactLaw, ContactShape, Formulation, SurfaceParameters};

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
