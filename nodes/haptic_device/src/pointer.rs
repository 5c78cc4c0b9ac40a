//! Targets of a pointer from ROS 2: what arrives, what of it leads the hand, and why the rest does not.

use std::time::{Duration, Instant};

use devices::monotonic_ns;
use devices::pointer::{NotATarget, Target, TargetSender};
use node_kit::{Inbox, Level, NodeKit, RemotePublisher, StartError, Status, Throttle, convert, topics};
use r2r::geometry_msgs::msg::PoseStamped;
use scene::Scene;
use serde_json::{Value, json};

use crate::freshness::{Backlog, Freshness, age_ns};
use crate::now::now_ns;
use crate::placement::Placement;
use crate::pointer_frames::{NoTarget, PointerFrames};
use crate::sources::{names, trouble};

/// Between two looks at who publishes the topic.
const LOOK: Duration = Duration::from_millis(100);
/// The same while nobody is known.
const EAGER_LOOK: Duration = Duration::from_millis(10);
/// Between two diagnostics of one who points to and fro over the edge of the reach.
const LEAST_BETWEEN_NEWS: Duration = Duration::from_millis(100);
/// Between two lines of one kind.
const LINE: Duration = Duration::from_secs(1);

/// What arrived and what became of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PointerCounts {
    /// Targets that led the hand, or could have, had there not been a newer one.
    pub(crate) followed: u64,
    /// Targets in a frame that leads nowhere, or not finite.
    pub(crate) rejected: u64,
    /// Targets outside the device's workspace.
    pub(crate) out_of_reach: u64,
    /// Targets that came too late, or out of order.
    pub(crate) untimely: u64,
    /// Targets while the topic had more than one publisher, or none known yet.
    pub(crate) contested: u64,
}

/// The topic `pointer_target` of a device whose backend is the pointer.
pub(crate) struct Pointer {
    inbox: Inbox<PoseStamped>,
    hand: TargetSender,
    frames: PointerFrames,
    timeout_ns: i64,
    freshness: Freshness,
    backlog: Backlog,
    publishers: Vec<RemotePublisher>,
    looked: Option<Instant>,
    /// When the last target that is followed ends to count, by the monotonic clock.
    ends_ns: u64,
    counts: PointerCounts,
    reported: PointerCounts,
    /// When the newest target came, if that one was out of reach.
    out_of_reach: Option<Instant>,
    /// What the last diagnostics said of that, and when.
    told_out_of_reach: bool,
    told: Instant,
    lines: Lines,
}

/// One line a second for each kind of trouble.
struct Lines {
    rejected: Throttle,
    out_of_reach: Throttle,
    untimely: Throttle,
    contested: Throttle,
}

impl Pointer {
    /// Subscribes. `base` is the frame of the device's poses, `hand` the device's end of the targets.
    pub(crate) fn new(
        kit: &mut NodeKit,
        scene: &Scene,
        base: &str,
        hand: TargetSender,
    ) -> anyhow::Result<Pointer> {
        let of_session = |name: &str| kit.frame_id_of_session(&scene.session.devices, name);
        let Placement { base_from_body, motion_scale } = Placement::new(scene);
        let frames = PointerFrames::new(
            base,
            (&of_session(&scene.session.scene_frame_id), scene.device.scene_from_device),
            (&of_session(&scene.body.frame_id), base_from_body),
            motion_scale,
        );
        let timeout_ns = (scene.parameters().double("pointer.timeout")? * 1e9) as i64;
        let line = || Throttle::new(LINE);
        Ok(Pointer {
            inbox: subscribe(kit)?,
            hand,
            frames,
            timeout_ns,
            freshness: Freshness::new(timeout_ns),
            backlog: Backlog::new(timeout_ns.unsigned_abs()),
            publishers: Vec::new(),
            looked: None,
            ends_ns: 0,
            counts: PointerCounts::default(),
            reported: PointerCounts::default(),
            out_of_reach: None,
            told_out_of_reach: false,
            told: Instant::now(),
            lines: Lines { rejected: line(), out_of_reach: line(), untimely: line(), contested: line() },
        })
    }

    /// Passes on the newest of what arrived. True when the diagnostics should not wait: whoever points has left the device's
    /// reach, or come back into it.
    pub(crate) fn take(&mut self, kit: &NodeKit) -> bool {
        self.look(kit, LOOK);
        self.backlog.begin_turn(monotonic_ns());
        let mut newest = None;
        while let Some(message) = self.inbox.take() {
            if let Some(target) = self.target(kit, &message) {
                self.counts.followed += 1;
                newest = Some(target);
            }
        }
        if let Some(target) = newest {
            self.ends_ns = monotonic_ns().saturating_add((target.valid_for_s() * 1e9) as u64);
            self.hand.send(target);
        }
        self.backlog.end_turn(monotonic_ns());
        self.is_out_of_reach() != self.told_out_of_reach && self.told.elapsed() >= LEAST_BETWEEN_NEWS
    }

    /// Whether the newest target, if it still counted, is out of reach.
    fn is_out_of_reach(&self) -> bool {
        let timeout = Duration::from_nanos(self.timeout_ns.unsigned_abs());
        self.out_of_reach.is_some_and(|when| when.elapsed() < timeout)
    }

    /// The target of a message, if it is one to follow. It counts until it is as old as the time-out.
    fn target(&mut self, kit: &NodeKit, message: &PoseStamped) -> Option<Target> {
        let stamp_ns = convert::stamp_ns(&message.header.stamp);
        let clocks_ns = [now_ns(), convert::stamp_ns(&kit.now())];
        let age_ns = if stamp_ns == 0 { 0 } else { age_ns(stamp_ns, &clocks_ns).max(0) };
        let valid_for_s = self.timeout_ns.saturating_sub(age_ns) as f64 * 1e-9;
        let position = convert::pose_array(&message.pose);
        let position = [position[0], position[1], position[2]].into();
        let target = match self.frames.target(&message.header.frame_id, position, valid_for_s) {
            Ok(target) => {
                self.out_of_reach = None;
                target
            }
            Err(refusal @ NoTarget::Place(NotATarget::OutOfReach(_))) => {
                self.counts.out_of_reach += 1;
                self.out_of_reach = Some(Instant::now());
                self.lines.out_of_reach.warn(kit.log(), || format!("{}: not followed: {refusal}", name()));
                return None;
            }
            Err(refusal) => {
                self.counts.rejected += 1;
                self.lines.rejected.warn(kit.log(), || format!("{}: rejected: {refusal}", name()));
                return None;
            }
        };
        if !self.is_only_source(kit) {
            return None;
        }
        if let Err(untimely) = self.freshness.check(stamp_ns, &clocks_ns, &self.backlog) {
            self.counts.untimely += 1;
            self.lines.untimely.warn(kit.log(), || format!("{}: not followed: {untimely}", name()));
            return None;
        }
        Some(target)
    }

    /// Looks who publishes the topic, unless that was done within `period`.
    fn look(&mut self, kit: &NodeKit, period: Duration) {
        if self.looked.is_some_and(|looked| looked.elapsed() < period) {
            return;
        }
        self.looked = Some(Instant::now());
        // Nobody is known where nobody can be looked up, and nobody is followed.
        self.publishers = kit.publishers_of(&topics::POINTER_TARGET, "").unwrap_or_else(|error| {
            let text = || format!("{}: its publishers cannot be looked up: {error}", name());
            self.lines.contested.error(kit.log(), text);
            Vec::new()
        });
    }

    /// Whether the topic has one publisher. Two would pull the hand to and fro, so neither leads it.
    fn is_only_source(&mut self, kit: &NodeKit) -> bool {
        if self.publishers.is_empty() {
            self.look(kit, EAGER_LOOK);
        }
        if self.publishers.len() == 1 && self.conflict().is_none() {
            return true;
        }
        self.counts.contested += 1;
        if let Some(conflict) = self.conflict() {
            self.lines.contested.error(kit.log(), || conflict);
        }
        false
    }

    fn conflict(&self) -> Option<String> {
        trouble(name(), &self.publishers, "target")
    }

    /// The diagnostics, compared with those before.
    pub(crate) fn status(&mut self) -> Status {
        let PointerCounts { followed, rejected, out_of_reach, untimely, contested } = self.counts;
        let before = std::mem::replace(&mut self.reported, self.counts);
        let refused = (rejected - before.rejected) + (untimely - before.untimely);
        let beyond = out_of_reach - before.out_of_reach;
        (self.told_out_of_reach, self.told) = (self.is_out_of_reach(), Instant::now());
        let is_led = monotonic_ns() < self.ends_ns;
        let (level, summary) = match self.conflict() {
            Some(conflict) => (Level::Error, conflict),
            None if beyond > 0 => (Level::Warn, format!("{beyond} targets out of reach of the device")),
            None if refused > 0 => (Level::Warn, format!("{refused} targets were not followed")),
            None if is_led => (Level::Ok, "a pointer leads the hand".to_owned()),
            None => (Level::Ok, "no pointer: the hand has let go".to_owned()),
        };
        Status::new(level, "pointer", summary)
            .with("is_led", is_led)
            .with("is_out_of_reach", self.told_out_of_reach)
            .with("targets", followed)
            .with("rejected", rejected)
            .with("out_of_reach", out_of_reach)
            .with("untimely", untimely)
            .with("contested", contested)
            .with("publisher", names(&self.publishers))
    }

    /// The same for the closing report.
    pub(crate) fn closing(&self) -> Value {
        let PointerCounts { followed, rejected, out_of_reach, untimely, contested } = self.counts;
        json!({
            "targets": followed,
            "rejected": rejected,
            "out_of_reach": out_of_reach,
            "untimely": untimely,
            "contested": contested,
        })
    }
}

fn subscribe(kit: &mut NodeKit) -> Result<Inbox<PoseStamped>, StartError> {
    kit.subscribe(&topics::POINTER_TARGET, "")
}

fn name() -> &'static str {
    scene::topic::POINTER_TARGET
}
