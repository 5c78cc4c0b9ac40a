//! The hand that holds the handle of a device that is not there: a mass on a spring and a damper whose other end is where
//! the hand means to be. A hand that has let go is the mass and a damper to where it is.

mod held_handle;
mod wrist;

use glam::DVec3;

use crate::{DeviceError, DeviceLimits, Workspace};

pub(crate) use held_handle::HeldHandle;

/// The device that the reference experiment used: a 6-DOF delta, 360 mm in diameter, 300 mm high, 20 N. The torque is that
/// of the wrists of its class; the gripper has no motor.
pub const LIMITS: DeviceLimits = DeviceLimits {
    max_force_n: Some(20.0),
    max_torque_n_m: Some(0.2),
    max_gripper_force_n: None,
    workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.18, height_m: 0.3 },
};

/// The longest integration step, s. The aim is taken as moving evenly during one step.
const LONGEST_STEP_S: f64 = 0.25e-3;

/// The mechanics of a hand on the handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandSettings {
    /// Mass of hand and moving device parts together, kg, > 0.
    pub mass_kg: f64,
    /// Spring between the hand and where it means to be, N/m, > 0.
    pub stiffness_n_per_m: f64,
    /// Damper between the hand and where it means to be, N s/m, >= 0.
    pub damping_n_s_per_m: f64,
}

impl HandSettings {
    fn check(&self) -> Result<(), DeviceError> {
        let positive = |name, value: f64, accepted: &str| {
            if value.is_finite() && value > 0.0 {
                Ok(())
            } else {
                Err(DeviceError::Setting { name, value: value.to_string(), accepted: accepted.to_owned() })
            }
        };
        positive("simulated.mass", self.mass_kg, "a finite number > 0 [kg]")?;
        positive("simulated.stiffness", self.stiffness_n_per_m, "a finite number > 0 [N/m]")?;
        if !(self.damping_n_s_per_m.is_finite() && self.damping_n_s_per_m >= 0.0) {
            return Err(DeviceError::Setting {
                name: "simulated.damping",
                value: self.damping_n_s_per_m.to_string(),
                accepted: "a finite number >= 0 [N s/m]".to_owned(),
            });
        }
        Ok(())
    }
}

/// Where a hand means to be at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// In the device frame, m.
    pub position: DVec3,
    /// Its derivative.
    pub velocity_m_per_s: DVec3,
}

/// A hand in motion: the mechanics that the devices that are not there and the doubles of real devices share.
///
/// With the aim at `p`, moving at `w`, and the device pushing with `f`, the hand at `x`, moving at `v`, obeys
/// `m v' = k (p - x) + c (w - v) + f`. For a step in which `p`, `w` and `f` stand still the distance from the
/// equilibrium `p + (c w + f)/k` and the velocity are carried over by a constant 2 x 2 matrix, the exponential of the
/// system. So every step is exact, and no stiffness, mass or damping makes the integration unstable.
#[derive(Clone, Debug)]
pub struct Hand {
    settings: HandSettings,
    steps: u32,
    step_s: f64,
    transition: [[f64; 2]; 2],
    coast: Coast,
    position: DVec3,
    velocity: DVec3,
}

impl Hand {
    /// A hand at rest at `position`, advanced by `period_s` > 0 at a time.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] names the parameter that is no mechanics.
    pub fn new(settings: HandSettings, period_s: f64, position: DVec3) -> Result<Hand, DeviceError> {
        settings.check()?;
        if !(period_s.is_finite() && period_s > 0.0 && period_s <= 1.0) {
            return Err(DeviceError::Setting {
                name: "simulated period",
                value: period_s.to_string(),
                accepted: "more than 0 and at most 1 [s]".to_owned(),
            });
        }
        let steps = (period_s / LONGEST_STEP_S).ceil().max(1.0);
        let step_s = period_s / steps;
        Ok(Hand {
            settings,
            steps: steps as u32,
            step_s,
            transition: transition(
                settings.stiffness_n_per_m / settings.mass_kg,
                settings.damping_n_s_per_m / settings.mass_kg,
                step_s,
            ),
            coast: Coast::new(settings.damping_n_s_per_m, settings.mass_kg, step_s),
            position,
            velocity: DVec3::ZERO,
        })
    }

    /// Where the handle is, device frame, m. RT safe.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Its derivative, m/s. RT safe.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// How a period is divided: steps, and the time of one, s.
    fn steps(&self) -> (u32, f64) {
        (self.steps, self.step_s)
    }

    /// One period under a constant force; `aim_at` gives the aim at a time since the period began, s. RT safe.
    pub fn advance(&mut self, force_n: DVec3, workspace: &Workspace, aim_at: impl Fn(f64) -> Aim) {
        let HandSettings { stiffness_n_per_m, damping_n_s_per_m, .. } = self.settings;
        let [[ee, ev], [ve, vv]] = self.transition;
        for step in 0..self.steps {
            let aim = aim_at((f64::from(step) + 0.5) * self.step_s);
            let equilibrium =
                aim.position + (damping_n_s_per_m * aim.velocity_m_per_s + force_n) / stiffness_n_per_m;
            let offset = self.position - equilibrium;
            self.position = equilibrium + ee * offset + ev * self.velocity;
            self.velocity = ve * offset + vv * self.velocity;
            self.stop_at_the_edge(workspace);
        }
    }

    /// One period of a hand that means to be nowhere, under a constant force: `m v' = -c v + f`. RT safe.
    pub fn coast(&mut self, force_n: DVec3, workspace: &Workspace) {
        let Coast { kept, way_s, push_s2 } = self.coast;
        let acceleration = force_n / self.settings.mass_kg;
        for _ in 0..self.steps {
            self.position += way_s * self.velocity + push_s2 * acceleration;
            self.velocity = kept * self.velocity + way_s * acceleration;
            self.stop_at_the_edge(workspace);
        }
    }

    /// The mechanical stops: the handle does not leave the workspace and loses its speed outward.
    fn stop_at_the_edge(&mut self, workspace: &Workspace) {
        let mut at = self.position - workspace.centre;
        let half_height = 0.5 * workspace.height_m;
        let mut is_out = false;
        if at.z.abs() > half_height {
            is_out = true;
            let side = at.z.signum();
            at.z = side * half_height;
            self.velocity.z = side * (side * self.velocity.z).min(0.0);
        }
        let across = at.truncate();
        let distance = across.length();
        if distance > workspace.radius_m {
            is_out = true;
            let outward = across / distance;
            at = (outward * workspace.radius_m).extend(at.z);
            let outward_speed = self.velocity.truncate().dot(outward).max(0.0);
            let remaining = self.velocity.truncate() - outward * outward_speed;
            self.velocity = remaining.extend(self.velocity.z);
        }
        if is_out {
            self.position = workspace.centre + at;
        }
    }
}

/// What one step does to a hand that has let go: exact, and the same for every step.
///
/// With `a = c/m` and the step `t`, the velocity keeps `e^(-a t)` of itself. Its way is `(1 - e^(-a t))/a` times the velocity,
/// and an acceleration adds `(t - way)/a` to the place and `way` to the velocity.
#[derive(Clone, Copy, Debug)]
struct Coast {
    kept: f64,
    way_s: f64,
    push_s2: f64,
}

impl Coast {
    fn new(damping_n_s_per_m: f64, mass_kg: f64, t: f64) -> Coast {
        let a = damping_n_s_per_m / mass_kg;
        let x = a * t;
        if x < 1e-4 {
            let way_s = t * (1.0 - x / 2.0 + x * x / 6.0);
            return Coast { kept: libm::exp(-x), way_s, push_s2: t * t * (0.5 - x / 6.0 + x * x / 24.0) };
        }
        let way_s = -libm::expm1(-x) / a;
        Coast { kept: libm::exp(-x), way_s, push_s2: (t - way_s) / a }
    }
}

/// The exponential of `[[0, 1], [-stiffness, -damping]] t`, both divided by the mass.
///
/// With `s = damping/2` and `d = s^2 - stiffness` it is `C I + S (A + s I)`, where `C = e^(-s t) cosh(sqrt(d) t)` and
/// `S = e^(-s t) sinh(sqrt(d) t)/sqrt(d)`; the exponents are taken together, so nothing overflows.
fn transition(stiffness: f64, damping: f64, t: f64) -> [[f64; 2]; 2] {
    let s = 0.5 * damping;
    let d = s * s - stiffness;
    let (c, sh) = if d.abs() * t * t < 1e-12 {
        let decay = libm::exp(-s * t);
        (decay, decay * t)
    } else if d < 0.0 {
        let w = (-d).sqrt();
        let decay = libm::exp(-s * t);
        (decay * libm::cos(w * t), decay * libm::sin(w * t) / w)
    } else {
        let r = d.sqrt();
        // The slow exponent r - s without the cancellation.
        let slow = libm::exp(-stiffness / (s + r) * t);
        let fast = libm::exp(-(s + r) * t);
        (0.5 * (slow + fast), 0.5 * (slow - fast) / r)
    };
    [[c + s * sh, sh], [-stiffness * sh, c - s * sh]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WORKSPACE: Workspace = LIMITS.workspace;
    const HAND: HandSettings =
        HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };

    fn still(position: DVec3) -> Aim {
        Aim { position, velocity_m_per_s: DVec3::ZERO }
    }

    #[test]
    fn a_hand_at_rest_on_its_aim_stays_there() {
        let at = DVec3::new(0.01, -0.02, 0.03);
        let mut hand = Hand::new(HAND, 1e-3, at).unwrap();
        for _ in 0..1000 {
            hand.advance(DVec3::ZERO, &WORKSPACE, |_| still(at));
        }
        assert_eq!(hand.position(), at);
        assert_eq!(hand.velocity(), DVec3::ZERO);
    }

    #[test]
    fn a_constant_force_moves_the_hand_by_force_over_stiffness() {
        let mut hand = Hand::new(HAND, 1e-3, DVec3::ZERO).unwrap();
        for _ in 0..2000 {
            hand.advance(DVec3::new(2.0, 0.0, -1.0), &WORKSPACE, |_| still(DVec3::ZERO));
        }
        assert!((hand.position() - DVec3::new(0.004, 0.0, -0.002)).length() < 1e-12);
    }

    #[test]
    fn pressing_a_spring_wall_ends_at_the_static_equilibrium() {
        // Aim 8 mm inside a wall z < 0 of 300 N/m: k (d - x) = K x, so x = 500 * 8 mm / (500 + 300) = 5 mm.
        let wall_n_per_m = 300.0;
        let mut hand = Hand::new(HAND, 1e-3, DVec3::new(0.0, 0.0, 0.01)).unwrap();
        for _ in 0..3000 {
            let force = DVec3::Z * (-wall_n_per_m * hand.position().z).max(0.0);
            hand.advance(force, &WORKSPACE, |_| still(DVec3::new(0.0, 0.0, -0.008)));
        }
        assert!((hand.position().z - -0.005).abs() < 1e-9, "{}", hand.position().z);
        assert!(hand.velocity().length() < 1e-9);
    }

    #[test]
    fn an_undamped_hand_swings_with_the_period_of_its_spring() {
        // 2 pi sqrt(m/k) with m = 0.1, k = 0.4 pi^2: exactly 1 s.
        let k = 0.4 * std::f64::consts::PI * std::f64::consts::PI;
        let settings = HandSettings { mass_kg: 0.1, stiffness_n_per_m: k, damping_n_s_per_m: 0.0 };
        let start = DVec3::new(0.05, 0.0, 0.0);
        let mut hand = Hand::new(settings, 1e-3, start).unwrap();
        for _ in 0..1000 {
            hand.advance(DVec3::ZERO, &WORKSPACE, |_| still(DVec3::ZERO));
        }
        assert!((hand.position() - start).length() < 1e-12);
    }

    #[test]
    fn an_unloaded_hand_keeps_up_with_an_aim_that_moves_evenly() {
        // In steady motion k (p - x) + c (w - v) = 0 with v = w: no lag.
        let speed = DVec3::new(0.1, 0.0, 0.0);
        let mut hand = Hand::new(HAND, 1e-3, DVec3::ZERO).unwrap();
        for tick in 0..1000 {
            let start_s = f64::from(tick) * 1e-3;
            hand.advance(DVec3::ZERO, &WORKSPACE, |since_s| Aim {
                position: speed * (start_s + since_s),
                velocity_m_per_s: speed,
            });
        }
        assert!((hand.position() - speed).length() < 1e-7, "{}", hand.position());
        assert!((hand.velocity() - speed).length() < 1e-6);
    }

    #[test]
    fn the_handle_stops_at_the_edge_of_the_workspace() {
        let mut hand = Hand::new(HAND, 1e-3, DVec3::ZERO).unwrap();
        for _ in 0..3000 {
            hand.advance(DVec3::ZERO, &WORKSPACE, |_| still(DVec3::new(1.0, 1.0, -1.0)));
            assert!(hand.position().truncate().length() <= WORKSPACE.radius_m * (1.0 + 1e-12));
            assert!(hand.position().z >= -0.5 * WORKSPACE.height_m);
        }
        assert!(hand.velocity().length() < 1e-6);
    }

    #[test]
    fn a_hand_that_has_let_go_is_pushed_away_and_comes_to_the_speed_that_its_damper_allows() {
        let mut hand = Hand::new(HAND, 1e-3, DVec3::ZERO).unwrap();
        let push_n = DVec3::new(0.0, 0.0, 0.5);
        for _ in 0..1000 {
            hand.coast(push_n, &WORKSPACE);
        }
        // 0.5 N against 20 N s/m. The way lags behind by one time constant, m/c = 15 ms.
        assert!((hand.velocity() - DVec3::new(0.0, 0.0, 0.025)).length() < 1e-12);
        assert!((hand.position().z - 0.025 * (1.0 - 0.015)).abs() < 1e-9, "{}", hand.position());
    }

    #[test]
    fn without_a_damper_a_hand_that_has_let_go_falls_freely() {
        let settings = HandSettings { damping_n_s_per_m: 0.0, ..HAND };
        let mut hand = Hand::new(settings, 1e-3, DVec3::ZERO).unwrap();
        for _ in 0..100 {
            hand.coast(DVec3::new(0.3, 0.0, 0.0), &WORKSPACE);
        }
        assert!((hand.velocity().x - 0.1).abs() < 1e-12 && (hand.position().x - 0.005).abs() < 1e-12);
    }

    #[test]
    fn settings_that_are_no_mechanics_are_refused_by_their_parameter_name() {
        for (settings, name) in [
            (HandSettings { mass_kg: 0.0, ..HAND }, "simulated.mass"),
            (HandSettings { stiffness_n_per_m: f64::NAN, ..HAND }, "simulated.stiffness"),
            (HandSettings { damping_n_s_per_m: -1.0, ..HAND }, "simulated.damping"),
        ] {
            let message = Hand::new(settings, 1e-3, DVec3::ZERO).unwrap_err().to_string();
            assert!(message.contains(name), "{message}");
        }
    }

    proptest! {
        // Stable for any ratio of stiffness, damping and mass: the energy of a hand left alone never grows.
        #[test]
        fn energy_never_grows_without_a_force(
            mass in -3.0..2.0f64, stiffness in -2.0..7.0f64, damping in -3.0..5.0f64, rate_hz in 10.0..4000.0f64,
            velocity in -1.0..1.0f64,
        ) {
            let ten = |x: f64| libm::pow(10.0, x);
            let settings = HandSettings {
                mass_kg: ten(mass), stiffness_n_per_m: ten(stiffness), damping_n_s_per_m: ten(damping),
            };
            let wide = Workspace { centre: DVec3::ZERO, radius_m: 1e9, height_m: 1e9 };
            let mut hand = Hand::new(settings, 1.0 / rate_hz, DVec3::new(0.01, 0.0, 0.0)).unwrap();
            hand.velocity = DVec3::X * velocity;
            let energy = |hand: &Hand| {
                0.5 * settings.mass_kg * hand.velocity.length_squared()
                    + 0.5 * settings.stiffness_n_per_m * hand.position.length_squared()
            };
            let mut free = hand.clone();
            let mut before = energy(&hand);
            for _ in 0..50 {
                hand.advance(DVec3::ZERO, &wide, |_| still(DVec3::ZERO));
                let now = energy(&hand);
                prop_assert!(now <= before * (1.0 + 1e-9) + 1e-300, "{before} -> {now}");
                before = now;
                let speed = free.velocity.length();
                free.coast(DVec3::ZERO, &wide);
                prop_assert!(free.velocity.length() <= speed);
            }
        }
    }
}
