//! What time it is in a session of several devices, by the stamps of their poses.

/// A device counts until the others have gone on for so long without it, ns of stamps.
const SILENCE_NS: i64 = 500_000_000;

/// The newest stamp of all devices that are at work. Their clocks and delays differ: taken as they come, the stamps of
/// two devices would jump back and forth.
#[derive(Clone, Debug)]
pub struct SessionTime {
    devices: Vec<Clock>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Clock {
    newest_ns: Option<i64>,
    /// How far the other devices have gone on since.
    silent_ns: i64,
}

impl SessionTime {
    /// Nobody has said anything yet.
    #[must_use]
    pub fn new(devices: usize) -> SessionTime {
        SessionTime { devices: vec![Clock::default(); devices] }
    }

    /// A device's newest stamp. One that goes back takes the session's time back when no other device is ahead.
    pub fn hear(&mut self, device: usize, stamp_ns: i64) {
        let Some(clock) = self.devices.get_mut(device) else { return };
        let before_ns = clock.newest_ns.unwrap_or(stamp_ns);
        *clock = Clock { newest_ns: Some(stamp_ns), silent_ns: 0 };
        let step_ns = stamp_ns.saturating_sub(before_ns).max(0);
        for (_, other) in self.devices.iter_mut().enumerate().filter(|(index, _)| *index != device) {
            other.silent_ns = other.silent_ns.saturating_add(step_ns);
            if other.silent_ns > SILENCE_NS {
                other.newest_ns = None;
            }
        }
    }

    /// The newest stamp of the devices at work; none before the first pose.
    #[must_use]
    pub fn now_ns(&self) -> Option<i64> {
        self.devices.iter().filter_map(|clock| clock.newest_ns).max()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StampRate;

    const MS: i64 = 1_000_000;

    #[test]
    fn two_devices_whose_stamps_differ_give_the_rate_of_one() {
        for ahead_ms in [0, 3, 50, 100_000] {
            let mut time = SessionTime::new(2);
            let mut rate = StampRate::new(60.0).unwrap();
            let mut due = 0;
            for ms in 0..10_000 {
                for (device, stamp_ns) in [(0, ms * MS), (1, (ms + ahead_ms) * MS)] {
                    time.hear(device, stamp_ns);
                    due += usize::from(rate.is_due(time.now_ns().unwrap()));
                }
            }
            assert!((600..=602).contains(&due), "{due} with one {ahead_ms} ms ahead");
        }
    }

    #[test]
    fn a_device_that_falls_silent_does_not_hold_the_time() {
        let mut time = SessionTime::new(2);
        assert_eq!(time.now_ns(), None);
        time.hear(1, 1_000_000 * MS);
        for ms in 0..=500 {
            time.hear(0, ms * MS);
            assert_eq!(time.now_ns(), Some(1_000_000 * MS));
        }
        time.hear(0, 501 * MS);
        assert_eq!(time.now_ns(), Some(501 * MS));
        time.hear(1, 1_000_001 * MS);
        assert_eq!(time.now_ns(), Some(1_000_001 * MS), "it is back");
    }

    #[test]
    fn a_device_alone_may_go_back_in_time() {
        let mut time = SessionTime::new(1);
        time.hear(0, 900 * MS);
        time.hear(0, 5 * MS);
        assert_eq!(time.now_ns(), Some(5 * MS));
    }
}
