//! Outcomes for the tests of the reports.

use recording::{
    Bin, Change, Counts, Divergence, FieldOutcome, Outcome, Presence, Signal, TopicOutcome, Unpaired, Value,
    ValueChange, Verdict, Worst,
};

fn topic(name: &str, verdict: Verdict) -> TopicOutcome {
    let counts = Counts { golden: 1000, computed: 1000, paired: 1000, ..Counts::default() };
    TopicOutcome {
        name: name.to_owned(),
        type_name: String::new(),
        presence: Presence::Both,
        counts,
        first: None,
        fields: Vec::new(),
        missing: Vec::new(),
        extra: Vec::new(),
        signal: None,
        verdict,
    }
}

/// A signal of these golden and computed values, 1 ms apart.
pub(in crate::replay) fn signal(unit: &'static str, values: impl Iterator<Item = (f64, f64)>) -> Signal {
    let bins = values.zip(0..).map(|((golden, computed), ms)| Bin {
        start_ns: 10_000_000_000 + ms * 1_000_000,
        end_ns: 10_001_000_000 + ms * 1_000_000,
        golden: Some((golden, golden)),
        computed: Some((computed, computed)),
        difference: Some((computed - golden, computed - golden)),
    });
    Signal { quantity: "|force|", unit, bins: bins.collect() }
}

/// One topic that differs, one that does not, one that the golden recording does not have.
pub(in crate::replay) fn outcome() -> Outcome {
    let stamp_ns = 10_020_000_000;
    let change = ValueChange {
        field: "wrench.force.z".to_owned(),
        unit: "N",
        golden: Value::Number(-1.25),
        computed: Value::Number(-1.5),
        difference: Some(-0.25),
    };
    let change = Change::Value(change);
    let first = Divergence { golden_index: Some(20), computed_index: Some(20), stamp_ns, change };
    let worst = |value| Some(Worst { value, golden_index: 20, stamp_ns });
    let field = FieldOutcome {
        name: "wrench.force.z",
        unit: "N",
        differing: 1,
        first: Some(first.clone()),
        worst_absolute: worst(0.25),
        worst_relative: worst(0.2),
        rms: Some(0.25 / 998_f64.sqrt()),
    };
    let counts =
        Counts { golden: 1000, computed: 998, paired: 998, differing: 1, missing: 2, ..Counts::default() };
    let missing =
        [30, 31].map(|index| Unpaired { index, stamp_ns: 10_000_000_000 + index as i64 * 1_000_000 });
    let force = TopicOutcome {
        counts,
        first: Some(first),
        fields: vec![field],
        missing: missing.to_vec(),
        ..topic("/servo_cf", Verdict::Different)
    };
    let left = TopicOutcome {
        presence: Presence::ComputedOnly,
        counts: Counts { computed: 5, extra: 5, ..Counts::default() },
        ..topic("/left/servo_cf", Verdict::Different)
    };
    let topics = vec![force, topic("/contact_state", Verdict::Same), left];
    Outcome { golden: "tests/golden".into(), topics, verdict: Verdict::Different }
}
