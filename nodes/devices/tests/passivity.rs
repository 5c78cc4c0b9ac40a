//! Time-domain passivity against a stiff virtual wall that answers late: a simulated hand presses and lets go for a
//! minute. Energy is summed from true positions and commanded forces, whatever the device reports.

mod safety_support;

use devices::simulated::HandSettings;
use safety_support::{Record, Wall};

/// The most that the hand may ever have been given more than it has put in.
const LARGEST_J: f64 = 1e-3;

fn largest_j(records: &[Record]) -> f64 {
    records.iter().map(|r| r.given_j).fold(f64::MIN, f64::max)
}

fn end_j(records: &[Record]) -> f64 {
    records.last().map_or(0.0, |r| r.given_j)
}

/// Root mean square of what is applied less than wanted in contact after the engage ramp, as a share of the wanted force.
fn missing_share(records: &[Record]) -> f64 {
    let contact = || records.iter().skip(3000).filter(|r| r.wanted_n.z > 0.0);
    let missing: f64 = contact().map(|r| (r.wanted_n - r.applied_n).length_squared()).sum();
    let wanted: f64 = contact().map(|r| r.wanted_n.length_squared()).sum();
    (missing / wanted).sqrt()
}

#[test]
fn a_stiff_wall_that_answers_late_gives_no_energy_with_the_controller_and_ever_more_without() {
    let wall = Wall::default(); // 5000 N/m, 20 ms, 1 kHz
    let with = wall.run(60.0);
    let without = Wall { passivity: false, ..wall }.run(60.0);
    println!(
        "net energy out over 60 s, 5000 N/m, 20 ms late: with the controller {:.3} mJ at most, {:.3} mJ in the end; \
         without {:.0} mJ",
        1e3 * largest_j(&with),
        1e3 * end_j(&with),
        1e3 * end_j(&without)
    );
    assert!(largest_j(&with) <= LARGEST_J, "{}", largest_j(&with));
    assert!(with.iter().all(|r| !r.faulted));
    // Without: more in each quarter of the time.
    let quarters: Vec<f64> =
        (1..=4).map(|quarter| without[quarter * without.len() / 4 - 1].given_j).collect();
    assert!(quarters[0] > 1.0, "{quarters:?}");
    assert!(quarters.windows(2).all(|pair| pair[1] > pair[0] + 1.0), "{quarters:?}");
    // And it is still a wall: the hand feels a force.
    assert!(with.iter().any(|r| r.applied_n.z > 5.0));
}

#[test]
fn other_hands_delays_rates_and_noise_give_no_energy_either() {
    let wall = Wall::default();
    let light = HandSettings { mass_kg: 0.1, stiffness_n_per_m: 300.0, damping_n_s_per_m: 2.0 };
    let strong = HandSettings { mass_kg: 0.5, stiffness_n_per_m: 1500.0, damping_n_s_per_m: 20.0 };
    for (name, wall) in [
        ("no delay", Wall { delay_s: 0.0, ..wall }),
        ("5 ms", Wall { delay_s: 0.005, ..wall }),
        ("40 ms", Wall { delay_s: 0.04, ..wall }),
        ("1000 N/m", Wall { stiffness_n_per_m: 1000.0, ..wall }),
        ("20000 N/m", Wall { stiffness_n_per_m: 20_000.0, ..wall }),
        ("4 kHz", Wall { period_s: 0.25e-3, ..wall }),
        ("200 Hz", Wall { period_s: 5e-3, ..wall }),
        ("a light hand", Wall { hand: light, ..wall }),
        ("a strong hand", Wall { hand: strong, ..wall }),
        ("fast presses", Wall { cycle_s: 0.7, ..wall }),
        ("noise of 5 um", Wall { noise_m: 5e-6, ..wall }),
        ("noise of 20 um", Wall { noise_m: 2e-5, ..wall }),
        ("steps of 10 um", Wall { quantum_m: 1e-5, ..wall }),
        ("steps of 60 um", Wall { quantum_m: 6e-5, ..wall }),
        ("noise and steps", Wall { noise_m: 5e-6, quantum_m: 1e-5, ..wall }),
        ("noise and steps, no delay", Wall { noise_m: 5e-6, quantum_m: 1e-5, delay_s: 0.0, ..wall }),
    ] {
        let records = wall.run(60.0);
        println!(
            "{name}: {:.3} mJ at most, {:.3} mJ in the end",
            1e3 * largest_j(&records),
            1e3 * end_j(&records)
        );
        assert!(largest_j(&records) <= LARGEST_J, "{name}: {}", largest_j(&records));
    }
}

#[test]
fn the_observer_counts_exactly_what_was_commanded_and_measured() {
    for passivity in [true, false] {
        let wall = Wall { passivity, ..Wall::default() };
        for record in wall.run(10.0) {
            let scale = 1.0 + record.given_j.abs();
            assert!((record.believed_j - record.given_j).abs() < 1e-9 * scale, "{record:?}");
        }
    }
}

#[test]
fn a_contact_that_is_answered_in_time_is_felt_as_it_is() {
    for (stiffness_n_per_m, most) in [(300.0, 0.02), (1000.0, 0.02), (2000.0, 0.04)] {
        let share = missing_share(&Wall { stiffness_n_per_m, delay_s: 0.0, ..Wall::default() }.run(60.0));
        println!("{stiffness_n_per_m} N/m without delay: {:.2} % of the force is missing", 100.0 * share);
        assert!(share < most, "{stiffness_n_per_m} N/m: {share}");
    }
}

#[test]
fn a_minute_of_holding_against_a_wall_is_not_worn_away_by_noise() {
    let wall = Wall {
        stiffness_n_per_m: 1000.0,
        delay_s: 0.0,
        noise_m: 2e-6,
        quantum_m: 1e-5,
        cycle_s: 90.0, // 36 s of holding, 18 s on the way there
        ..Wall::default()
    };
    let records = wall.run(60.0);
    assert!(missing_share(&records) < 0.001, "{}", missing_share(&records));
    assert!(records.last().is_some_and(|r| r.applied_n.z > 6.0));
}
