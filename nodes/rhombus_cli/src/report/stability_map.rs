//! Stability map: random chains far beyond any tissue, at depths far beyond any body. Each is accepted and total, or refused
//! with the right reason; a third outcome is counted.

mod peers;
mod random;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

use rhombus_chain::Formulation;
use rhombus_chain::checks::{self, Extreme, Outcome};

use super::figure::{Axis, Figure, Marker, Series};
use super::section::{Ask, Context, Exhibit, Mode, Section, SectionOutput, Verdict};
use super::table::{Cell, Table};
pub(crate) use peers::Liver;
pub(crate) use random::Random;

pub(crate) const SECTION: Section = Section {
    name: "stability_map",
    title: "Stability map: stiff and extreme cases",
    asks: &[Ask { what: "stability map: third outcomes", asked: "none" }],
    run,
};

/// Cases that one thread takes at a time. Each such block has its own seed, so that the cases do not depend on the machine.
const BLOCK: usize = 10_000;
/// Half decades of k_t/k_n from 1e-6 to 1e6.
const RATIO_BINS: usize = 24;
/// Bins of 5 degrees.
const ANGLE_BINS: usize = 18;
/// Third outcomes written down in full.
const MOST_FAULTS: usize = 1000;

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let blocks = match context.mode {
        Mode::Quick => 10,
        Mode::Full => 1000,
    };
    let tally =
        tally(blocks, |done| context.progress.step(&format!("{} of {} cases", done * BLOCK, blocks * BLOCK)));
    let cases = blocks * BLOCK;
    context.progress.step("mass-spring");
    let sizes: &[usize] = if context.mode == Mode::Full { &[500, 1000, 3116] } else { &[500] };
    let mass_spring = peers::mass_spring(context.reference, sizes)?;
    Ok(SectionOutput {
        text: vec![
            "Ranges: k_n 1e-3 to 1e9 N/m, k_t/k_n 1e-6 to 1e6, theta 0.1 to 89.9 degrees (densest at both ends), q 0.02 to \
             1 - 1e-9, n 1 to 10^6, beta 1e-3 to 1e6, a 1e-4 to 1 m, depths of both signs from 1e-300 to 1e300 m; what spans \
             decades is drawn evenly in the exponent."
                .to_owned(),
            "Whether a chain has to be accepted is computed a second time by other means (sums in closed form and in logarithms). \
             An accepted law has to answer with finite numbers at the depth drawn and from 1.5 times one guard to 1.5 times the \
             other, to rise, to follow its closed form between the guards, to have no jump between neighbouring numbers, to \
             invert, and to give a surface that falls from the contact to its boundary. Rules within 1e-6 of equality and sums \
             within e^30 of the largest number may be decided either way. A panic counts as a third outcome."
                .to_owned(),
        ],
        verdicts: vec![Verdict::new(
            SECTION.asks[0].what,
            format!("{} of {cases} cases", tally.third),
            tally.third == 0,
        )],
        exhibits: vec![outcomes(&tally), map(&tally), mass_spring],
    })
}

/// What became of many cases.
#[derive(Default)]
struct Tally {
    /// By formulation (published, energy) and outcome.
    counts: BTreeMap<(&'static str, &'static str), u64>,
    third: u64,
    faults: Vec<String>,
    /// Energy law, sums that overflow left out: accepted and all, by half decade of k_t/k_n and angle.
    bins: Vec<[u64; 2]>,
}

const OUTCOMES: [&str; 5] = [
    "accepted and total",
    "refused: the energy law snaps through",
    "refused: the published law does not push back",
    "refused: a sum overflows",
    "third outcome",
];

impl Tally {
    /// Tries one block of cases.
    fn of_block(block: usize) -> Tally {
        let mut tally = Tally { bins: vec![[0; 2]; RATIO_BINS * ANGLE_BINS], ..Tally::default() };
        let mut random = Random::new(block as u64);
        for _ in 0..BLOCK {
            tally.add(&Extreme::from_unit([(); Extreme::NUMBERS].map(|()| random.share())));
        }
        tally
    }

    fn add(&mut self, extreme: &Extreme) {
        let name = match extreme.formulation {
            Formulation::Published => "published",
            Formulation::Energy => "energy",
        };
        let tried =
            catch_unwind(AssertUnwindSafe(|| checks::outcome(extreme).map_err(|third| third.to_string())));
        let outcome = match tried.unwrap_or_else(|_| Err(format!("panic: {extreme:?}"))) {
            Ok(Outcome::Accepted) => OUTCOMES[0],
            Ok(Outcome::SnapsThrough) => OUTCOMES[1],
            Ok(Outcome::NotRising) => OUTCOMES[2],
            Ok(Outcome::TangentialOverflow) => OUTCOMES[3],
            Err(fault) => {
                self.third += 1;
                if self.faults.len() < MOST_FAULTS {
                    self.faults.push(fault);
                }
                OUTCOMES[4]
            }
        };
        *self.counts.entry((name, outcome)).or_default() += 1;
        if extreme.formulation == Formulation::Energy && outcome != OUTCOMES[3] {
            let chain = &extreme.chain;
            let decades = libm::log10(chain.tangential_stiffness_n_per_m / chain.normal_stiffness_n_per_m);
            let ratio = ((2.0 * (decades + 6.0)) as usize).min(RATIO_BINS - 1);
            let angle = ((chain.angle_rad.to_degrees() / 5.0) as usize).min(ANGLE_BINS - 1);
            let bin = &mut self.bins[angle * RATIO_BINS + ratio];
            bin[0] += u64::from(outcome == OUTCOMES[0]);
            bin[1] += 1;
        }
    }

    fn merge(&mut self, other: Tally) {
        for (key, count) in other.counts {
            *self.counts.entry(key).or_default() += count;
        }
        self.third += other.third;
        let room = MOST_FAULTS.saturating_sub(self.faults.len());
        self.faults.extend(other.faults.into_iter().take(room));
        self.bins.resize(other.bins.len(), [0; 2]);
        for (own, other) in self.bins.iter_mut().zip(other.bins) {
            own[0] += other[0];
            own[1] += other[1];
        }
    }
}

/// Blocks `0 .. blocks`, on all processors, merged in their order.
fn tally(blocks: usize, mut done: impl FnMut(usize)) -> Tally {
    let at_once = thread::available_parallelism().map_or(1, usize::from);
    let mut all = Tally::default();
    for first in (0..blocks).step_by(at_once) {
        if first % 50 < at_once {
            done(first);
        }
        let round = first..blocks.min(first + at_once);
        let tallies = thread::scope(|scope| {
            let threads: Vec<_> = round.map(|block| scope.spawn(move || Tally::of_block(block))).collect();
            threads.into_iter().map(thread::ScopedJoinHandle::join).collect::<Vec<_>>()
        });
        for tally in tallies {
            match tally {
                Ok(tally) => all.merge(tally),
                // Every case is caught by itself; a thread that dies in spite of that has lost its block.
                Err(_) => all.third += BLOCK as u64,
            }
        }
    }
    all
}

fn outcomes(tally: &Tally) -> Exhibit {
    let mut table = Table::new([("outcome", ""), ("published law", "cases"), ("energy law", "cases")]);
    for outcome in OUTCOMES {
        let count = |law| Cell::Count(tally.counts.get(&(law, outcome)).copied().unwrap_or_default());
        table.push([outcome.into(), count("published"), count("energy")]);
    }
    let mut raw = Table::new([("third outcome", "")]);
    tally.faults.iter().for_each(|fault| raw.push([fault.as_str().into()]));
    Exhibit {
        name: "stability_outcomes",
        title: "What became of random chains".to_owned(),
        caption: "Counts by force law; third outcomes, if there are any, in full in the raw numbers."
            .to_owned(),
        figure: None,
        table,
        raw: Some(raw),
    }
}

/// Where in the plane of stiffness ratio and angle energy laws are accepted.
fn map(tally: &Tally) -> Exhibit {
    let bands = [
        (0.0, "none accepted", 7),
        (0.25, "up to a quarter", 5),
        (0.5, "up to a half", 1),
        (0.75, "up to three quarters", 4),
    ];
    let mut table = Table::new([("k_t/k_n", ""), ("theta", "deg"), ("accepted", ""), ("cases", "")]);
    let mut tiles = vec![Vec::new(); bands.len() + 1];
    for (index, [accepted, cases]) in tally.bins.iter().enumerate() {
        let ratio = libm::pow(10.0, 0.5 * ((index % RATIO_BINS) as f64 + 0.5) - 6.0);
        let degrees = 5.0 * ((index / RATIO_BINS) as f64 + 0.5);
        table.push([ratio.into(), degrees.into(), Cell::Count(*accepted), Cell::Count(*cases)]);
        if *cases > 0 {
            let share = *accepted as f64 / *cases as f64;
            let band = bands.iter().position(|(most, ..)| share <= *most).unwrap_or(bands.len());
            tiles[band].push((ratio, degrees));
        }
    }
    let names = bands.iter().map(|(_, name, colour)| (*name, *colour)).chain([("more", 2)]);
    let series = names
        .zip(tiles)
        .map(|((name, colour), tiles)| Series::line(name, colour, tiles).scattered(Marker::Tile(20)));
    Exhibit {
        name: "stability_map",
        title: "Energy laws: share accepted".to_owned(),
        caption: "Over the ratio of the springs and the angle, whatever the other parameters; chains whose sums overflow are left \
                  out. Where tangential springs store more when pressed than the normal ones, a chain would snap through and is \
                  refused."
            .to_owned(),
        figure: Some(Figure {
            x: Axis::log("k_t/k_n").within(1e-6, 1e6),
            y: Axis::linear("theta [degrees]").within(0.0, 90.0),
            series: series.collect(),
        }),
        table,
        raw: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_thousand_cases_have_no_third_outcome_and_every_other_one_occurs() {
        let tally = Tally::of_block(0);
        assert_eq!(tally.third, 0, "{:?}", tally.faults);
        assert_eq!(tally.counts.values().sum::<u64>(), BLOCK as u64);
        for outcome in &OUTCOMES[..4] {
            assert!(tally.counts.keys().any(|(_, name)| name == outcome), "{outcome}");
        }
        assert!(
            !tally.counts.contains_key(&("published", OUTCOMES[1])),
            "the published law never snaps through"
        );
    }

    #[test]
    fn blocks_add_up_whatever_the_machine() {
        let all = tally(3, |_| {});
        let mut one_by_one = Tally::default();
        (0..3).for_each(|block| one_by_one.merge(Tally::of_block(block)));
        assert_eq!(all.counts, one_by_one.counts);
        assert_eq!(all.bins, one_by_one.bins);
        assert_ne!(Tally::of_block(0).counts, Tally::of_block(1).counts, "another seed, other cases");
    }
}
