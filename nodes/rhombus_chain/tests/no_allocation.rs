//! The motor loop's queries never reach the allocator: one that does ends this test with a report.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use chains::TISSUE;
use rhombus_chain::{ChainParameters, ContactLaw, ContactShape, Formulation, SurfaceParameters};

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

#[test]
fn queries_of_law_and_field_allocate_nothing() {
    for formulation in [Formulation::Published, Formulation::Energy] {
        let quarters = [0.5, 0.7, 0.8, 0.9].map(|ratio| ChainParameters { ratio, weight: 0.25, ..TISSUE });
        let law = ContactLaw::new(formulation, &quarters).expect("accepted");
        let mut shape = ContactShape::new(&law, &SurfaceParameters::default()).expect("a valid surface");
        assert_no_alloc(|| {
            for depth_m in [-1e300, -0.01, 0.0, 0.004, 1.0, f64::NAN] {
                let force_n = law.at_depth(depth_m).map_or(f64::INFINITY, |response| response.force_n);
                let _ = law.depth_for_force(force_n);
                let _ = law.chains()[0].response(depth_m);
                let _ = shape.set_depth(&law, depth_m);
                let _ = shape.displacement(shape.s_m(0.01), 0.01);
                let _ = shape.displacement_at_ring(1.0);
            }
        });
    }
}
