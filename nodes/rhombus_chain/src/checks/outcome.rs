//! A chain is accepted and answers every depth, or it is refused for the right reason. There is no third outcome.
//!
//! What is right is computed here once more by another way: sums in closed form and in logarithms (MODEL section 2), angles by
//! arcsine, none of it shared with the model.

use thiserror::Error;

use super::Extreme;
use crate::contact_law::{ContactLaw, LawResponse};
use crate::contact_shape::ContactShape;
use crate::parameter_error::ParameterError;
use crate::parameters::{Formulation, SurfaceParameters};

/// What may become of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Accepted: finite, rising, without a jump, its closed form between the guards.
    Accepted,
    /// Refused: the energy law would snap through, and by MODEL's rule it does.
    SnapsThrough,
    /// Refused: the published law would not rise, and by MODEL's rule it does not.
    NotRising,
    /// Refused: the sum of the tangential stiffnesses is no number a machine holds.
    TangentialOverflow,
}

/// Something else became of it.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{what}: {extreme:?}")]
pub struct ThirdOutcome {
    /// What it was.
    pub extreme: Box<Extreme>,
    /// What is wrong.
    pub what: String,
}

/// What becomes of one chain at one depth.
///
/// # Errors
/// Neither accepted and total nor refused with the right reason.
pub fn outcome(extreme: &Extreme) -> Result<Outcome, ThirdOutcome> {
    let third = |what: String| ThirdOutcome { extreme: Box::new(*extreme), what };
    let rule = Rule::of(extreme);
    match ContactLaw::new(extreme.formulation, &[extreme.chain]) {
        Ok(law) => {
            rule.accepts().map_err(third)?;
            accepted(extreme, &rule, &law).map_err(third)?;
            Ok(Outcome::Accepted)
        }
        Err(error) => rule.refuses(&error).map_err(third),
    }
}

/// MODEL's rules, evaluated by themselves.
struct Rule {
    formulation: Formulation,
    /// Logarithm of `sum (q^2 e^(1/beta))^(i-1)`.
    ln_tangential_sum: f64,
    /// More than one unit, and `1/beta` beyond what is taken for a spring.
    is_too_steep: bool,
    /// Logarithm of the greater over the smaller side of the rule; positive: the law rises.
    ln_margin: f64,
    /// `S_n`, `sum q^(2(i-1))`.
    elongation_sum: f64,
    normal_sum: f64,
}

/// The rules' two sides differ by at least this share where a decision is judged: what rounding may decide is left alone.
const JUDGED_FROM: f64 = 1e-6;
/// Logarithms of sums between which the model may call it an overflow or not: its sums are carried in two parts.
const OVERFLOW: std::ops::RangeInclusive<f64> = 680.0..=710.0;
const STEEPEST: f64 = 600.0;
/// Shares of the digits that the closed form below loses.
const SUMS_LOSE: f64 = 1e-10;
const ARCSINE_LOSES: f64 = 1e-15;

impl Rule {
    fn of(extreme: &Extreme) -> Self {
        let chain = &extreme.chain;
        let units = f64::from(chain.units);
        // q - 1 is exact for q >= 1/2.
        let ln_ratio = libm::log1p(chain.ratio - 1.0);
        let steepness = 1.0 / chain.tangential_growth;
        let ln_tangential_sum = ln_sum(2.0 * ln_ratio + steepness, units);
        let ln_normal_sum = ln_sum(2.0 * ln_ratio, units);
        let ln_springs =
            libm::log(chain.normal_stiffness_n_per_m) - libm::log(chain.tangential_stiffness_n_per_m);
        let half_sine = libm::sin(0.5 * chain.angle_rad);
        let ln_margin = match extreme.formulation {
            Formulation::Published => ln_springs - 2.0 * libm::log(libm::tan(chain.angle_rad)),
            Formulation::Energy => {
                ln_springs + ln_normal_sum - ln_tangential_sum - libm::log(2.0 * half_sine * half_sine)
            }
        };
        Self {
            formulation: extreme.formulation,
            ln_tangential_sum,
            is_too_steep: chain.units > 1 && steepness > STEEPEST,
            ln_margin,
            elongation_sum: libm::exp(ln_sum(ln_ratio, units)),
            normal_sum: libm::exp(ln_normal_sum),
        }
    }

    fn accepts(&self) -> Result<(), String> {
        if self.is_too_steep || self.ln_tangential_sum > *OVERFLOW.end() {
            return Err(format!("accepted although the sum is e^{}", self.ln_tangential_sum));
        }
        if self.ln_margin < -JUDGED_FROM {
            return Err(format!("accepted although its rule fails by e^{}", self.ln_margin));
        }
        Ok(())
    }

    fn refuses(&self, error: &ParameterError) -> Result<Outcome, String> {
        let overflows = self.is_too_steep || self.ln_tangential_sum > *OVERFLOW.start();
        match (error, self.formulation) {
            (ParameterError::TangentialOverflow { .. }, _) if overflows => Ok(Outcome::TangentialOverflow),
            (ParameterError::SnapsThrough { .. }, Formulation::Energy) if self.ln_margin < JUDGED_FROM => {
                Ok(Outcome::SnapsThrough)
            }
            (ParameterError::NotRising { .. }, Formulation::Published) if self.ln_margin < JUDGED_FROM => {
                Ok(Outcome::NotRising)
            }
            _ => Err(format!(
                "refused for another reason (margin e^{}, sum e^{}): {error}",
                self.ln_margin, self.ln_tangential_sum
            )),
        }
    }

    /// `F` on the hand by MODEL section 2, and how far rounding may have put it off: by a share of its parts, between which
    /// digits may cancel, and where rods lie flat by what an arcsine near 1 loses.
    fn closed_form(&self, extreme: &Extreme, depth_m: f64) -> (f64, f64) {
        let chain = &extreme.chain;
        let (k_n, k_t) = (chain.normal_stiffness_n_per_m, chain.tangential_stiffness_n_per_m);
        let angle = chain.angle_rad;
        let dl_1 = -depth_m / self.elongation_sum;
        let x = libm::asin(libm::sin(angle) + dl_1 / (2.0 * chain.rod_length_m));
        let t = libm::tan(0.5 * (angle + x));
        let (spring, coupling, scale) = match self.formulation {
            Formulation::Published => (k_n, -k_t * t * libm::tan(angle), dl_1),
            Formulation::Energy => {
                let tangential = libm::exp(self.ln_tangential_sum) * k_t;
                (k_n * self.normal_sum, tangential * t * libm::tan(x), dl_1 / self.elongation_sum)
            }
        };
        let parts_n = (spring.abs() + coupling.abs()) * scale.abs();
        let flatness = libm::cos(x);
        (-(spring + coupling) * scale, parts_n * (SUMS_LOSE + ARCSINE_LOSES / (flatness * flatness)))
    }
}

/// `ln (1 + r + .. + r^(n-1))` for `r = e^ln_r`.
fn ln_sum(ln_r: f64, n: f64) -> f64 {
    if ln_r == 0.0 {
        return libm::log(n);
    }
    // For r > 1 the largest term first.
    let (largest, decay) = (ln_r.max(0.0) * (n - 1.0), -ln_r.abs());
    largest + libm::log(libm::expm1(n * decay) / libm::expm1(decay))
}

/// Everything that is said of an accepted law.
fn accepted(extreme: &Extreme, rule: &Rule, law: &ContactLaw) -> Result<(), String> {
    let (most_negative_m, pull_m) = law.chains()[0].guarded_range_m();
    let press_m = -most_negative_m;
    if !(press_m > 0.0 && pull_m > 0.0) {
        return Err(format!("guarded from {press_m:e} to {pull_m:e} m"));
    }
    let at_depth = answer(law, extreme.depth_m)?;
    inverse(law, &at_depth)?;
    shape(law, extreme.depth_m)?;
    for edge_m in [press_m, -pull_m, 0.0, extreme.depth_m] {
        no_jump(law, edge_m)?;
    }
    let shares = (-12..=12).map(|k| 0.125 * f64::from(k));
    let mut last: Option<LawResponse> = None;
    for share in shares {
        let depth_m = if share < 0.0 { share * pull_m } else { share * press_m };
        let now = answer(law, depth_m)?;
        if let Some(last) = last.filter(|last| now.force_n <= last.force_n) {
            return Err(format!("does not rise up to {depth_m:e} m: {last:?}, {now:?}"));
        }
        last = Some(now);
        if share.abs() < 1.0 {
            let (expected_n, tolerance_n) = rule.closed_form(extreme, depth_m);
            if (now.force_n - expected_n).abs() > tolerance_n {
                return Err(format!("{} N, its closed form {expected_n} N at {depth_m:e} m", now.force_n));
            }
            if now.saturated {
                return Err(format!("saturated inside its guards at {depth_m:e} m"));
            }
        }
    }
    Ok(())
}

/// A finite, passive answer.
fn answer(law: &ContactLaw, depth_m: f64) -> Result<LawResponse, String> {
    let response = law.at_depth(depth_m).map_err(|error| error.to_string())?;
    let LawResponse { force_n, stiffness_n_per_m, energy_j, .. } = response;
    let is_finite = force_n.is_finite() && stiffness_n_per_m.is_finite() && energy_j.is_finite();
    let is_passive = force_n * depth_m.signum() >= 0.0 && stiffness_n_per_m > 0.0 && energy_j >= 0.0;
    let chain = law.chains()[0].response(-depth_m);
    let moves = [chain.force_n, chain.energy_j, chain.dl_1_m, chain.d_theta_rad, chain.dw_1_m];
    if is_finite && is_passive && moves.iter().all(|number| number.is_finite()) {
        return Ok(response);
    }
    Err(format!("at {depth_m:e} m: {response:?}, {chain:?}"))
}

/// The next numbers on both sides have forces that differ by no more than the stiffness and rounding say.
fn no_jump(law: &ContactLaw, depth_m: f64) -> Result<(), String> {
    let here = answer(law, depth_m)?;
    for next_m in [depth_m.next_up(), depth_m.next_down()].into_iter().filter(|next_m| next_m.is_finite()) {
        let next = answer(law, next_m)?;
        let stiffness_n_per_m =
            here.stiffness_n_per_m.max(next.stiffness_n_per_m).max(law.rest_stiffness_n_per_m());
        let rounding_n = 1e-12 * (here.force_n.abs() + stiffness_n_per_m * depth_m.abs()).min(f64::MAX);
        let change_n = (next.force_n - here.force_n).abs();
        if change_n > 2.0 * stiffness_n_per_m * (next_m - depth_m).abs() + rounding_n {
            return Err(format!("jumps at {depth_m:e} m: {here:?}, {next:?}"));
        }
    }
    Ok(())
}

/// `|F(DL(F)) - F| <= 1e-12 max(|F|, 1e-9 m * rest stiffness)`.
fn inverse(law: &ContactLaw, response: &LawResponse) -> Result<(), String> {
    if response.force_n.abs() > 1e290 {
        return Ok(()); // a depth beyond the largest number may answer it
    }
    let depth_m = law.depth_for_force(response.force_n).map_err(|error| error.to_string())?;
    let back_n = answer(law, depth_m)?.force_n;
    let tolerance_n = 1e-12 * response.force_n.abs().max(1e-9 * law.rest_stiffness_n_per_m());
    if (back_n - response.force_n).abs() <= tolerance_n {
        return Ok(());
    }
    Err(format!("{} N needs {depth_m:e} m, which gives {back_n} N", response.force_n))
}

/// The surface around the contact: 1 at the contact, falling, 0 from the boundary on.
fn shape(law: &ContactLaw, depth_m: f64) -> Result<(), String> {
    let mut shape =
        ContactShape::new(law, &SurfaceParameters::default()).map_err(|error| error.to_string())?;
    shape.set_depth(law, depth_m).map_err(|error| error.to_string())?;
    let mut last = 1.0;
    for part in 0..=8 {
        let s_m = shape.boundary_m() * 0.125 * f64::from(part);
        let (share, moved) = (shape.share(s_m), shape.displacement(s_m, s_m));
        let falls =
            (0.0..=last).contains(&share) && (part > 0 || share == 1.0) && (part < 8 || share < 1e-12);
        if !(falls && moved.normal_m.is_finite() && moved.tangential_m.is_finite()) {
            return Err(format!(
                "at {depth_m:e} m the surface {s_m:e} m away has a share of {share} and {moved:?}"
            ));
        }
        last = share;
    }
    Ok(())
}
