//! Sizes and steps of forces, for any finite value.

use glam::DVec3;

use crate::Wrench;

/// Keeps a rounded result on the inner side of its limit.
const INSIDE: f64 = 1.0 - 1e-12;

/// The length of a finite vector; a square that would overflow does not. RT safe.
pub(crate) fn size(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    if largest > 0.0 { largest * (vector / largest).length() } else { 0.0 }
}

/// The vector, or the vector of length `limit` >= 0 in the same direction if that is shorter. RT safe.
pub(crate) fn limited(vector: DVec3, limit: f64) -> DVec3 {
    if size(vector) <= limit {
        return vector;
    }
    // By the largest component first, so that the square of a huge value does not overflow.
    let largest = vector.abs().max_element();
    (vector / largest).normalize_or_zero() * (limit * INSIDE)
}

/// From `from` towards `to`, no further than `step` >= 0. RT safe.
pub(crate) fn towards(from: DVec3, to: DVec3, step: f64) -> DVec3 {
    let way = to - from;
    let step = room(size(from), step);
    if way.length() <= step { to } else { from + limited(way, step) }
}

/// [`towards`] for numbers. RT safe.
pub(crate) fn towards_number(from: f64, to: f64, step: f64) -> f64 {
    let step = room(from.abs(), step);
    from + (to - from).clamp(-step, step)
}

/// What of `step` leaves room for the rounding of a sum with a number of this size, which a step of nanoseconds needs.
fn room(size: f64, step: f64) -> f64 {
    (step * INSIDE - 2.0 * f64::EPSILON * (size + step)).max(0.0)
}

/// `a + share * b`. RT safe.
pub(crate) fn sum(a: &Wrench, b: &Wrench, share: f64) -> Wrench {
    Wrench {
        force_n: a.force_n + b.force_n * share,
        torque_n_m: a.torque_n_m + b.torque_n_m * share,
        gripper_force_n: a.gripper_force_n + b.gripper_force_n * share,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn limiting_never_exceeds_the_limit_nor_turns_the_vector(
            x in any::<f64>(), y in any::<f64>(), z in any::<f64>(), limit in 0.0..30.0f64,
        ) {
            let vector = DVec3::new(x, y, z);
            prop_assume!(vector.is_finite());
            let got = limited(vector, limit);
            prop_assert!(got.is_finite() && got.length() <= limit);
            if got != DVec3::ZERO {
                let unit = vector / vector.abs().max_element();
                prop_assert!(got.cross(unit).length() <= 1e-11 * got.length() * unit.length());
                prop_assert!(got.dot(unit) > 0.0);
            }
        }

        #[test]
        fn a_step_stays_within_its_size_and_between_its_ends(
            from in prop::array::uniform3(-20.0..20.0f64), to in prop::array::uniform3(-20.0..20.0f64),
            step in 1e-3..10.0f64, limit in 0.1..20.0f64,
        ) {
            let (from, to) = (limited(from.into(), limit), limited(to.into(), limit));
            // A period that follows at once leaves next to nothing to step.
            for tiny in [step * 1e-6, step * 1e-12, step * 1e-18, 0.0] {
                prop_assert!((towards(from, to, tiny) - from).length() <= tiny);
                prop_assert!((towards_number(from.x, to.x, tiny) - from.x).abs() <= tiny);
            }
            let got = towards(from, to, step);
            prop_assert!((got - from).length() <= step);
            prop_assert!(got.length() <= limit);
            prop_assert!((to - got).length() <= (to - from).length());
            // Enough steps arrive, exactly.
            let mut at = from;
            for _ in 0..(40.0 / step).ceil() as u64 + 1 {
                at = towards(at, to, step);
            }
            prop_assert_eq!(at, to);
        }
    }

    #[test]
    fn a_number_steps_like_a_vector_and_arrives() {
        assert!((towards_number(1.0, 5.0, 0.5) - 1.5).abs() < 1e-11);
        let mut at = 1.0;
        for _ in 0..10 {
            at = towards_number(at, -1.0, 0.5);
        }
        assert_eq!(at, -1.0);
    }
}
