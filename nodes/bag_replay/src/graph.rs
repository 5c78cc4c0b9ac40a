//! What publishers offer, in r2r's words and in those of a recording, and what to ask of them.

use std::time::Duration;

use r2r::QosProfile;
use r2r::qos::{DurabilityPolicy, HistoryPolicy, LivelinessPolicy, ReliabilityPolicy};
use recording::{Durability, History, Liveliness, Qos, QosTime, Reliability};

/// Messages of a topic that rcl keeps for a recorder that is held up: ten seconds at 1 kHz. Memory is taken for those that
/// really wait.
const RECORDER_DEPTH: usize = 10_000;
/// Messages of a topic that a replay keeps for subscribers that missed them: a second at 1 kHz.
const REPLAY_DEPTH: usize = 1000;

/// What a recorder asks of publishers: the most that all of them can give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Request {
    pub(crate) reliable: bool,
    pub(crate) transient_local: bool,
}

impl Request {
    /// That matches every one of these offers: a publisher serves requests up to what it offers and ignores greater ones.
    pub(crate) fn matching<'a>(offers: impl IntoIterator<Item = &'a QosProfile> + Clone) -> Self {
        Self {
            reliable: offers
                .clone()
                .into_iter()
                .all(|offer| offer.reliability == ReliabilityPolicy::Reliable),
            transient_local: offers
                .into_iter()
                .all(|offer| offer.durability == DurabilityPolicy::TransientLocal),
        }
    }

    /// The most that both allow.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            reliable: self.reliable && other.reliable,
            transient_local: self.transient_local && other.transient_local,
        }
    }

    /// What a publisher whose message arrived offers at least, where nothing else is known of it.
    pub(crate) fn granted(self) -> QosProfile {
        QosProfile { history: HistoryPolicy::Unknown, depth: 0, ..self.profile() }
    }

    /// As a subscription needs it.
    pub(crate) fn profile(self) -> QosProfile {
        let profile = QosProfile::default().keep_last(RECORDER_DEPTH);
        let profile = if self.reliable { profile.reliable() } else { profile.best_effort() };
        if self.transient_local { profile.transient_local() } else { profile.volatile() }
    }
}

/// An offer as a recording keeps it.
pub(crate) fn recorded(offer: &QosProfile) -> Qos {
    let time = |duration: Duration| QosTime { sec: duration.as_secs(), nsec: duration.subsec_nanos().into() };
    Qos {
        history: match offer.history {
            HistoryPolicy::SystemDefault => History::SystemDefault,
            HistoryPolicy::KeepLast => History::KeepLast,
            HistoryPolicy::KeepAll => History::KeepAll,
            _ => History::Unknown,
        },
        depth: offer.depth as u64,
        reliability: match offer.reliability {
            ReliabilityPolicy::SystemDefault => Reliability::SystemDefault,
            ReliabilityPolicy::Reliable => Reliability::Reliable,
            ReliabilityPolicy::BestEffort => Reliability::BestEffort,
            _ => Reliability::Unknown,
        },
        durability: match offer.durability {
            DurabilityPolicy::SystemDefault => Durability::SystemDefault,
            DurabilityPolicy::TransientLocal => Durability::TransientLocal,
            DurabilityPolicy::Volatile => Durability::Volatile,
            _ => Durability::Unknown,
        },
        deadline: time(offer.deadline),
        lifespan: time(offer.lifespan),
        liveliness: match offer.liveliness {
            LivelinessPolicy::SystemDefault => Liveliness::SystemDefault,
            LivelinessPolicy::Automatic => Liveliness::Automatic,
            LivelinessPolicy::ManualByTopic => Liveliness::ManualByTopic,
            _ => Liveliness::Unknown,
        },
        liveliness_lease_duration: time(offer.liveliness_lease_duration),
        avoid_ros_namespace_conventions: offer.avoid_ros_namespace_conventions,
    }
}

/// Whether late subscribers got what had been published before.
pub(crate) fn is_latched(offers: &[Qos]) -> bool {
    offers.iter().any(|offer| offer.durability == Durability::TransientLocal)
}

/// Whether lost messages were sent again. A topic whose QoS is not known was, as is ROS's default.
pub(crate) fn is_reliable(offers: &[Qos]) -> bool {
    offers.is_empty() || offers.iter().any(|offer| offer.reliability != Reliability::BestEffort)
}

/// What a replay offers in place of the recorded publishers: the greatest of their offers, so that whoever heard one of
/// them hears the replay. How much a publisher kept is not known to recorders, so a second at 1 kHz is kept.
pub(crate) fn replayed(offers: &[Qos]) -> QosProfile {
    let profile = QosProfile::default().keep_last(REPLAY_DEPTH);
    let profile = if is_reliable(offers) { profile.reliable() } else { profile.best_effort() };
    let profile = if is_latched(offers) { profile.transient_local() } else { profile.volatile() };
    let shortest = |time: fn(&Qos) -> QosTime| {
        let set =
            offers.iter().map(time).filter(|time| *time != QosTime::default() && *time != QosTime::INFINITE);
        set.map(|time| Duration::from_secs(time.sec).saturating_add(Duration::from_nanos(time.nsec))).min()
    };
    // Not set is how DDS says "infinite" here.
    let profile = profile.deadline(shortest(|offer| offer.deadline).unwrap_or(Duration::ZERO));
    profile.lifespan(shortest(|offer| offer.lifespan).unwrap_or(Duration::ZERO))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offer(reliable: bool, transient_local: bool) -> QosProfile {
        Request { reliable, transient_local }.profile()
    }

    #[test]
    fn a_recorder_asks_for_no_more_than_the_weakest_publisher_offers() {
        let both = Request { reliable: true, transient_local: true };
        assert_eq!(Request::matching(&[offer(true, true), offer(true, true)]), both);
        let weaker = Request::matching(&[offer(true, true), offer(false, false)]);
        assert_eq!(weaker, Request { reliable: false, transient_local: false });
        assert_eq!(
            both.and(Request::matching(&[offer(true, false)])),
            Request { reliable: true, transient_local: false }
        );
    }

    #[test]
    fn a_publisher_that_was_heard_before_the_graph_knew_it_is_recorded_with_what_it_must_offer() {
        let latched = recorded(&Request { reliable: true, transient_local: true }.granted());
        assert!(is_reliable(std::slice::from_ref(&latched)) && is_latched(std::slice::from_ref(&latched)));
        assert_eq!((latched.history, latched.depth), (History::Unknown, 0), "how much it keeps is not known");
        let weak = recorded(&Request { reliable: false, transient_local: false }.granted());
        assert!(!is_reliable(std::slice::from_ref(&weak)) && !is_latched(&[weak]));
    }

    #[test]
    fn a_replay_offers_what_the_strongest_publisher_offered() {
        let offers = [recorded(&offer(false, true)), recorded(&offer(true, false))];
        let replayed = replayed(&offers);
        assert_eq!(replayed.reliability, ReliabilityPolicy::Reliable);
        assert_eq!(replayed.durability, DurabilityPolicy::TransientLocal);
        let weak = super::replayed(&offers[..1]);
        assert_eq!(weak.reliability, ReliabilityPolicy::BestEffort);
    }

    #[test]
    fn an_endless_deadline_is_offered_as_none_and_a_short_one_is_kept() {
        let endless = Qos { deadline: QosTime::INFINITE, ..Qos::default() };
        let short = Qos { deadline: QosTime { sec: 0, nsec: 5_000_000 }, ..Qos::default() };
        assert_eq!(replayed(&[endless]).deadline, Duration::ZERO);
        assert_eq!(replayed(&[endless, short]).deadline, Duration::from_millis(5));
    }
}
