//! The damping that a device needs, and the verdict on it in one sentence.

use std::fmt;

use crate::stability::{Cause, Demand};

/// The loop between hand and law: what the device is, and how late the force comes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HapticLoop {
    /// Rate at which positions are taken and forces given, Hz; the force is held in between.
    pub rate_hz: f64,
    /// `tau`: time from position to force besides that, s. 0 where the motor loop evaluates the law itself.
    pub delay_s: f64,
    /// `b`: the device's own damping, N s/m; none when nobody knows it.
    pub damping_n_s_per_m: Option<f64>,
    /// `B`: damping that the loop renders, N s/m; the model renders none.
    pub rendered_damping_n_s_per_m: f64,
}

impl HapticLoop {
    /// `K (T/2 + tau) + |B|`, N s/m: with more damping than this the contact is passive, so that no hand can make it
    /// unstable. For `tau = 0` it is the condition of Colgate and Brown (1994), necessary and sufficient; with a delay it is
    /// the usual extension of it, confirmed against a simulated loop in the report.
    pub fn needed_damping_n_s_per_m(&self, stiffness_n_per_m: f64) -> f64 {
        stiffness_n_per_m * (0.5 / self.rate_hz + self.delay_s) + self.rendered_damping_n_s_per_m.abs()
    }

    /// The stiffness that a damping allows: the inverse of the above, N/m; 0 when the rendered damping eats it all.
    pub fn largest_passive_stiffness_n_per_m(&self, damping_n_s_per_m: f64) -> f64 {
        let left = damping_n_s_per_m - self.rendered_damping_n_s_per_m.abs();
        left.max(0.0) / (0.5 / self.rate_hz + self.delay_s)
    }

    /// Whether the device can render what is asked of it.
    pub fn judge(&self, demand: Demand) -> Verdict {
        let needed_n_s_per_m = self.needed_damping_n_s_per_m(demand.stiffness_n_per_m);
        Verdict { demand, haptic_loop: *self, needed_n_s_per_m }
    }
}

/// Whether a device can render what a session asks of it. Displayed, it is one sentence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// What is asked.
    pub demand: Demand,
    /// Of which device.
    pub haptic_loop: HapticLoop,
    /// The damping that has to be exceeded, N s/m.
    pub needed_n_s_per_m: f64,
}

impl Verdict {
    /// Passive or not; none when the device's damping is not known.
    pub fn is_passive(&self) -> Option<bool> {
        // A sum that overflowed is no number to exceed.
        self.haptic_loop.damping_n_s_per_m.map(|damping| damping > self.needed_n_s_per_m)
    }

    /// Whether a session should say so at its start: it fails, or cannot be judged.
    pub fn is_warning(&self) -> bool {
        self.is_passive() != Some(true)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let HapticLoop { rate_hz, delay_s, damping_n_s_per_m, .. } = self.haptic_loop;
        let needed = Figures(self.needed_n_s_per_m);
        match (self.is_passive(), damping_n_s_per_m) {
            (Some(true), Some(damping)) => {
                write!(
                    f,
                    "stable: the device's damping of {} N s/m exceeds the {needed} N s/m that ",
                    Figures(damping)
                )?;
            }
            (Some(false), Some(damping)) => write!(
                f,
                "may become unstable: the device's damping of {} N s/m does not exceed the {needed} N s/m that ",
                Figures(damping)
            )?,
            _ => write!(
                f,
                "cannot be judged, because the device's damping is not known: it has to exceed the {needed} N s/m that "
            )?,
        }
        write!(f, "a stiffness of {} N/m ", Figures(self.demand.stiffness_n_per_m))?;
        let millimetres = Figures(1e3 * self.demand.depth_m.abs());
        match self.demand.cause {
            Cause::Rest => write!(f, "(at rest) ")?,
            Cause::Press => write!(f, "(pressed {millimetres} mm) ")?,
            Cause::Pull => write!(f, "(pulled {millimetres} mm) ")?,
            Cause::Lateral => write!(f, "(across a grasp) ")?,
        }
        write!(f, "needs at {} Hz", Figures(rate_hz))?;
        match delay_s {
            delay_s if delay_s > 0.0 => write!(f, " with {} ms of delay", Figures(1e3 * delay_s))?,
            _ => write!(f, " without delay")?,
        }
        if self.is_passive() == Some(false) {
            write!(
                f,
                "; raise the rate, shorten the delay, soften the body or take a device with more damping"
            )?;
        }
        Ok(())
    }
}

/// A positive number with four significant digits; with all its digits before the point.
struct Figures(f64);

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        if value == 0.0 {
            return f.write_str("0");
        }
        if !(1e-3..1e6).contains(&value) {
            return write!(f, "{value:.3e}");
        }
        let digits_before = libm::floor(libm::log10(value)) as i32 + 1;
        let decimals = usize::try_from(4 - digits_before).unwrap_or(0);
        let text = format!("{value:.decimals$}");
        let text = if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        f.write_str(text)
    }
}
