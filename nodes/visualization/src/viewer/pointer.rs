//! The pointer of each device: which page moves it, and what is published of what the page says.

use std::time::{Duration, Instant};

use node_kit::{NodeKit, PublishError, Publisher, convert, topics};
use r2r::geometry_msgs::msg::{PoseStamped, Quaternion};
use r2r::std_msgs::msg::{Bool, Header};

use super::link::Page;
use super::protocol;

/// A page whose last target is older lets go of what it holds, and another page may take the pointer.
const TARGET_TIMEOUT: Duration = Duration::from_millis(300);

/// Where a page wants the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Target {
    /// Grows from one target of a page to the next.
    pub(crate) sequence: u64,
    /// m, in the body's frame.
    pub(crate) position_m: [f64; 3],
    pub(crate) grasp: bool,
}

/// The pointers of all devices.
pub(crate) struct Pointers {
    body_frame: String,
    devices: Vec<Pointer>,
    targets: u64,
}

/// What pages need to know before they ask for a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PointerState {
    pub(crate) takes_targets: bool,
    /// By a page that goes on moving it.
    pub(crate) is_held: bool,
}

/// One device: its name, and who moves it.
struct Pointer {
    device: String,
    /// Kept once it is made, so that its last message arrives.
    grasp: Option<Publisher<Bool>>,
    held: Option<Held>,
}

struct Held {
    page: Page,
    hold: Hold,
    target: Publisher<PoseStamped>,
}

impl Held {
    /// Whether another page may take it.
    fn may_be_taken(&self, now: Instant) -> bool {
        self.page.is_gone() || self.hold.is_silent(now)
    }
}

/// What the page that holds a pointer has said so far.
#[derive(Clone, Debug)]
struct Hold {
    sequence: Option<u64>,
    /// The last target, or the taking.
    last: Instant,
    grasps: bool,
}

impl Hold {
    fn new(now: Instant) -> Hold {
        Hold { sequence: None, last: now, grasps: false }
    }

    /// A target: whether grasping changes with it, or why it is not accepted.
    fn hear(&mut self, now: Instant, target: &Target) -> Result<bool, String> {
        if let Some(newest) = self.sequence
            && target.sequence <= newest
        {
            return Err(format!(
                "target {} comes after target {newest}; growing numbers are accepted",
                target.sequence
            ));
        }
        (self.sequence, self.last) = (Some(target.sequence), now);
        Ok(std::mem::replace(&mut self.grasps, target.grasp) != target.grasp)
    }

    fn is_silent(&self, now: Instant) -> bool {
        now.duration_since(self.last) >= TARGET_TIMEOUT
    }

    /// True once when a grasp must end because nothing was heard.
    fn lets_go(&mut self, now: Instant) -> bool {
        self.is_silent(now) && std::mem::take(&mut self.grasps)
    }
}

impl Pointers {
    pub(crate) fn new(body_frame: String, devices: &[String]) -> Pointers {
        let devices = devices
            .iter()
            .map(|device| Pointer { device: device.clone(), grasp: None, held: None })
            .collect();
        Pointers { body_frame, devices, targets: 0 }
    }

    /// Targets published since the start.
    pub(crate) fn targets(&self) -> u64 {
        self.targets
    }

    /// Whether a device takes the targets of a page, and whether one moves it.
    pub(crate) fn state(
        &self,
        kit: &NodeKit,
        now: Instant,
        device: usize,
    ) -> Result<PointerState, r2r::Error> {
        let Some(pointer) = self.devices.get(device) else { return Ok(PointerState::default()) };
        Ok(match &pointer.held {
            Some(held) => {
                PointerState { takes_targets: held.target.readers() > 0, is_held: !held.may_be_taken(now) }
            }
            // It listens, and nobody else sends it any.
            None => PointerState { takes_targets: refusal(kit, &pointer.device)?.is_none(), is_held: false },
        })
    }

    /// A page asks for a pointer; it is told whether it gets it.
    pub(crate) fn take(
        &mut self,
        kit: &mut NodeKit,
        now: Instant,
        page: Page,
        device: &str,
    ) -> anyhow::Result<()> {
        let Some(pointer) = self.devices.iter_mut().find(|pointer| pointer.device == device) else {
            page.tell(protocol::pointer(device, Err("there is no such device; hello names them")));
            return Ok(());
        };
        match &pointer.held {
            Some(held) if held.page == page => {}
            Some(held) if !held.may_be_taken(now) => {
                page.tell(protocol::pointer(device, Err("another page moves it")));
                return Ok(());
            }
            Some(_) => pointer.release(kit, Some("another page has taken it"))?,
            None => {}
        }
        if pointer.held.is_none() {
            if let Some(reason) = refusal(kit, device)? {
                page.tell(protocol::pointer(device, Err(&reason)));
                return Ok(());
            }
            if pointer.grasp.is_none() {
                pointer.grasp = Some(kit.publish(&topics::GRASP, device)?);
            }
            let target = kit.publish(&topics::POINTER_TARGET, device)?;
            pointer.held = Some(Held { page: page.clone(), hold: Hold::new(now), target });
        }
        page.tell(protocol::pointer(device, Ok(())));
        Ok(())
    }

    /// A page gives a pointer back.
    pub(crate) fn release(&mut self, kit: &mut NodeKit, page: &Page, device: &str) -> anyhow::Result<()> {
        match self.devices.iter_mut().find(|pointer| pointer.is_held_by(page, device)) {
            Some(pointer) => pointer.release(kit, Some("given back")),
            None => {
                page.refuse(&format!(
                    "the pointer of {device:?} is not this page's; pointer_take asks for it"
                ));
                Ok(())
            }
        }
    }

    /// A page moves a pointer that it holds.
    pub(crate) fn aim(
        &mut self,
        kit: &NodeKit,
        now: Instant,
        page: &Page,
        device: &str,
        target: &Target,
    ) -> anyhow::Result<()> {
        let pointer = self.devices.iter_mut().find(|pointer| pointer.is_held_by(page, device));
        let Some(Pointer { held: Some(held), grasp, .. }) = pointer else {
            page.refuse(&format!("the pointer of {device:?} is not this page's; pointer_take asks for it"));
            return Ok(());
        };
        match held.hold.hear(now, target) {
            Err(reason) => page.refuse(&reason),
            Ok(grasp_changes) => {
                held.target.publish(&message(kit, &self.body_frame, target.position_m))?;
                self.targets += 1;
                if grasp_changes {
                    say(grasp.as_ref(), target.grasp)?;
                }
            }
        }
        Ok(())
    }

    /// Once a turn: what a silent page holds is let go, what a page that is gone held is free.
    pub(crate) fn look_after(&mut self, kit: &mut NodeKit, now: Instant) -> anyhow::Result<()> {
        for pointer in &mut self.devices {
            if pointer.held.as_ref().is_some_and(|held| held.page.is_gone()) {
                pointer.release(kit, None)?;
            }
            if let Some(held) = &mut pointer.held
                && held.hold.lets_go(now)
            {
                say(pointer.grasp.as_ref(), false)?;
            }
        }
        Ok(())
    }

    /// Let everything go, at the end.
    pub(crate) fn release_all(&mut self, kit: &mut NodeKit) -> anyhow::Result<()> {
        self.devices.iter_mut().try_for_each(|pointer| pointer.release(kit, Some("the node ends")))
    }
}

impl Pointer {
    fn is_held_by(&self, page: &Page, device: &str) -> bool {
        self.device == device && self.held.as_ref().is_some_and(|held| held.page == *page)
    }

    /// Let go, tell the page why, leave the topics.
    fn release(&mut self, kit: &mut NodeKit, why: Option<&str>) -> anyhow::Result<()> {
        let Some(held) = self.held.take() else { return Ok(()) };
        if held.hold.grasps {
            say(self.grasp.as_ref(), false)?;
        }
        if let Some(why) = why {
            held.page.tell(protocol::pointer(&self.device, Err(why)));
        }
        // Another source of targets may come now; two at once would both be refused.
        kit.unpublish(held.target);
        Ok(())
    }
}

fn say(grasp: Option<&Publisher<Bool>>, grasps: bool) -> Result<(), PublishError> {
    grasp.map_or(Ok(()), |grasp| grasp.publish(&Bool { data: grasps }))
}

/// Why the targets of a page would not move a device; to be asked while this node publishes none.
fn refusal(kit: &NodeKit, device: &str) -> Result<Option<String>, r2r::Error> {
    let others = kit.publishers_of(&topics::POINTER_TARGET, device)?;
    Ok(match others.first() {
        Some(other) => Some(format!("{} already moves it", other.node)),
        // Known to the graph though nobody publishes it: somebody listens.
        None if kit.is_in_graph(&topics::POINTER_TARGET, device)? => None,
        None => Some("no device listens to pointer_target; device.backend: pointer does".to_owned()),
    })
}

fn message(kit: &NodeKit, body_frame: &str, position_m: [f64; 3]) -> PoseStamped {
    let mut message = PoseStamped {
        header: Header { stamp: kit.now(), frame_id: body_frame.to_owned() },
        ..PoseStamped::default()
    };
    message.pose.position = convert::point(position_m.into());
    message.pose.orientation = Quaternion { w: 1.0, ..Quaternion::default() };
    message
}

#[cfg(test)]
mod tests {
    use super::*;

    fn target(sequence: u64, grasp: bool) -> Target {
        Target { sequence, position_m: [0.0; 3], grasp }
    }

    #[test]
    fn targets_that_were_overtaken_are_refused() {
        let now = Instant::now();
        let mut hold = Hold::new(now);
        assert_eq!(hold.hear(now, &target(5, false)), Ok(false));
        for old in [5, 4, 0] {
            assert!(hold.hear(now, &target(old, true)).unwrap_err().contains("growing"), "{old}");
        }
        assert_eq!(hold.hear(now, &target(6, true)), Ok(true), "what was refused changed nothing");
        assert_eq!(hold.hear(now, &target(7, true)), Ok(false));
    }

    #[test]
    fn a_silent_page_lets_go_once() {
        let start = Instant::now();
        let mut hold = Hold::new(start);
        hold.hear(start, &target(1, true)).unwrap();
        let at = |ms| start + Duration::from_millis(ms);
        assert!(!hold.lets_go(at(299)));
        assert!(hold.lets_go(at(300)) && !hold.lets_go(at(400)));
        assert!(hold.is_silent(at(400)));
        assert_eq!(hold.hear(at(500), &target(2, true)), Ok(true), "it grasps anew");
    }
}
