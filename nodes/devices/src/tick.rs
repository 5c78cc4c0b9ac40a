//! One period of the motor loop: read, choose, check, command. Everything here is RT safe and knows no clock.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use glam::DVec3;

use crate::force_choice::{Commands, ForceOrigin, Moment};
use crate::{Device, DeviceError, DeviceState, Wrench};

/// What one period produced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time of the reading on the system's clock, ns since 1970; strictly rising.
    pub stamp_ns: i64,
    /// Time of the reading by [`monotonic_ns`](crate::monotonic_ns).
    pub monotonic_ns: u64,
    /// The handle.
    pub state: DeviceState,
    /// The force that the motors were given, device frame.
    pub force_n: DVec3,
    /// Where it came from.
    pub origin: ForceOrigin,
    /// How deep the probe is by the contact law, m, negative when the body is pulled; 0 without a law or a contact.
    pub depth_m: f64,
}

/// The largest force on the hand, shared with whoever may change it.
pub(crate) struct ForceLimit {
    bits: AtomicU64,
}

impl ForceLimit {
    /// A limit of `force_n` >= 0.
    pub(crate) fn new(force_n: f64) -> ForceLimit {
        ForceLimit { bits: AtomicU64::new(force_n.to_bits()) }
    }

    /// Changes it. From the next period on.
    pub(crate) fn set(&self, force_n: f64) {
        self.bits.store(force_n.to_bits(), Relaxed);
    }

    /// The limit, N. RT safe.
    pub(crate) fn get(&self) -> f64 {
        f64::from_bits(self.bits.load(Relaxed))
    }
}

macro_rules! counters {
    ($($(#[$doc:meta])* $name:ident),+ $(,)?) => {
        /// What the motor loop counts, shared with whoever reports it.
        #[derive(Debug, Default)]
        pub(crate) struct Counters { $($(#[$doc])* pub(crate) $name: AtomicU64,)+ }

        /// The counters at one moment.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Counts { $($(#[$doc])* pub $name: u64,)+ }

        impl Counters {
            /// The counters now.
            pub(crate) fn counts(&self) -> Counts {
                Counts { $($name: self.$name.load(Relaxed),)+ }
            }
        }
    };
}

counters! {
    /// Periods run.
    ticks,
    /// Periods that began more than half a period late.
    late_ticks,
    /// Periods left out because the loop was a whole period behind.
    skipped_ticks,
    /// The latest start of a period after its deadline, ns.
    latest_ns,
    /// Samples lost because the ring to the publisher was full.
    lost_samples,
    /// Device readings that were not finite; no force and no sample came of them.
    unusable_readings,
    /// Forces that were not finite; the motors got none instead.
    unusable_forces,
    /// Forces above the limit; the motors got the limit in the same direction.
    clamped_forces,
}

impl Counters {
    pub(crate) fn add(counter: &AtomicU64, count: u64) {
        counter.fetch_add(count, Relaxed);
    }
}

/// A device with its commands. Dropping it takes the force away, on every path, a panic included.
pub(crate) struct Ticker {
    device: Box<dyn Device>,
    commands: Commands,
    limit: Arc<ForceLimit>,
    counters: Arc<Counters>,
}

impl Ticker {
    /// Ready for the first period. The force is clamped to the smaller of `limit` and the device's own.
    pub(crate) fn new(
        device: Box<dyn Device>,
        commands: Commands,
        limit: Arc<ForceLimit>,
        counters: Arc<Counters>,
    ) -> Ticker {
        Ticker { device, commands, limit, counters }
    }

    /// One period: reads the device, chooses the force, gives it to the motors. None when the reading was not finite:
    /// the motors then have no force. RT safe.
    ///
    /// # Errors
    /// What the device says. The caller stops then; dropping the ticker takes the force away.
    pub(crate) fn tick(&mut self, now: Moment) -> Result<Option<Sample>, DeviceError> {
        Counters::add(&self.counters.ticks, 1);
        let state = self.device.read()?;
        if !state.is_finite() {
            Counters::add(&self.counters.unusable_readings, 1);
            self.device.command(&Wrench::ZERO)?;
            return Ok(None);
        }
        let choice = self.commands.choose(state.pose.translation, now);
        let force_n = self.safe_force_n(choice.force_n);
        self.device.command(&Wrench::of_force(force_n))?;
        Ok(Some(Sample {
            stamp_ns: now.stamp_ns,
            monotonic_ns: now.monotonic_ns,
            state,
            force_n,
            origin: choice.origin,
            depth_m: choice.depth_m,
        }))
    }

    /// Takes the force away.
    ///
    /// # Errors
    /// What the device says.
    pub(crate) fn off(&mut self) -> Result<(), DeviceError> {
        let commanded = self.device.command(&Wrench::ZERO);
        self.device.disable().and(commanded)
    }

    /// Finite, and no larger than both limits, direction kept.
    fn safe_force_n(&self, force_n: DVec3) -> DVec3 {
        if !force_n.is_finite() {
            Counters::add(&self.counters.unusable_forces, 1);
            return DVec3::ZERO;
        }
        // A limit that is not a number is no permission (and min would pass over it).
        let user_n = self.limit.get();
        let limit_n = if user_n > 0.0 {
            user_n.min(self.device.description().limits.max_force_n.unwrap_or(0.0))
        } else {
            0.0
        };
        // By the largest component first, so that the square of a huge force does not overflow.
        let largest_n = force_n.abs().max_element();
        let size = if largest_n > 0.0 { largest_n * (force_n / largest_n).length() } else { 0.0 };
        if size <= limit_n {
            return force_n;
        }
        Counters::add(&self.counters.clamped_forces, 1);
        let direction = (force_n / largest_n).normalize_or_zero();
        // The direction's length may exceed 1 by rounding; the limit must not.
        direction * (limit_n * (1.0 - 4.0 * f64::EPSILON))
    }
}

impl Drop for Ticker {
    fn drop(&mut self) {
        // There is nobody left to tell; the loop reports what `off` said when it ends by itself.
        let _ = self.off();
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::latest::{Sender, latest};
    use crate::{Description, DeviceLimits, ForceSource, ServoCommand, Workspace};
    use glam::DQuat;
    use proptest::prelude::*;
    use rhombus_chain::Pose;
    use std::sync::Mutex;

    /// A sample that says nothing but its stamp.
    pub(crate) fn sample(stamp_ns: i64) -> Sample {
        Sample {
            stamp_ns,
            monotonic_ns: 0,
            state: still(DVec3::ZERO),
            force_n: DVec3::ZERO,
            origin: ForceOrigin::Nobody,
            depth_m: 0.0,
        }
    }

    fn still(translation: DVec3) -> DeviceState {
        DeviceState::at_rest(Pose { translation, rotation: DQuat::IDENTITY })
    }

    /// Writes down every force that reached its motors; `None` is "disabled".
    struct Recorder {
        description: Description,
        at: DVec3,
        motors: Arc<Mutex<Vec<Option<DVec3>>>>,
    }

    impl Device for Recorder {
        fn description(&self) -> &Description {
            &self.description
        }
        fn read(&mut self) -> Result<DeviceState, DeviceError> {
            Ok(still(self.at))
        }
        fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
            self.motors.lock().unwrap().push(Some(wrench.force_n));
            Ok(())
        }
        fn enable(&mut self) -> Result<(), DeviceError> {
            Ok(())
        }
        fn disable(&mut self) -> Result<(), DeviceError> {
            self.motors.lock().unwrap().push(None);
            Ok(())
        }
    }

    fn description() -> Description {
        Description {
            backend: "recorder",
            model: String::new(),
            serial: String::new(),
            firmware: String::new(),
            limits: DeviceLimits {
                max_force_n: Some(20.0),
                max_torque_n_m: None,
                max_gripper_force_n: None,
                workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.1 },
            },
            buttons: Vec::new(),
            joints: Vec::new(),
            has_gripper: false,
            needs_homing: false,
            watchdog: None,
            status_names: &[],
        }
    }

    struct Bench {
        ticker: Ticker,
        servo: Sender<ServoCommand>,
        limit: Arc<ForceLimit>,
        counters: Arc<Counters>,
        motors: Arc<Mutex<Vec<Option<DVec3>>>>,
    }

    fn bench(at: DVec3) -> Bench {
        let ((_, laws), (servo_sender, servo)) = (latest(), latest());
        let motors = Arc::new(Mutex::new(Vec::new()));
        let (limit, counters) = (Arc::new(ForceLimit::new(5.0)), Arc::new(Counters::default()));
        let device = Box::new(Recorder { description: description(), at, motors: motors.clone() });
        let commands = Commands { source: ForceSource::ServoForce, laws, servo };
        let ticker = Ticker::new(device, commands, limit.clone(), counters.clone());
        Bench { ticker, servo: servo_sender, limit, counters, motors }
    }

    impl Bench {
        /// What reaches the motors when `force_n` is commanded.
        fn motors_get(&mut self, force_n: DVec3) -> DVec3 {
            self.servo.send(ServoCommand { received_ns: 0, force_n });
            let sample = self.ticker.tick(Moment { monotonic_ns: 0, stamp_ns: 0 }).unwrap().unwrap();
            let commanded = self.motors.lock().unwrap().last().copied().flatten().unwrap();
            assert_eq!(sample.force_n, commanded);
            commanded
        }
    }

    #[test]
    fn a_force_within_the_limit_reaches_the_motors_unchanged() {
        let mut bench = bench(DVec3::ZERO);
        let force_n = DVec3::new(3.0, -4.0, 0.0);
        assert_eq!(bench.motors_get(force_n), force_n);
        assert_eq!(bench.counters.counts().clamped_forces, 0);
    }

    #[test]
    fn a_lower_limit_holds_from_the_next_period_and_a_higher_one_than_the_devices_does_not() {
        let mut bench = bench(DVec3::ZERO);
        let force_n = DVec3::new(0.0, 0.0, 100.0);
        assert!((bench.motors_get(force_n).z - 5.0).abs() < 1e-12);
        bench.limit.set(2.0);
        assert!((bench.motors_get(force_n).z - 2.0).abs() < 1e-12);
        bench.limit.set(1e6);
        assert!((bench.motors_get(force_n).z - 20.0).abs() < 1e-12);
        for no_limit in [f64::NAN, -1.0, 0.0] {
            bench.limit.set(no_limit);
            assert_eq!(bench.motors_get(force_n), DVec3::ZERO);
        }
    }

    #[test]
    fn a_force_that_is_not_finite_is_none_and_counted() {
        let mut bench = bench(DVec3::ZERO);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(bench.motors_get(DVec3::new(1.0, bad, 0.0)), DVec3::ZERO);
        }
        assert_eq!(bench.counters.counts().unusable_forces, 3);
    }

    #[test]
    fn a_reading_that_is_not_finite_gives_no_force_and_no_sample() {
        let mut bench = bench(DVec3::new(f64::NAN, 0.0, 0.0));
        bench.servo.send(ServoCommand { received_ns: 0, force_n: DVec3::X });
        assert_eq!(bench.ticker.tick(Moment { monotonic_ns: 0, stamp_ns: 0 }), Ok(None));
        assert_eq!(*bench.motors.lock().unwrap(), [Some(DVec3::ZERO)]);
        assert_eq!(bench.counters.counts().unusable_readings, 1);
    }

    #[test]
    fn a_ticker_that_is_dropped_takes_the_force_away() {
        let mut bench = bench(DVec3::ZERO);
        bench.motors_get(DVec3::X);
        let motors = bench.motors.clone();
        drop(bench);
        assert_eq!(*motors.lock().unwrap(), [Some(DVec3::X), Some(DVec3::ZERO), None]);
    }

    proptest! {
        #[test]
        fn no_command_however_large_exceeds_the_limit_or_turns_the_force(
            x in any::<f64>(), y in any::<f64>(), z in any::<f64>(), limit_n in 0.0..30.0f64,
        ) {
            let mut bench = bench(DVec3::ZERO);
            bench.limit.set(limit_n);
            let wanted = DVec3::new(x, y, z);
            let got = bench.motors_get(wanted);
            prop_assert!(got.is_finite());
            prop_assert!(got.length() <= limit_n.min(20.0));
            if wanted.is_finite() && got != DVec3::ZERO {
                let unit = wanted / wanted.abs().max_element();
                prop_assert!(got.cross(unit).length() <= 1e-12 * got.length() * unit.length());
                prop_assert!(got.dot(unit) > 0.0);
            }
        }
    }
}
