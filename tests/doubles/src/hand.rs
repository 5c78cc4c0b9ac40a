//! A hand that rests at one place, then moves to another and presses there.

use devices::hand::{Aim, Hand, HandSettings};
use devices::{DeviceError, Workspace};
use glam::DVec3;

/// What the hand does; options of every double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandArguments {
    /// Where it rests first, device frame, m.
    pub from: DVec3,
    /// Where it presses later, m.
    pub to: DVec3,
    /// When it sets off, s after the start.
    pub after_s: f64,
    /// How long the way takes, s.
    pub during_s: f64,
    /// Its mechanics.
    pub settings: HandSettings,
}

impl Default for HandArguments {
    fn default() -> Self {
        HandArguments {
            from: DVec3::ZERO,
            to: DVec3::ZERO,
            after_s: 0.0,
            during_s: 1.0,
            settings: HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 },
        }
    }
}

impl HandArguments {
    /// Takes `option value` if it is one of the hand's: `--from x,y,z`, `--to x,y,z`, `--after S`, `--during S`,
    /// `--mass KG`, `--stiffness N/M`, `--damping N S/M`. False when it is not.
    ///
    /// # Errors
    /// The value is no number, or not three of them.
    pub fn take(&mut self, option: &str, value: &str) -> Result<bool, String> {
        let number = || {
            value.parse::<f64>().map_err(|error| format!("{option} {value:?}: {error}; accepted is a number"))
        };
        match option {
            "--from" => self.from = point(option, value)?,
            "--to" => self.to = point(option, value)?,
            "--after" => self.after_s = number()?,
            "--during" => self.during_s = number()?,
            "--mass" => self.settings.mass_kg = number()?,
            "--stiffness" => self.settings.stiffness_n_per_m = number()?,
            "--damping" => self.settings.damping_n_s_per_m = number()?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn aim(&self, time_s: f64) -> Aim {
        let way = self.to - self.from;
        let done = ((time_s - self.after_s) / self.during_s).clamp(0.0, 1.0);
        let moves = done > 0.0 && done < 1.0;
        Aim {
            position: self.from + done * way,
            velocity_m_per_s: if moves { way / self.during_s } else { DVec3::ZERO },
        }
    }
}

fn point(option: &str, value: &str) -> Result<DVec3, String> {
    let refused = || format!("{option} {value:?}: accepted are three numbers x,y,z in metres");
    let numbers: Result<Vec<f64>, _> = value.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) => Ok(DVec3::new(*x, *y, *z)),
        _ => Err(refused()),
    }
}

/// The hand in motion, by whatever clock the double has.
#[derive(Clone, Debug)]
pub struct PressingHand {
    arguments: HandArguments,
    workspace: Workspace,
    step_s: f64,
    time_s: f64,
    hand: Hand,
}

impl PressingHand {
    /// At rest, to be advanced in steps of `step_s`.
    ///
    /// # Errors
    /// The settings are no mechanics.
    pub fn new(
        arguments: HandArguments,
        workspace: Workspace,
        step_s: f64,
    ) -> Result<PressingHand, DeviceError> {
        let hand = Hand::new(arguments.settings, step_s, arguments.from)?;
        Ok(PressingHand { arguments, workspace, step_s, time_s: 0.0, hand })
    }

    /// One step under a constant force, N.
    pub fn advance(&mut self, force_n: DVec3) {
        let (arguments, start_s) = (&self.arguments, self.time_s);
        self.hand.advance(force_n, &self.workspace, |since_s| arguments.aim(start_s + since_s));
        self.time_s += self.step_s;
    }

    /// Where the handle is, m.
    pub fn position(&self) -> DVec3 {
        self.hand.position()
    }

    /// How it moves, m/s.
    pub fn velocity(&self) -> DVec3 {
        self.hand.velocity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_that_meets_no_force_gets_where_it_means_to() {
        let mut arguments = HandArguments::default();
        assert_eq!(arguments.take("--to", "0.01,0,-0.02"), Ok(true));
        assert_eq!(arguments.take("--after", "0.5"), Ok(true));
        assert_eq!(arguments.take("--port", "1"), Ok(false));
        assert!(arguments.take("--to", "1,2").is_err());
        let workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.1 };
        let mut hand = PressingHand::new(arguments, workspace, 0.5e-3).unwrap();
        for _ in 0..900 {
            hand.advance(DVec3::ZERO);
        }
        assert!(hand.position().length() < 1e-9, "it waits");
        for _ in 0..5000 {
            hand.advance(DVec3::ZERO);
        }
        assert!((hand.position() - arguments.to).length() < 1e-6);
    }
}
