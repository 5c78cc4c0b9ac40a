//! The largest stiffness that a session can ask of a device.

use crate::contact_law::{ContactLaw, ForceError};
use crate::stability::LawAnalysis;

/// How far a session can go. Both are sizes, >= 0; infinite means without end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Deepest press, m.
    pub press_m: f64,
    /// Longest pull, m; 0 when nothing can be grasped.
    pub pull_m: f64,
}

impl Reach {
    /// Any press and any pull.
    pub const ENDLESS: Reach = Reach { press_m: f64::INFINITY, pull_m: f64::INFINITY };

    /// As far as `largest_force_n` on the hand goes: beyond, the motors give that force and no stiffness.
    pub fn of_force(law: &ContactLaw, largest_force_n: f64) -> Reach {
        let depth_m = |force_n| match law.depth_for_force(force_n) {
            Ok(depth_m) => depth_m.abs(),
            Err(ForceError::OutOfReach { .. } | ForceError::NonFinite(_)) => f64::INFINITY,
        };
        let force_n = largest_force_n.abs();
        Reach { press_m: depth_m(force_n), pull_m: depth_m(-force_n) }
    }

    /// The same without a pull: a probe that only presses.
    #[must_use]
    pub fn without_grasp(self) -> Reach {
        Reach { pull_m: 0.0, ..self }
    }
}

/// Where the largest stiffness is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// At rest: the law softens in every direction it can go, or is straight.
    Rest,
    /// Pressed.
    Press,
    /// Pulled in a grasp.
    Pull,
    /// Across the normal in a grasp.
    Lateral,
}

/// The largest stiffness that a session can ask of a device, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Tangent stiffness at the hand, N/m.
    pub stiffness_n_per_m: f64,
    /// The depth closest to rest that has it, m, positive into the body; 0 for `Rest` and `Lateral`.
    pub depth_m: f64,
    /// What has to be done to meet it.
    pub cause: Cause,
}

impl Demand {
    /// The largest tangent stiffness of a law within a reach: at one of its ends, or at rest. Past the outermost guards the
    /// law is straight, so that an endless reach has a finite answer.
    pub fn of_law(law: &ContactLaw, reach: Reach) -> Demand {
        let (pull_m, press_m) = LawAnalysis::new(law).bent_m;
        let at = |depth_m: f64, cause| Demand {
            // A guard is a finite depth, and every finite depth has an answer.
            stiffness_n_per_m: law.at_depth(depth_m).map_or(0.0, |response| response.stiffness_n_per_m),
            depth_m,
            cause,
        };
        let rest = at(0.0, Cause::Rest);
        let press = at(press_m.min(reach.press_m), Cause::Press);
        let pull = at(pull_m.max(0.0 - reach.pull_m), Cause::Pull);
        [press, pull].into_iter().fold(rest, Demand::or)
    }

    /// The stiffer of two; the first when they are equal.
    #[must_use]
    pub fn or(self, other: Demand) -> Demand {
        if other.stiffness_n_per_m > self.stiffness_n_per_m { other } else { self }
    }

    /// Or the stiffness of a grasp across the normal, if that is larger.
    #[must_use]
    pub fn or_lateral(self, stiffness_n_per_m: f64) -> Demand {
        self.or(Demand { stiffness_n_per_m, depth_m: 0.0, cause: Cause::Lateral })
    }

    /// The same place where the stiffness is `factor` times as large: a stiffness map's largest factor, a motion scale.
    #[must_use]
    pub fn times(self, factor: f64) -> Demand {
        Demand { stiffness_n_per_m: self.stiffness_n_per_m * factor, ..self }
    }
}
