//! A handle in one dimension, driven by forces that are sampled, held and late: stepped exactly, whatever the stiffness.

use std::collections::VecDeque;

use glam::DVec3;
use rhombus_chain::{ContactLaw, LocalLaw, Mode};

/// The moving parts of a device, with nobody holding on: the least damped case.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Handle {
    pub(crate) mass_kg: f64,
    /// To ground, > 0.
    pub(crate) damping_n_s_per_m: f64,
}

/// Which way the force takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Route {
    /// Computed from a sampled position, in force `delay_s` later and then held until the next one.
    Topics,
    /// Computed by the motor loop at each period, from the position of that period and a contact law (anchor and normal)
    /// that is `delay_s` old, and held until the next period.
    LocalLaw,
}

/// The loop around a handle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loop {
    pub(crate) handle: Handle,
    pub(crate) rate_hz: f64,
    pub(crate) delay_s: f64,
    pub(crate) route: Route,
}

/// What is touched: a flat body, with a hand that holds the balance at one depth.
pub(crate) struct Touch<'a> {
    pub(crate) law: &'a ContactLaw,
    /// The law's force is multiplied by this.
    pub(crate) factor: f64,
    /// Depth of the balance, m, negative when pulled.
    pub(crate) depth_m: f64,
}

/// Motion under a constant force for a fixed time: with `e = b h / m`,
///
/// ```text
/// v' = v exp(-e) + f/m h phi_1(e),    x' = x + v h phi_1(e) + f/m h^2 phi_2(e)
/// phi_1 = (1 - exp(-e))/e,            phi_2 = (1 - phi_1)/e
/// ```
#[derive(Clone, Copy)]
struct Step {
    velocity_kept: f64,
    velocity_per_n: f64,
    way_per_velocity: f64,
    way_per_n: f64,
}

impl Step {
    fn new(handle: Handle, time_s: f64) -> Step {
        let decay = handle.damping_n_s_per_m * time_s / handle.mass_kg;
        let (phi_1, phi_2) = if decay < 1e-4 {
            (1.0 - decay / 2.0 + decay * decay / 6.0, 0.5 - decay / 6.0 + decay * decay / 24.0)
        } else {
            let phi_1 = -libm::expm1(-decay) / decay;
            (phi_1, (1.0 - phi_1) / decay)
        };
        Step {
            velocity_kept: libm::exp(-decay),
            velocity_per_n: time_s / handle.mass_kg * phi_1,
            way_per_velocity: time_s * phi_1,
            way_per_n: time_s * time_s / handle.mass_kg * phi_2,
        }
    }

    fn take(&self, (x, v): (f64, f64), force_n: f64) -> (f64, f64) {
        (
            x + v * self.way_per_velocity + force_n * self.way_per_n,
            v * self.velocity_kept + force_n * self.velocity_per_n,
        )
    }
}

/// The heights over the balance at the samples, from a start `height_m` above it at rest. Ends early, and says so with an
/// infinite height, when the handle has gone a thousand times as far.
pub(crate) fn motion(around: &Loop, touch: &Touch, height_m: f64, samples: usize, mut seen: impl FnMut(f64)) {
    let period_s = 1.0 / around.rate_hz;
    // The topics' force changes within a period, where the delay is no whole number of them.
    let (whole, rest_s) = match around.route {
        Route::LocalLaw => ((around.delay_s / period_s).ceil(), 0.0),
        Route::Topics => {
            // A delay of whole periods is one in spite of its rounding.
            let whole = (around.delay_s / period_s + 1e-9).floor();
            (whole, (around.delay_s - whole * period_s).max(0.0))
        }
    };
    let whole = whole as usize;
    let late = (rest_s > 1e-9 * period_s).then(|| Step::new(around.handle, rest_s));
    let step = Step::new(around.handle, if late.is_some() { period_s - rest_s } else { period_s });

    let plane = |depth_m: f64| LocalLaw {
        mode: if touch.depth_m > 0.0 { Mode::Contact } else { Mode::Grasp },
        // As the model makes it: under the probe, at the surface.
        anchor: DVec3::new(0.0, 0.0, -depth_m) + DVec3::Z * depth_m,
        normal: DVec3::Z,
        stiffness_factor: touch.factor,
        ..LocalLaw::default()
    };
    let force_n = |law: &LocalLaw, depth_m: f64| law.force_n(touch.law, DVec3::new(0.0, 0.0, -depth_m)).z;
    let hand_n = -force_n(&plane(touch.depth_m), touch.depth_m);

    let mut state = (height_m, 0.0);
    // Before the start it stood there for ever.
    let start_m = touch.depth_m - height_m;
    let mut forces: VecDeque<f64> =
        std::iter::repeat_n(force_n(&plane(start_m), start_m), whole + 1).collect();
    let mut laws: VecDeque<LocalLaw> = std::iter::repeat_n(plane(start_m), whole + 1).collect();
    for _ in 0..samples {
        seen(state.0);
        if state.0.abs() > 1e3 * height_m.abs() {
            seen(f64::INFINITY);
            return;
        }
        let depth_m = touch.depth_m - state.0;
        match around.route {
            Route::Topics => {
                forces.push_back(force_n(&plane(depth_m), depth_m));
                // In force at the start of this period, and after what is left of the delay.
                let (older, newer) = (forces[0], forces[1]);
                if let Some(late) = late {
                    state = late.take(state, older + hand_n);
                }
                state = step.take(state, newer + hand_n);
                forces.pop_front();
            }
            Route::LocalLaw => {
                laws.push_back(plane(depth_m));
                laws.pop_front();
                state = step.take(state, force_n(&laws[0], depth_m) + hand_n);
            }
        }
    }
}

/// How much more the handle moves late than early: below 1 it comes to rest, above 1 it never does. The mean square
/// over the last quarter of the time, divided by that over the second.
pub(crate) fn growth(around: &Loop, touch: &Touch, height_m: f64, samples: usize) -> f64 {
    let quarter = samples / 4;
    let (mut count, mut early, mut late) = (0, 0.0, 0.0);
    motion(around, touch, height_m, samples, |height| {
        let square = (height / height_m) * (height / height_m);
        if (quarter..2 * quarter).contains(&count) {
            early += square;
        } else if count >= 3 * quarter {
            late += square;
        } else if square.is_infinite() {
            late = f64::INFINITY;
        }
        count += 1;
    });
    if late.is_infinite() || early.is_infinite() {
        f64::INFINITY
    } else {
        late / early.max(f64::MIN_POSITIVE)
    }
}

/// The stiffness at which a loop stops coming to rest, N/m, to about half a percent; `stiffness_n_per_m`: of the law at
/// the balance, with a factor of 1. Bisection on the factor, from `from_n_per_m`, where it must come to rest.
pub(crate) fn largest_stable_stiffness(
    around: &Loop,
    law: &ContactLaw,
    depth_m: f64,
    from_n_per_m: f64,
) -> Option<f64> {
    let tangent = law.at_depth(depth_m).ok()?.stiffness_n_per_m;
    let height_m = 1e-5 * depth_m.abs().max(1e-6);
    let grows = |stiffness: f64| {
        let touch = Touch { law, factor: stiffness / tangent, depth_m };
        growth(around, &touch, height_m, samples_for(around, stiffness)) > 1.0
    };
    let mut low = from_n_per_m;
    for _ in 0..20 {
        if !grows(low) {
            break;
        }
        low *= 0.5;
    }
    let mut high = 2.0 * low;
    for _ in 0..60 {
        if grows(high) {
            break;
        }
        (low, high) = (high, 2.0 * high);
    }
    if grows(low) || !grows(high) {
        return None;
    }
    for _ in 0..10 {
        let middle = (low * high).sqrt();
        if grows(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some((low * high).sqrt())
}

/// Long enough to tell a stiffness from one 0.2 % above. That much changes the decay by `0.001 b/m`; the windows cut
/// their last oscillation anywhere, which stands for an error of `4/(omega t)`.
fn samples_for(around: &Loop, stiffness_n_per_m: f64) -> usize {
    let Handle { mass_kg, damping_n_s_per_m } = around.handle;
    let omega = (stiffness_n_per_m / mass_kg).sqrt();
    let time_s = 2.0 * (8.0 * mass_kg / (0.002 * damping_n_s_per_m * omega)).sqrt();
    let slowest_s = 200.0 / omega;
    ((time_s.max(slowest_s) * around.rate_hz) as usize).clamp(2000, 400_000)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rhombus_chain::stability::{Demand, HapticLoop, Reach};
    use rhombus_chain::{ChainParameters, Formulation};

    const HANDLE: Handle = Handle { mass_kg: 0.3, damping_n_s_per_m: 2.0 };

    fn chain(tangential_stiffness_n_per_m: f64) -> ChainParameters {
        ChainParameters {
            rod_length_m: 0.01,
            angle_rad: 0.6,
            ratio: 0.8,
            units: 12,
            normal_stiffness_n_per_m: 500.0,
            tangential_stiffness_n_per_m,
            tangential_growth: 10.0,
            weight: 1.0,
            pitch_m: 0.016,
        }
    }

    /// A straight law, the energy law, the printed law: with the depth at which each is stiffest.
    fn laws() -> [(ContactLaw, f64); 3] {
        [(Formulation::Energy, 0.0), (Formulation::Energy, 40.0), (Formulation::Published, 100.0)].map(
            |(formulation, tangential)| {
                let law = ContactLaw::new(formulation, &[chain(tangential)]).unwrap();
                let demand = Demand::of_law(&law, Reach::ENDLESS);
                let depth_m = if tangential == 0.0 { -0.005 } else { demand.depth_m };
                (law, depth_m)
            },
        )
    }

    fn around(delay_s: f64, route: Route) -> Loop {
        Loop { handle: HANDLE, rate_hz: 1000.0, delay_s, route }
    }

    fn bound(around: &Loop) -> f64 {
        let delay_s = if around.route == Route::Topics { around.delay_s } else { 0.0 };
        HapticLoop {
            rate_hz: around.rate_hz,
            delay_s,
            damping_n_s_per_m: None,
            rendered_damping_n_s_per_m: 0.0,
        }
        .largest_passive_stiffness_n_per_m(around.handle.damping_n_s_per_m)
    }

    fn limit(around: &Loop, law: &ContactLaw, depth_m: f64) -> f64 {
        largest_stable_stiffness(around, law, depth_m, bound(around)).unwrap()
    }

    #[test]
    fn without_delay_the_limit_of_a_spring_is_where_theory_has_it() {
        // z^2 - (1 + a) z + a + K/b (c_1 z + c_0), a = exp(-bT/m): on the unit circle when a + K c_0 / b = 1.
        let (law, depth_m) = &laws()[0];
        let around = around(0.0, Route::Topics);
        let Handle { mass_kg, damping_n_s_per_m: b } = HANDLE;
        let (t, decay_s) = (1e-3, mass_kg / b);
        let a = libm::exp(-t / decay_s);
        let c_0 = decay_s * (1.0 - a) - a * t;
        let theory = b * (1.0 - a) / c_0;
        let found = limit(&around, law, *depth_m);
        assert!((found - theory).abs() < 0.01 * theory, "{found}, theory {theory}");
    }

    #[test]
    fn just_below_the_limit_the_motion_dies_away_and_just_above_it_grows() {
        for (law, depth_m) in laws() {
            for (delay_s, route) in [(0.0, Route::Topics), (0.0026, Route::Topics), (0.01, Route::LocalLaw)] {
                let around = around(delay_s, route);
                let limit = limit(&around, &law, depth_m);
                let tangent = law.at_depth(depth_m).unwrap().stiffness_n_per_m;
                let swing = |share: f64| {
                    let touch = Touch { law: &law, factor: share * limit / tangent, depth_m };
                    let mut swing: f64 = 0.0;
                    let mut count = 0;
                    motion(&around, &touch, 1e-7, 30_000, |height| {
                        count += 1;
                        if count > 20_000 || height.is_infinite() {
                            swing = swing.max(height.abs());
                        }
                    });
                    swing
                };
                assert!(swing(0.9) < 0.1e-7, "{delay_s} {route:?}: {}", swing(0.9));
                assert!(swing(1.1) > 10e-7, "{delay_s} {route:?}: {}", swing(1.1));
            }
        }
    }

    #[test]
    fn more_delay_never_raises_the_limit_through_topics_and_changes_nothing_through_the_local_law() {
        for (law, depth_m) in laws() {
            let limits = |route| {
                [0.0, 0.0004, 0.001, 0.003, 0.01, 0.02]
                    .map(|delay_s| limit(&around(delay_s, route), &law, depth_m))
            };
            let topics = limits(Route::Topics);
            assert!(topics.windows(2).all(|pair| pair[1] < pair[0]), "{topics:?}");
            let local = limits(Route::LocalLaw);
            assert!(local.iter().all(|limit| *limit == local[0]), "{local:?}");
        }
    }

    #[test]
    fn the_bound_is_below_what_the_simulation_finds_and_not_far_below_it() {
        for (law, depth_m) in laws() {
            for delay_s in [0.0, 0.001, 0.005, 0.02] {
                let around = around(delay_s, Route::Topics);
                let (bound, limit) = (bound(&around), limit(&around, &law, depth_m));
                assert!(
                    bound < 1.005 * limit && limit < 2.0 * bound,
                    "{delay_s}: bound {bound}, limit {limit}"
                );
            }
        }
    }

    #[test]
    fn a_handle_that_is_pushed_by_nobody_coasts_as_far_as_its_damping_lets_it() {
        let step = Step::new(HANDLE, 0.01);
        let mut state = (0.0, 1.0);
        for _ in 0..10_000 {
            state = step.take(state, 0.0);
        }
        // m v / b.
        assert!((state.0 - 0.15).abs() < 1e-12, "{state:?}");
        let pushed = (0..10_000).fold((0.0, 0.0), |state, _| step.take(state, 3.0));
        assert!((pushed.1 - 1.5).abs() < 1e-12, "f/b: {pushed:?}");
    }
}
