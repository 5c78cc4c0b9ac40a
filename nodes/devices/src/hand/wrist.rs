//! How the hand holds the handle's orientation: a spring and a damper in rotation, against which a torque turns it.

use glam::{DQuat, DVec3};

use super::transition;

/// The hand's resistance to a turn, the same about all axes.
const STIFFNESS_N_M_PER_RAD: f64 = 1.0;
/// A little less than critical.
const DAMPING_N_M_S_PER_RAD: f64 = 0.06;
/// Of hand and handle together.
const INERTIA_KG_M2: f64 = 2e-3;
/// The wrist's mechanical stop.
const LARGEST_ANGLE_RAD: f64 = 1.2;

/// An orientation in motion.
///
/// With the rotation vector `p`, the orientation is `exp(p)`, the angular velocity `w = J(p) p'` with the left Jacobian `J`
/// of rotations, and a torque `t` does the work `t w = (J^T t) p'`. So `I p'' = -k p - c p' + J^T t` is a hand that gives
/// back no more energy than it got. Each step is exact for the `J` at its beginning, as those of [`Hand`](super::Hand) are.
#[derive(Clone, Debug)]
pub(super) struct Wrist {
    steps: u32,
    transition: [[f64; 2]; 2],
    rotation_vector: DVec3,
    rate: DVec3,
}

impl Wrist {
    /// Not turned; `steps` steps of `step_s` make a period.
    pub(super) fn new(steps: u32, step_s: f64) -> Wrist {
        Wrist {
            steps,
            transition: transition(
                STIFFNESS_N_M_PER_RAD / INERTIA_KG_M2,
                DAMPING_N_M_S_PER_RAD / INERTIA_KG_M2,
                step_s,
            ),
            rotation_vector: DVec3::ZERO,
            rate: DVec3::ZERO,
        }
    }

    /// The handle's orientation in the device frame.
    pub(super) fn orientation(&self) -> DQuat {
        if self.rotation_vector == DVec3::ZERO {
            return DQuat::IDENTITY;
        }
        let half = 0.5 * self.rotation_vector.length();
        let axis = self.rotation_vector * (0.5 * sinc(half));
        DQuat::from_xyzw(axis.x, axis.y, axis.z, libm::cos(half))
    }

    /// Its angular velocity in the device frame, rad/s.
    pub(super) fn angular_velocity_rad_per_s(&self) -> DVec3 {
        left_jacobian(self.rotation_vector, self.rate)
    }

    /// One period under a constant torque, N m, in the device frame. RT safe. Costs nothing while nothing turns.
    pub(super) fn advance(&mut self, torque_n_m: DVec3) {
        if torque_n_m == DVec3::ZERO && self.rotation_vector == DVec3::ZERO && self.rate == DVec3::ZERO {
            return;
        }
        let [[ee, ev], [ve, vv]] = self.transition;
        for _ in 0..self.steps {
            // The transposed Jacobian is that of the opposite rotation.
            let torque = left_jacobian(-self.rotation_vector, torque_n_m);
            let equilibrium = torque / STIFFNESS_N_M_PER_RAD;
            let offset = self.rotation_vector - equilibrium;
            self.rotation_vector = equilibrium + ee * offset + ev * self.rate;
            self.rate = ve * offset + vv * self.rate;
            self.stop();
        }
    }

    fn stop(&mut self) {
        let angle = self.rotation_vector.length();
        if angle > LARGEST_ANGLE_RAD {
            let outward = self.rotation_vector / angle;
            self.rotation_vector = outward * LARGEST_ANGLE_RAD;
            self.rate -= outward * self.rate.dot(outward).max(0.0);
        }
    }
}

/// `J(p) v = v + (1 - cos a)/a^2 p x v + (a - sin a)/a^3 p x (p x v)` with `a = |p|`.
fn left_jacobian(p: DVec3, v: DVec3) -> DVec3 {
    let a = p.length();
    let half = sinc(0.5 * a);
    let once = 0.5 * half * half;
    let twice = if a < 1e-2 { 1.0 / 6.0 - a * a / 120.0 } else { (1.0 - sinc(a)) / (a * a) };
    let turned = p.cross(v);
    v + once * turned + twice * p.cross(turned)
}

/// `sin(x)/x`.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { libm::sin(x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn wrist() -> Wrist {
        Wrist::new(4, 0.25e-3)
    }

    #[test]
    fn a_constant_torque_turns_the_handle_by_torque_over_stiffness() {
        let mut wrist = wrist();
        for _ in 0..3000 {
            wrist.advance(DVec3::new(0.0, 0.0, 0.2));
        }
        assert!(wrist.orientation().angle_between(DQuat::from_rotation_z(0.2)) < 1e-6);
        assert!(wrist.angular_velocity_rad_per_s().length() < 1e-9);
    }

    #[test]
    fn without_a_torque_nothing_turns_at_all() {
        let mut wrist = wrist();
        for _ in 0..100 {
            wrist.advance(DVec3::ZERO);
        }
        assert_eq!(wrist.orientation(), DQuat::IDENTITY);
        assert_eq!(wrist.angular_velocity_rad_per_s(), DVec3::ZERO);
    }

    #[test]
    fn the_angular_velocity_is_the_orientations_change() {
        let mut wrist = Wrist::new(1, 1e-5);
        let torque = |step: u32| {
            let t = f64::from(step) * 1e-5;
            DVec3::new(0.4 * libm::sin(9.0 * t), 0.5 * libm::cos(7.0 * t), -0.3)
        };
        let mut before = wrist.orientation();
        for step in 0..100_000 {
            wrist.advance(torque(step));
            let now = wrist.orientation();
            if step % 1000 == 999 {
                let change = (now * before.conjugate()).to_scaled_axis() / 1e-5;
                let told = wrist.angular_velocity_rad_per_s();
                assert!((change - told).length() < 2e-3 * (1.0 + told.length()), "{change} {told}");
            }
            before = now;
        }
    }

    proptest! {
        // The work of the torque is what the spring and the moving mass hold, and what the damper took; torques of this size
        // stay clear of the stop.
        #[test]
        fn a_torque_does_the_work_that_the_hand_stores_and_damps(
            torques in prop::collection::vec(prop::array::uniform3(-0.4..0.4f64), 1..80),
        ) {
            let mut wrist = wrist();
            let (mut given_j, mut moved_j, mut damped_j) = (0.0, 0.0, 0.0);
            for torque in torques {
                let torque = DVec3::from(torque);
                for _ in 0..20 {
                    let (orientation, rate) = (wrist.orientation(), wrist.rate);
                    wrist.advance(torque);
                    let work_j = torque.dot((wrist.orientation() * orientation.conjugate()).to_scaled_axis());
                    given_j += work_j;
                    moved_j += work_j.abs();
                    let squares = rate.length_squared() + wrist.rate.length_squared();
                    damped_j += 0.5 * squares * DAMPING_N_M_S_PER_RAD * 1e-3;
                }
            }
            let stored_j = 0.5 * STIFFNESS_N_M_PER_RAD * wrist.rotation_vector.length_squared()
                + 0.5 * INERTIA_KG_M2 * wrist.rate.length_squared();
            prop_assert!((given_j - stored_j - damped_j).abs() < 0.01 * moved_j + 1e-9,
                "{given_j} J given, {stored_j} J stored, {damped_j} J damped");
        }
    }

    #[test]
    fn the_wrist_stops_at_its_end() {
        let mut wrist = wrist();
        for _ in 0..3000 {
            wrist.advance(DVec3::new(0.0, 3.0, 0.0));
            assert!(wrist.rotation_vector.length() <= LARGEST_ANGLE_RAD * (1.0 + 1e-12));
        }
        assert!(wrist.orientation().angle_between(DQuat::from_rotation_y(LARGEST_ANGLE_RAD)) < 1e-6);
        assert!(wrist.angular_velocity_rad_per_s().length() < 1e-9);
    }
}
