//! Where the simulated hand means to be, as plain data: segments, evaluated at a time.

use glam::DVec3;
use thiserror::Error;

use crate::hand::Aim;

/// What the hand is doing. For logs and tests; the motion is in the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// On the way, clear of the body.
    Travel,
    /// Down to the surface.
    Approach,
    /// Into the body.
    Press,
    /// Staying where it is.
    Hold,
    /// Along the surface while pressed.
    Slide,
    /// Away from the body.
    Release,
    /// The gripper closes.
    Grasp,
    /// Outward and a bit sideways, the surface in the gripper.
    Pull,
    /// Back into the body, the surface in the gripper.
    PushBack,
    /// The gripper opens.
    Open,
}

/// One smooth motion that starts and ends at rest (minimum jerk), from where the segment before ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// What this is.
    pub phase: Phase,
    /// How long it takes, s, > 0.
    pub duration_s: f64,
    /// Points in the device frame that a smooth curve goes through, the last one its end; none: the target stays.
    pub path: Vec<DVec3>,
    /// Opening angle of the gripper at the end.
    pub gripper_rad: f64,
}

/// Where the hand means to be at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// In the device frame, m.
    pub position: DVec3,
    /// Its derivative.
    pub velocity_m_per_s: DVec3,
    /// Opening angle of the gripper.
    pub gripper_rad: f64,
    /// The segment's phase.
    pub phase: Phase,
}

impl Target {
    /// Its motion alone.
    pub(super) fn aim(&self) -> Aim {
        Aim { position: self.position, velocity_m_per_s: self.velocity_m_per_s }
    }
}

/// Why segments are not a script.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ScriptError {
    /// No segment, or none that says a place.
    #[error("a script needs at least one segment with a point to be at")]
    Nowhere,
    /// A duration that is not positive, or a number that is not finite.
    #[error("segment {segment} ({phase:?}): durations are > 0 s, durations, points and angles finite")]
    Segment {
        /// Its index.
        segment: usize,
        /// Its phase.
        phase: Phase,
    },
    /// There is no place to press.
    #[error("there is no site to press")]
    NoSite,
}

/// Segments that repeat for ever; the first starts where the last ended, so position and velocity never jump.
#[derive(Clone, Debug)]
pub struct Script {
    timed: Vec<Timed>,
    period_s: f64,
}

/// A segment with what evaluation needs: its end on the script's clock and its start.
#[derive(Clone, Debug)]
struct Timed {
    phase: Phase,
    start_s: f64,
    end_s: f64,
    /// At least one point: the first is where the segment starts.
    points: Vec<DVec3>,
    gripper_rad: (f64, f64),
}

impl Script {
    /// A script from its segments.
    ///
    /// # Errors
    /// [`ScriptError`] when there is nothing to follow or a number is unusable.
    pub fn new(segments: Vec<Segment>) -> Result<Script, ScriptError> {
        let mut at =
            segments.iter().rev().find_map(|s| s.path.last().copied()).ok_or(ScriptError::Nowhere)?;
        let mut gripper_rad = segments.last().map_or(0.0, |s| s.gripper_rad);
        let mut time_s = 0.0;
        let mut timed = Vec::with_capacity(segments.len());
        for (index, segment) in segments.into_iter().enumerate() {
            let usable = segment.duration_s.is_finite()
                && segment.duration_s > 0.0
                && segment.gripper_rad.is_finite()
                && segment.path.iter().all(|p| p.is_finite());
            if !usable {
                return Err(ScriptError::Segment { segment: index, phase: segment.phase });
            }
            let mut points = vec![at];
            points.extend_from_slice(&segment.path);
            at = points[points.len() - 1];
            let end_s = time_s + segment.duration_s;
            timed.push(Timed {
                phase: segment.phase,
                start_s: time_s,
                end_s,
                points,
                gripper_rad: (gripper_rad, segment.gripper_rad),
            });
            gripper_rad = segment.gripper_rad;
            time_s = end_s;
        }
        Ok(Script { timed, period_s: time_s })
    }

    /// Time after which the script repeats, s.
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    /// Every point the target goes through, in order.
    pub fn points(&self) -> impl Iterator<Item = DVec3> {
        self.timed.iter().flat_map(|segment| segment.points.iter().copied())
    }

    /// The target at a time >= 0 since the script began. RT safe.
    pub fn at(&self, time_s: f64) -> Target {
        let time_s = time_s.rem_euclid(self.period_s);
        let index = self.timed.partition_point(|s| s.end_s <= time_s).min(self.timed.len() - 1);
        self.timed[index].at(time_s)
    }
}

impl Timed {
    fn at(&self, time_s: f64) -> Target {
        let duration_s = self.end_s - self.start_s;
        let x = ((time_s - self.start_s) / duration_s).clamp(0.0, 1.0);
        // Minimum jerk: velocity and acceleration are zero at both ends.
        let progress = x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
        let progress_per_s = 30.0 * x * x * (1.0 - x) * (1.0 - x) / duration_s;
        let (position, derivative) = smooth_curve(&self.points, progress);
        let (from, to) = self.gripper_rad;
        Target {
            position,
            velocity_m_per_s: derivative * progress_per_s,
            gripper_rad: from + (to - from) * progress,
            phase: self.phase,
        }
    }
}

/// The curve through the points (a Catmull-Rom spline) at `progress` in 0..=1, and its derivative by progress.
fn smooth_curve(points: &[DVec3], progress: f64) -> (DVec3, DVec3) {
    let last = points.len() - 1;
    if last == 0 {
        return (points[0], DVec3::ZERO);
    }
    let along = progress * last as f64;
    let i = (along.floor() as usize).min(last - 1);
    let u = along - i as f64;
    let tangent = |k: usize| match k {
        0 => points[1] - points[0],
        k if k == last => points[last] - points[last - 1],
        k => 0.5 * (points[k + 1] - points[k - 1]),
    };
    let (p0, p1, m0, m1) = (points[i], points[i + 1], tangent(i), tangent(i + 1));
    let (u2, u3) = (u * u, u * u * u);
    let position = (2.0 * u3 - 3.0 * u2 + 1.0) * p0
        + (u3 - 2.0 * u2 + u) * m0
        + (3.0 * u2 - 2.0 * u3) * p1
        + (u3 - u2) * m1;
    let derivative = (6.0 * u2 - 6.0 * u) * p0
        + (3.0 * u2 - 4.0 * u + 1.0) * m0
        + (6.0 * u - 6.0 * u2) * p1
        + (3.0 * u2 - 2.0 * u) * m1;
    (position, derivative * last as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn segment(duration_s: f64, path: Vec<DVec3>, gripper_rad: f64) -> Segment {
        Segment { phase: Phase::Travel, duration_s, path, gripper_rad }
    }

    #[test]
    fn a_script_repeats_and_starts_where_it_ends() {
        let script = Script::new(vec![
            segment(1.0, vec![DVec3::X], 0.5),
            segment(0.5, vec![], 0.1),
            segment(2.0, vec![DVec3::Y, DVec3::Z], 0.5),
        ])
        .unwrap();
        assert_eq!(script.period_s(), 3.5);
        assert_eq!(script.at(0.0).position, DVec3::Z);
        assert_eq!(script.at(1.2).position, DVec3::X);
        assert_eq!(script.at(0.75), script.at(3.5 + 0.75));
    }

    #[test]
    fn a_straight_segment_is_half_way_after_half_its_time_at_the_known_peak_speed() {
        let script =
            Script::new(vec![segment(1.0, vec![DVec3::X], 0.0), segment(1.0, vec![DVec3::ZERO], 0.0)])
                .unwrap();
        let half = script.at(0.5);
        assert!((half.position - 0.5 * DVec3::X).length() < 1e-15);
        assert!((half.velocity_m_per_s.x - 1.875).abs() < 1e-12); // 15/8 of the mean: minimum jerk
    }

    #[test]
    fn unusable_segments_are_named() {
        assert_eq!(Script::new(vec![]).unwrap_err(), ScriptError::Nowhere);
        assert_eq!(Script::new(vec![segment(1.0, vec![], 0.0)]).unwrap_err(), ScriptError::Nowhere);
        for bad in [segment(0.0, vec![DVec3::X], 0.0), segment(1.0, vec![DVec3::NAN], 0.0)] {
            let error = Script::new(vec![segment(1.0, vec![DVec3::X], 0.0), bad]).unwrap_err();
            assert_eq!(error, ScriptError::Segment { segment: 1, phase: Phase::Travel });
        }
    }

    proptest! {
        #[test]
        fn position_and_velocity_are_continuous_and_agree(
            points in prop::collection::vec(prop::array::uniform3(-0.1..0.1f64), 2..12),
            duration_s in 0.3..3.0f64, time_s in 0.0..8.0f64,
        ) {
            let half = points.len() / 2;
            let path = |p: &[[f64; 3]]| p.iter().map(|&p| DVec3::from_array(p)).collect::<Vec<_>>();
            let script = Script::new(vec![
                segment(duration_s, path(&points[..half]), 0.5), segment(0.8, path(&points[half..]), 0.1),
            ]).unwrap();
            let h = 1e-6;
            // Between points at most D = 0.35 m apart the spline's derivatives by its parameter are at most 2.5 D and 12 D. Five
            // pieces in 0.3 s at minimum jerk: speeds < 30 m/s, accelerations < 5000 m/s^2.
            let joints = [0.0, duration_s, script.period_s()];
            for t in joints.into_iter().chain([time_s]) {
                let (before, after) = (script.at(t - h), script.at(t + h));
                prop_assert!((after.position - before.position).length() < 2.0 * h * 30.0);
                prop_assert!((after.velocity_m_per_s - before.velocity_m_per_s).length() < 2.0 * h * 5000.0);
                prop_assert!((after.gripper_rad - before.gripper_rad).abs() < 2.0 * h * 5.0);
                let difference = (after.position - before.position) / (2.0 * h);
                prop_assert!((difference - script.at(t).velocity_m_per_s).length() < 1e-3);
            }
        }
    }
}
