//! The largest stable step of the springs.
//!
//! A mode of angular frequency omega, stepped by undamped semi-implicit Euler, keeps its amplitude for
//! `omega dt < 2` and grows without bound above. The highest frequency is the root of the largest eigenvalue of `M^-1 K`,
//! found by power iteration with Rayleigh quotients; these never exceed it, and are within 1e-5 of it when they stand
//! still.

use glam::DVec3;

use super::network::Network;

/// Rayleigh quotients that change by less than this share in one iteration are taken as converged.
const CONVERGED: f64 = 1e-9;
/// Iterations at most.
const LONGEST: u32 = 20_000;

/// `2 / omega_max` in s; infinite when nothing can move.
pub(super) fn largest_stable_step_s(network: &Network) -> f64 {
    let inverse = &network.inverse_mass_per_kg;
    // A start with something of every mode, the same in every run.
    let mut seed = 1u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((seed >> 33) as u32) / f64::from(1u32 << 31) - 0.5
    };
    let mut x: Vec<DVec3> = inverse
        .iter()
        .map(|&free| if free > 0.0 { DVec3::new(random(), random(), random()) } else { DVec3::ZERO })
        .collect();
    let mut product = vec![DVec3::ZERO; x.len()];
    let mut largest = 0.0;
    for _ in 0..LONGEST {
        network.stiffness_times(&x, &mut product);
        let work: f64 = x.iter().zip(&product).map(|(x, kx)| x.dot(*kx)).sum();
        let moved = |(x, &free): (&DVec3, &f64)| if free > 0.0 { x.length_squared() / free } else { 0.0 };
        let inertia: f64 = x.iter().zip(inverse).map(moved).sum();
        let quotient = work / inertia;
        // Not a number when nothing can move.
        if quotient.is_nan() || quotient <= largest * (1.0 + CONVERGED) {
            break;
        }
        largest = quotient;
        // M^-1 K x, scaled so that it neither overflows nor vanishes.
        for ((x, kx), free) in x.iter_mut().zip(&product).zip(inverse) {
            *x = *kx * (free / quotient);
        }
    }
    2.0 / largest.sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::network::{Network, Spring};
    use super::largest_stable_step_s;
    use glam::DVec3;

    /// Eigenvalues of n equal masses on a line, ends held: (2 k/m)(1 - cos(j pi/(n+1))).
    #[test]
    fn a_line_of_equal_masses_has_its_closed_form_limit() {
        let (n, k, m) = (9u32, 40.0, 0.002);
        let rest = (0..n + 2).map(|i| DVec3::X * 0.01 * f64::from(i)).collect();
        let springs =
            (0..=n).map(|i| Spring { ends: [i, i + 1], rest_m: 0.01, stiffness_n_per_m: k }).collect();
        let held = |i: u32| if i == 0 || i == n + 1 { 0.0 } else { 1.0 / m };
        let network = Network { rest, springs, inverse_mass_per_kg: (0..n + 2).map(held).collect() };
        let highest = 2.0 * k / m * (1.0 + (std::f64::consts::PI / f64::from(n + 1)).cos());
        let step = largest_stable_step_s(&network);
        assert!((step * highest.sqrt() / 2.0 - 1.0).abs() < 1e-5, "{step}");
    }

    #[test]
    fn a_body_that_cannot_move_takes_any_step() {
        let springs = vec![Spring { ends: [0, 1], rest_m: 1.0, stiffness_n_per_m: 1.0 }];
        let rest = vec![DVec3::ZERO, DVec3::X];
        let network = Network { rest, springs, inverse_mass_per_kg: vec![0.0, 0.0] };
        assert_eq!(largest_stable_step_s(&network), f64::INFINITY);
    }
}
