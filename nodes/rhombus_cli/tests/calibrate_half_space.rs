//! Chains fitted to a half-space, as the report calls them.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use rhombus_chain::Formulation;
use rhombus_cli::calibrate::half_space::{self, Contact, HalfSpace};

#[test]
fn the_flat_punch_to_27_7_2_and_1_percent_with_1_to_4_chains() {
    for (chains, most) in [(1, 0.27), (2, 0.07), (3, 0.02), (4, 0.01)] {
        let punch = HalfSpace::flat(10e3, 0.45, 0.005);
        let fitted = half_space::fit(&punch, Formulation::Energy, chains).expect("it fits");
        let error = half_space::profile_error(&punch, &fitted).expect("a law");
        println!("{chains} {error}");
        assert!(error <= most, "{chains} chains leave {error}");
    }
}

#[test]
fn sphere() {
    for formulation in [Formulation::Energy, Formulation::Published] {
        let sphere = HalfSpace { contact: Contact::Sphere, ..HalfSpace::flat(10e3, 0.45, 0.005) };
        let fitted = half_space::fit(&sphere, formulation, 3).expect("it fits");
        println!("{fitted:?}");
    }
}
