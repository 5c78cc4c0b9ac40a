//! Work of the hand on a closed path. The force is the gradient of an energy, so it is zero but for the error of the sum
//! and, on curved bodies, for the interpolated normal, which follows the mesh's facets only on average.

use glam::DVec3;

use crate::body::Body;
use crate::interaction::{Interaction, Step, StepError};
use crate::tissue::Tissue;

/// A smooth closed path of depth and position: three harmonics for each of three coordinates.
///
/// Its coordinates go around `centre` by `radius` at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedPath {
    /// Middle of the path.
    pub centre: DVec3,
    /// How far it goes along each axis.
    pub radius: DVec3,
    /// Cosine and sine amplitudes, -1 to 1, of the three harmonics.
    amplitudes: [[DVec3; 2]; 3],
}

impl ClosedPath {
    /// How many numbers make one.
    pub const NUMBERS: usize = 18;

    /// From numbers between 0 and 1.
    #[must_use]
    pub fn from_unit(numbers: [f64; Self::NUMBERS], centre: DVec3, radius: DVec3) -> Self {
        let vector = |first: usize| DVec3::from_slice(&numbers[first..]) * 2.0 - 1.0;
        let amplitudes = std::array::from_fn(|k| [vector(6 * k), vector(6 * k + 3)]);
        Self { centre, radius, amplitudes }
    }

    /// Where the path is at `share` of its way; at 0 where it is at 1.
    #[must_use]
    pub fn at(&self, share: f64) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for (k, [cosines, sines]) in self.amplitudes.iter().enumerate() {
            let harmonic = (k + 1) as f64;
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * harmonic * share);
            sum += (*cosines * cosine + *sines * sine) / (harmonic * harmonic);
        }
        // sqrt(2) (1 + 1/4 + 1/9) = 1.925.
        self.centre + self.radius * sum / 1.925
    }
}

/// Of the hand on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Over the whole path, J.
    pub net_j: f64,
    /// The sum of its parts' sizes, J: what went in and came out again.
    pub exchanged_j: f64,
}

/// Work along `probe_at(0) .. probe_at(1)` in the body frame by Simpson's rule with `steps` equal steps. A step in which the
/// force may jump, because it comes or goes or a stiffness map has another gradient, is halved until hardly anything of it is
/// left.
///
/// # Errors
/// A position that the model does not accept.
pub fn work(
    body: &Body,
    tissue: &Tissue,
    steps: u32,
    probe_at: impl Fn(f64) -> DVec3,
) -> Result<Work, StepError> {
    let hand = Hand { body, tissue, probe_at: &probe_at };
    let mut work = Work::default();
    let mut last = hand.at(0.0, &Interaction::new())?;
    for k in 1..=steps {
        let (middle, end) = (f64::from(k) - 0.5, f64::from(k));
        let middle = hand.at(middle / f64::from(steps), &last.interaction)?;
        let next = hand.at(end / f64::from(steps), &middle.interaction)?;
        hand.add(&mut work, [&last, &middle, &next], HALVINGS)?;
        last = next;
    }
    Ok(work)
}

const HALVINGS: u32 = 12;
/// Share of the work so far that a step with a jump may be wrong by.
const NEGLIGIBLE: f64 = 1e-7;

struct Hand<'a, P> {
    body: &'a Body,
    tissue: &'a Tissue,
    probe_at: &'a P,
}

/// The hand on its path, with the contact as it is there.
struct Place {
    share: f64,
    probe: DVec3,
    interaction: Interaction,
    step: Step,
}

impl<P: Fn(f64) -> DVec3> Hand<'_, P> {
    fn at(&self, share: f64, before: &Interaction) -> Result<Place, StepError> {
        let (probe, mut interaction) = ((self.probe_at)(share), before.clone());
        let step = interaction.step(self.body, self.tissue, 0, probe, false)?;
        Ok(Place { share, probe, interaction, step })
    }

    /// Adds the way over three places.
    fn add(&self, work: &mut Work, places: [&Place; 3], halvings: u32) -> Result<(), StepError> {
        let [from, middle, to] = places;
        let (whole_j, halves_j) = (trapezoid(from, to), trapezoid(from, middle) + trapezoid(middle, to));
        let is_small = halvings == 0 || (halves_j - whole_j).abs() <= NEGLIGIBLE * work.exchanged_j;
        if is_small || !(self.may_jump(from, middle) || self.may_jump(middle, to)) {
            let part_j = (4.0 * halves_j - whole_j) / 3.0;
            work.net_j += part_j;
            work.exchanged_j += part_j.abs();
            return Ok(());
        }
        for (from, to) in [(from, middle), (middle, to)] {
            let between = self.at(0.5 * (from.share + to.share), &from.interaction)?;
            self.add(work, [from, &between, to], halvings - 1)?;
        }
        Ok(())
    }

    fn may_jump(&self, from: &Place, to: &Place) -> bool {
        let face = |place: &Place| place.step.surface_point.map(|at| at.face);
        from.step.mode != to.step.mode || (self.body.stiffness().is_some() && face(from) != face(to))
    }
}

/// The hand pushes against the force on it.
fn trapezoid(from: &Place, to: &Place) -> f64 {
    -0.5 * (from.step.force_n + to.step.force_n).dot(to.probe - from.probe)
}
