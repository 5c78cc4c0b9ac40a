//! The choice among the sources, and what happens between them.

use rhombus_chain::Pose;

use super::hand_over::HandOver;
use super::servo::Servo;
use super::{ForceSource, LawCommand, Moment, ServoCommand, SourceMode, hold, law};
use crate::safety::CheckedSettings;
use crate::safety::vector::limited;
use crate::{DeviceState, Wrench};

/// Where a force comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForceOrigin {
    /// Nobody: no valid command, hence no force.
    #[default]
    Nobody,
    /// The contact law, evaluated in the motor loop.
    ContactLaw,
    /// A commanded wrench.
    ServoForce,
    /// The spring that holds the handle.
    Hold,
}

/// What is wanted of the motors in one period, before the safety layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wanted {
    /// In the device frame, on the hand; of any size.
    pub wrench: Wrench,
    /// Where it comes from. A source that is past its validity is named until its force has fallen to nothing.
    pub origin: ForceOrigin,
    /// How deep the probe is by the contact law, m, negative when the body is pulled; 0 without a law or a contact.
    pub depth_m: f64,
    /// Whether this is what a valid source says, and neither the rest of one that is past its validity nor on the way
    /// from one source to another.
    pub settled: bool,
    /// Whether a new command was refused: not finite, from the future or out of order.
    pub refused: bool,
}

/// What the choice is made from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The handle; finite.
    pub state: &'a DeviceState,
    /// Now.
    pub now: Moment,
    /// What the motors do with the sources.
    pub mode: SourceMode,
    /// Whether the operating state permits a force. Where it does not, the pose to hold goes along with the hand.
    pub permitted: bool,
    /// The newest contact law.
    pub law: Option<&'a LawCommand>,
    /// The newest commanded wrench.
    pub servo: Option<&'a ServoCommand>,
}

/// Which wrench is wanted, period for period. Plain state: time comes in with every call.
///
/// A source past its validity does not end at once: its last force is frozen and falls to zero over `safety.decay`.
/// Frozen, not evaluated further: a law that nobody renews describes a place where the body no longer is, and evaluated
/// there its force may grow while the gain falls; the frozen one can only fall. What it does to a hand that moves on is
/// bounded by the decay time, and watched by the passivity controller.
///
/// When the source changes, the difference between the wrench before and what the new source says fades over 20 ms.
#[derive(Clone, Debug)]
pub struct Source {
    source: ForceSource,
    servo_validity_ns: u64,
    law_validity_ns: i64,
    decay_ns: u64,
    /// Nothing larger reaches the motors; a difference to what they got is taken from no more than this.
    largest_n: f64,
    largest_n_m: f64,
    largest_gripper_n: f64,
    servo: Servo,
    state: State,
    hand_over: HandOver,
    /// Where to hold, while the mode is hold.
    held: Option<Pose>,
    last: Wrench,
}

/// What the last period's wrench was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// What a valid source says (or nobody, which is always valid), until a time by the monotonic clock.
    Valid(ForceOrigin, u64),
    /// The rest of a source, which began to fall at a time by the monotonic clock from `frozen`.
    Falling(ForceOrigin, u64),
}

struct Candidate {
    origin: ForceOrigin,
    wrench: Wrench,
    depth_m: f64,
    until_ns: u64,
}

const NOBODY: Candidate =
    Candidate { origin: ForceOrigin::Nobody, wrench: Wrench::ZERO, depth_m: 0.0, until_ns: u64::MAX };

impl Source {
    /// Nobody has said anything yet.
    pub fn new(source: ForceSource, settings: &CheckedSettings) -> Source {
        let ns = |seconds: f64| (seconds * 1e9).round() as u64;
        Source {
            source,
            servo_validity_ns: ns(settings.servo_validity_s),
            law_validity_ns: i64::try_from(ns(settings.law_validity_s)).unwrap_or(i64::MAX),
            decay_ns: ns(settings.decay_s),
            largest_n: settings.max_force_n,
            largest_n_m: settings.max_torque_n_m,
            largest_gripper_n: settings.max_gripper_force_n,
            servo: Servo::default(),
            state: State::Valid(ForceOrigin::Nobody, u64::MAX),
            hand_over: HandOver::default(),
            held: None,
            last: Wrench::ZERO,
        }
    }

    /// The wrench for this period. RT safe.
    pub fn want(&mut self, inputs: &Inputs) -> Wanted {
        let now_ns = inputs.now.monotonic_ns;
        let refused = self.servo.take(inputs.servo, inputs.now);
        let candidate = match inputs.mode {
            SourceMode::Free => Some(NOBODY),
            SourceMode::Hold => Some(self.hold(inputs)),
            SourceMode::Follow => self.valid(inputs),
        };
        let wanted = match candidate {
            Some(candidate) => self.follow(candidate, now_ns),
            None => self.fall(now_ns),
        };
        if inputs.mode != SourceMode::Hold || !inputs.permitted {
            self.held = None;
        }
        self.last = wanted.wrench;
        Wanted { refused, ..wanted }
    }

    fn hold(&mut self, inputs: &Inputs) -> Candidate {
        let held = self.held.get_or_insert(inputs.state.pose);
        let wrench = hold::wrench(held, inputs.state);
        Candidate { origin: ForceOrigin::Hold, wrench, depth_m: 0.0, until_ns: u64::MAX }
    }

    /// The first source that may be used in full.
    fn valid(&self, inputs: &Inputs) -> Option<Candidate> {
        let Inputs { state, now, .. } = *inputs;
        if self.source == ForceSource::ContactLaw
            && let Some(command) = inputs.law
            && let Some(until_ns) = law::expires_ns(command, self.law_validity_ns, now)
        {
            let (wrench, depth_m) = law::evaluate(command, state);
            if wrench.is_finite() {
                return Some(Candidate { origin: ForceOrigin::ContactLaw, wrench, depth_m, until_ns });
            }
        }
        let (wrench, until_ns) = self.servo.wrench(state, self.servo_validity_ns, now)?;
        Some(Candidate { origin: ForceOrigin::ServoForce, wrench, depth_m: 0.0, until_ns })
    }

    /// What the candidate says, or the way to it.
    fn follow(&mut self, candidate: Candidate, now_ns: u64) -> Wanted {
        let Candidate { origin, wrench, depth_m, until_ns } = candidate;
        if !matches!(self.state, State::Valid(before, _) if before == origin) {
            self.hand_over.begin(&self.bounded(&self.last), &self.bounded(&wrench), now_ns);
        }
        self.state = State::Valid(origin, until_ns);
        let share = self.hand_over.share(now_ns);
        Wanted {
            wrench: share.map_or(wrench, |share| self.hand_over.blend(&self.bounded(&wrench), share)),
            origin,
            depth_m,
            settled: share.is_none() && origin != ForceOrigin::Nobody,
            refused: false,
        }
    }

    /// No source may be used: the last one's force falls, if it was a source that can grow old; nobody otherwise.
    fn fall(&mut self, now_ns: u64) -> Wanted {
        let (origin, began_ns) = match self.state {
            State::Falling(origin, began_ns) => (origin, began_ns),
            // A law that was replaced by an unusable one begins to fall now, earlier than its validity said.
            State::Valid(origin @ (ForceOrigin::ContactLaw | ForceOrigin::ServoForce), until_ns) => {
                self.state = State::Falling(origin, until_ns.min(now_ns));
                self.hand_over.begin(&self.bounded(&self.last), &Wrench::ZERO, now_ns);
                (origin, until_ns.min(now_ns))
            }
            State::Valid(..) => return self.follow(NOBODY, now_ns),
        };
        let since_ns = now_ns.saturating_sub(began_ns);
        if since_ns >= self.decay_ns {
            self.hand_over.end();
            self.state = State::Valid(ForceOrigin::Nobody, u64::MAX);
            return Wanted::default();
        }
        let gain = 1.0 - since_ns as f64 / self.decay_ns as f64;
        let wrench = self.hand_over.blend(&Wrench::ZERO, gain);
        Wanted { wrench, origin, depth_m: 0.0, settled: false, refused: false }
    }

    fn bounded(&self, wrench: &Wrench) -> Wrench {
        Wrench {
            force_n: limited(wrench.force_n, self.largest_n),
            torque_n_m: limited(wrench.torque_n_m, self.largest_n_m),
            gripper_force_n: wrench.gripper_force_n.clamp(-self.largest_gripper_n, self.largest_gripper_n),
        }
    }
}
