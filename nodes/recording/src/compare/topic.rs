//! Compares the messages of one topic.

use std::collections::VecDeque;

use super::golden::{Golden, Reasons, Waiting};
use super::judge::{Judge, Pair};
use super::kind::Kind;
use super::outcome::{Change, Counts, Divergence, Presence, TopicOutcome, Unpaired, Verdict};
use super::pairing::{Gap, LOOK_AHEAD, Pending};
use super::peek;
use super::signal::Bins;
use super::tolerance::Tolerance;
use crate::cdr::decode;
use crate::messages::{
    ContactLaw, ContactState, JointState, PoseStamped, SurfaceDisplacement, TwistStamped, WrenchStamped,
};

/// Messages without a counterpart that are listed.
const MOST_LISTED: usize = 100;

/// The comparison of one topic.
#[derive(Debug)]
pub(super) struct TopicComparison {
    pub(super) name: String,
    type_name: String,
    presence: Presence,
    /// Its place in [`Golden`].
    slot: usize,
    kind: Option<Kind>,
    judge: Option<Judge>,
    counts: Counts,
    pending: Pending,
    first: Option<Divergence>,
    missing: Leftover,
    extra: Leftover,
    signal: Bins,
    /// Why the topic cannot be judged.
    refused: Option<String>,
    /// Messages that cannot be judged.
    unreadable: Reasons,
}

/// Messages of one side without a counterpart.
#[derive(Debug, Default)]
struct Leftover {
    /// The first.
    listed: Vec<Unpaired>,
    /// The latest: their counterpart may still come.
    latest: VecDeque<Unpaired>,
}

/// What the golden recording says about a topic.
pub(super) struct Recorded {
    pub(super) type_name: String,
    pub(super) presence: Presence,
    /// Why it cannot be judged.
    pub(super) refused: Option<String>,
}

impl TopicComparison {
    pub(super) fn new(
        name: String,
        slot: usize,
        recorded: Recorded,
        tolerances: impl Fn(Kind) -> Vec<Tolerance>,
    ) -> Self {
        let Recorded { type_name, presence, refused } = recorded;
        let kind = Kind::of(&type_name);
        Self {
            name,
            type_name,
            presence,
            slot,
            kind,
            judge: kind.map(|kind| Judge::new(kind, tolerances(kind))),
            counts: Counts::default(),
            pending: Pending::default(),
            first: None,
            missing: Leftover::default(),
            extra: Leftover::default(),
            signal: Bins::default(),
            refused,
            unreadable: Reasons::default(),
        }
    }

    pub(super) fn kind(&self) -> Option<Kind> {
        self.kind
    }

    /// The next computed message.
    pub(super) fn take(&mut self, golden: &mut Golden<'_>, data: &[u8]) {
        let index = self.counts.computed;
        self.counts.computed += 1;
        if self.refused.is_some() {
            return;
        }
        if self.pending.is_empty()
            && let Some(front) = golden.ahead(self.slot, 1).front()
            && front.data == data
        {
            self.counts.paired += 1;
            self.draw(data, data);
            golden.pop(self.slot);
            return;
        }
        let Some(stamp_ns) = peek::stamp_ns(data) else {
            self.unreadable
                .add(|| format!("computed message #{index}: {} bytes without a stamp in CDR", data.len()));
            return;
        };
        self.pending.push(Waiting { index, stamp_ns, data: data.to_owned() });
        self.settle(golden, false);
    }

    /// Decides about as many messages as can be decided.
    fn settle(&mut self, golden: &mut Golden<'_>, ended: bool) {
        while let Some(computed) = self.pending.front() {
            let Some(front) = golden.ahead(self.slot, 1).front() else {
                self.extra_one();
                continue;
            };
            if front.stamp_ns == computed.stamp_ns {
                self.pair(golden, 1);
                continue;
            }
            match self.pending.gap(golden, self.slot, ended) {
                Gap::Wait => return,
                Gap::OtherStamps(count) => self.pair(golden, count),
                Gap::Unpaired { golden: missing, computed: extra } => {
                    (0..missing).for_each(|_| self.missing_one(golden));
                    (0..extra).for_each(|_| self.extra_one());
                }
            }
        }
    }

    fn pair(&mut self, golden: &mut Golden<'_>, count: usize) {
        self.pending.restart();
        for _ in 0..count {
            let (Some(golden), Some(computed)) = (golden.pop(self.slot), self.pending.pop()) else { return };
            self.counts.paired += 1;
            if golden.data != computed.data {
                self.compare(&golden, &computed);
            }
            self.draw(&golden.data, &computed.data);
        }
    }

    fn compare(&mut self, golden: &Waiting, computed: &Waiting) {
        let (Some(kind), Some(judge)) = (self.kind, &mut self.judge) else { return };
        let pair =
            Pair { golden_index: golden.index, computed_index: computed.index, stamp_ns: golden.stamp_ns };
        macro_rules! compare {
            ($type:ty) => {
                match (decode::<$type>(&golden.data), decode::<$type>(&computed.data)) {
                    (Ok(golden), Ok(computed)) => judge.compare(pair, &golden, &computed),
                    (Err(error), _) => Err(format!("golden: {error}")),
                    (_, Err(error)) => Err(format!("computed: {error}")),
                }
            };
        }
        let compared = match kind {
            Kind::Wrench => compare!(WrenchStamped),
            Kind::Contact => compare!(ContactState),
            Kind::Law => compare!(ContactLaw),
            Kind::Surface => compare!(SurfaceDisplacement),
            Kind::Pose => compare!(PoseStamped),
            Kind::Twist => compare!(TwistStamped),
            Kind::Joints => compare!(JointState),
        };
        match compared {
            Ok(None) => {}
            Ok(Some(divergence)) => {
                self.counts.differing += 1;
                self.first.get_or_insert(divergence);
            }
            Err(reason) => self.unreadable.add(|| {
                format!("golden message #{} and computed message #{}: {reason}", golden.index, computed.index)
            }),
        }
    }

    fn missing_one(&mut self, golden: &mut Golden<'_>) {
        self.pending.restart();
        let Some(message) = golden.pop(self.slot) else { return };
        self.draw(&message.data, &[]);
        let own = Unpaired { index: message.index, stamp_ns: message.stamp_ns };
        if let Some(computed) = self.extra.claim(own.stamp_ns) {
            self.counts.extra -= 1;
            self.reordered(own, computed);
            return;
        }
        self.counts.missing += 1;
        self.missing.add(own);
        let (golden_index, computed_index) = (Some(own.index), None);
        let change = Change::Missing;
        self.first.get_or_insert(Divergence { golden_index, computed_index, stamp_ns: own.stamp_ns, change });
    }

    fn extra_one(&mut self) {
        self.pending.restart();
        let Some(message) = self.pending.pop() else { return };
        self.draw(&[], &message.data);
        let own = Unpaired { index: message.index, stamp_ns: message.stamp_ns };
        if let Some(golden) = self.missing.claim(own.stamp_ns) {
            self.counts.missing -= 1;
            self.reordered(golden, own);
            return;
        }
        self.counts.extra += 1;
        self.extra.add(own);
        let (golden_index, computed_index) = (None, Some(own.index));
        let change = Change::Extra;
        self.first.get_or_insert(Divergence { golden_index, computed_index, stamp_ns: own.stamp_ns, change });
    }

    /// A message taken for missing or too many turns out to be at another place.
    fn reordered(&mut self, golden: Unpaired, computed: Unpaired) {
        self.counts.reordered += 1;
        let divergence = Divergence {
            golden_index: Some(golden.index),
            computed_index: Some(computed.index),
            stamp_ns: golden.stamp_ns,
            change: Change::Reordered,
        };
        let first = self.first.get_or_insert_with(|| divergence.clone());
        let is_this = match first.change {
            Change::Missing => first.golden_index == Some(golden.index),
            Change::Extra => first.computed_index == Some(computed.index),
            Change::Reordered | Change::Value(_) => false,
        };
        if is_this {
            *first = divergence;
        }
    }

    /// Draws a pair, or one message beside nothing.
    fn draw(&mut self, golden: &[u8], computed: &[u8]) {
        let Some(kind) = self.kind.filter(|kind| kind.drawn().is_some()) else { return };
        let own = peek::sample(kind, golden);
        let other = if std::ptr::eq(golden, computed) { own } else { peek::sample(kind, computed) };
        match (own, other) {
            (Some((stamp_ns, golden)), Some((other_ns, computed))) if stamp_ns == other_ns => {
                self.signal.add(stamp_ns, golden, computed);
            }
            (golden, computed) => {
                if let Some((stamp_ns, golden)) = golden {
                    self.signal.add(stamp_ns, golden, f64::NAN);
                }
                if let Some((stamp_ns, computed)) = computed {
                    self.signal.add(stamp_ns, f64::NAN, computed);
                }
            }
        }
    }

    /// After the last computed message.
    pub(super) fn finish(mut self, golden: &mut Golden<'_>) -> TopicOutcome {
        if self.refused.is_none() {
            self.settle(golden, true);
        }
        while !golden.ahead(self.slot, 1).is_empty() {
            if self.refused.is_some() {
                golden.pop(self.slot);
            } else {
                self.missing_one(golden);
            }
        }
        self.counts.golden = golden.seen(self.slot);
        let unreadable = self.unreadable.said("messages cannot be compared");
        let verdict = match self.refused.or_else(|| golden.unreadable(self.slot)).or(unreadable) {
            Some(reason) => Verdict::NotCompared(reason),
            None if self.counts.agree() && self.presence != Presence::GoldenOnly => Verdict::Same,
            None => Verdict::Different,
        };
        TopicOutcome {
            name: self.name,
            type_name: self.type_name,
            presence: self.presence,
            counts: self.counts,
            first: self.first,
            fields: self.judge.map(|judge| judge.finish(self.counts.paired)).unwrap_or_default(),
            missing: self.missing.listed,
            extra: self.extra.listed,
            signal: self.kind.and_then(Kind::drawn).map(|drawn| self.signal.finish(drawn)),
            verdict,
        }
    }
}

impl Leftover {
    fn add(&mut self, message: Unpaired) {
        if self.listed.len() < MOST_LISTED {
            self.listed.push(message);
        }
        if self.latest.len() == LOOK_AHEAD {
            self.latest.pop_front();
        }
        self.latest.push_back(message);
    }

    /// The first message of that stamp, which then is none without a counterpart.
    fn claim(&mut self, stamp_ns: i64) -> Option<Unpaired> {
        let place = self.latest.iter().position(|message| message.stamp_ns == stamp_ns)?;
        let message = self.latest.remove(place)?;
        self.listed.retain(|listed| *listed != message);
        Some(message)
    }
}
