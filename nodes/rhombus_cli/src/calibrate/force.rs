//! The force law: stiffness at rest, tangential springs, angle and range from measured depths and forces.
//!
//! All chains get the same angle and range, so that they deform alike and share the force by their weights; the law is
//! then one closed form with four unknowns, and every value of them is acceptable (see [`fitted::chains`]):
//!
//! ```text
//! ln rest stiffness,  logit of the tangential share (0 to 1),  angle (0.05 to 1.5 rad),  ln of the range
//! ```
//!
//! Unknowns that the data leave open are found by the standard errors at the solution: the least certain one is put to its
//! default and the rest is fitted again, until all are known to a factor of e.

use rhombus_chain::{ContactLaw, Formulation};

use super::fitted::{self, ANGLE_RAD, BEST_DATA, FitError, Member, Spring};
use super::least_squares::{KNOWN, between, determine, real_of};

/// A measured depth and force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcePoint {
    /// Positive into the body, m.
    pub depth_m: f64,
    /// On the hand, positive pushes out, N.
    pub force_n: f64,
}

/// A fitted force law, and the members with the angle that goes with it.
pub(super) struct ForceFit {
    pub(super) spring: Spring,
    pub(super) members: Vec<Member>,
    pub(super) notes: Vec<String>,
}

/// Fewest measured points: as many as unknowns, and one to check.
pub(super) const FEWEST_POINTS: usize = 5;

const ANGLES: (f64, f64) = (0.05, 1.5);

/// Largest depth of the data within a range, as its share: all of it, or a small part.
const RANGES: (f64, f64) = (1.03, 30.0);

/// Shares of `tangential` that stay clear of the limit of acceptance by far more than rounding.
const TANGENTIAL: (f64, f64) = (0.0, 0.999);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Unknown {
    Rest,
    Tangential,
    Angle,
    Range,
}

const UNKNOWNS: [Unknown; 4] = [Unknown::Rest, Unknown::Tangential, Unknown::Angle, Unknown::Range];

/// From an almost straight line to a strongly curved one.
const STARTS: [[f64; 4]; 4] =
    [[0.0, -1.0, -1.0, -1.0], [0.3, 2.0, 0.0, -2.0], [-1.0, 3.0, 1.0, -3.0], [0.0, -4.0, 0.0, 0.0]];

/// Fits the force of parallel chains. `members` say how they share it.
///
/// # Errors
/// Too few points, no depth but 0, or forces that push the wrong way on the whole.
pub(super) fn fit(
    formulation: Formulation,
    members: &[Member],
    points: &[ForcePoint],
) -> Result<ForceFit, FitError> {
    let pressed_m = points.iter().map(|point| point.depth_m).fold(0.0, f64::max);
    let largest_m = points.iter().map(|point| point.depth_m.abs()).fold(0.0, f64::max);
    let force_n = (points.iter().map(|p| p.force_n * p.force_n).sum::<f64>() / points.len() as f64).sqrt();
    if points.len() < FEWEST_POINTS {
        let (found, chains) = (points.len(), members.len());
        let what = "measured depths and forces";
        return Err(FitError::TooFew { what, found, needed: FEWEST_POINTS, chains });
    }
    let work: f64 = points.iter().map(|point| point.depth_m * point.force_n).sum();
    if work.is_nan() || work <= 0.0 || force_n <= 0.0 {
        let accepted = "accepted: forces on the hand that push out (positive) where the depth is positive";
        return Err(FitError::Data(format!("the forces do not oppose the depths; {accepted}")));
    }
    let square: f64 = points.iter().map(|point| point.depth_m * point.depth_m).sum();
    let task = Task { formulation, members, points, secant_n_per_m: work / square, force_n, largest_m };
    let defaults = UNKNOWNS.map(|unknown| task.default_of(unknown));
    let found = determine(&STARTS.map(Vec::from), &defaults, BEST_DATA, KNOWN, |x| task.residuals(x));
    let found = found.ok_or(FitError::NoSolution("force"))?;
    let mut notes: Vec<String> = found.left_open.iter().map(|place| task.note(UNKNOWNS[*place])).collect();
    notes
        .push("chains.tangential_growth: only its product with k_t enters the force; the default".to_owned());
    if points.iter().all(|point| point.depth_m >= 0.0) {
        notes.push("no point is pulled: how the law answers a pull follows from the press alone".to_owned());
    } else if pressed_m <= 0.0 {
        notes.push("no point is pressed: how the law answers a press follows from the pull alone".to_owned());
    }
    let (spring, members) = task.law(&found.parameters);
    Ok(ForceFit { spring, members, notes })
}

struct Task<'a> {
    formulation: Formulation,
    members: &'a [Member],
    points: &'a [ForcePoint],
    /// The best straight line through rest.
    secant_n_per_m: f64,
    /// Root of the mean squared force.
    force_n: f64,
    largest_m: f64,
}

impl Task<'_> {
    fn default_of(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Rest => 0.0,
            Unknown::Tangential => f64::NEG_INFINITY,
            Unknown::Angle => real_of(ANGLES.0, ANGLES.1, ANGLE_RAD),
            Unknown::Range => real_of(libm::log(RANGES.0), libm::log(RANGES.1), libm::log(2.0)),
        }
    }

    fn note(&self, unknown: Unknown) -> String {
        let range_mm = 2e3 * self.largest_m;
        match unknown {
            Unknown::Rest => {
                "chains.normal_stiffness: the data do not tell it; the best straight line".to_owned()
            }
            Unknown::Tangential => {
                "chains.tangential_stiffness: no curvature above the scatter of the data; 0, a straight line"
                    .to_owned()
            }
            Unknown::Angle => {
                format!("chains.angle: the data do not tell it from the other parameters; {ANGLE_RAD} rad")
            }
            Unknown::Range => format!(
                "chains.rod_length: the data do not tell where the units are flat; {range_mm:?} mm, twice the largest depth"
            ),
        }
    }

    /// `x`: values of [`UNKNOWNS`].
    fn law(&self, x: &[f64]) -> (Spring, Vec<Member>) {
        let value = |unknown: Unknown| x[unknown as usize];
        let (low, high) = (libm::log(RANGES.0), libm::log(RANGES.1));
        let spring = Spring {
            formulation: self.formulation,
            rest_n_per_m: self.secant_n_per_m * libm::exp(value(Unknown::Rest).clamp(-30.0, 30.0)),
            tangential: between(TANGENTIAL.0, TANGENTIAL.1, value(Unknown::Tangential)),
            range_m: self.largest_m * libm::exp(between(low, high, value(Unknown::Range))),
        };
        let angle_rad = between(ANGLES.0, ANGLES.1, value(Unknown::Angle));
        (spring, self.members.iter().map(|member| Member { angle_rad, ..*member }).collect())
    }

    fn residuals(&self, x: &[f64]) -> Option<Vec<f64>> {
        let (spring, members) = self.law(x);
        // All chains deform alike: the first stands for all, which saves their number.
        let law = ContactLaw::new(spring.formulation, &fitted::chains(&spring, &members[..1])).ok()?;
        let error = |point: &ForcePoint| {
            let force_n = law.at_depth(point.depth_m).ok()?.force_n;
            Some((force_n - point.force_n) / self.force_n)
        };
        self.points.iter().map(error).collect()
    }
}

/// Relative L2 error of a law's forces.
///
/// # Errors
/// A depth that is not finite.
pub fn relative_error(law: &ContactLaw, points: &[ForcePoint]) -> Result<f64, FitError> {
    let (mut error, mut all) = (0.0, 0.0);
    for point in points {
        let response = law.at_depth(point.depth_m).map_err(|error| FitError::Data(error.to_string()))?;
        error += (response.force_n - point.force_n).powi(2);
        all += point.force_n * point.force_n;
    }
    Ok((error / all).sqrt())
}
