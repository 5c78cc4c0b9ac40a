//! The outcome of a comparison for programs.

use recording::{
    Change, Counts, Divergence, FieldOutcome, Outcome, Presence, TopicOutcome, Unpaired, Value, Verdict,
    Worst,
};
pub use serde_json::Value as Json;
use serde_json::json;

use super::text;

/// The outcome as one JSON value.
///
/// Stamps are texts in seconds with nine decimals, since a number of that size is cut by many readers; numbers that are not
/// finite are the texts `NaN`, `inf` and `-inf`.
pub fn json(outcome: &Outcome) -> Json {
    let Outcome { golden, topics, verdict } = outcome;
    json!({
        "golden": golden.to_string_lossy(),
        "verdict": verdict.word(),
        "reason": reason(verdict),
        "topics": topics.iter().map(topic).collect::<Vec<_>>(),
    })
}

fn topic(topic: &TopicOutcome) -> Json {
    let Counts { golden, computed, paired, differing, missing, extra, reordered } = topic.counts;
    json!({
        "topic": topic.name,
        "type": topic.type_name,
        "presence": match topic.presence {
            Presence::Both => "both",
            Presence::GoldenOnly => "golden only",
            Presence::ComputedOnly => "computed only",
        },
        "verdict": topic.verdict.word(),
        "reason": reason(&topic.verdict),
        "golden_messages": golden,
        "computed_messages": computed,
        "pairs": paired,
        "differing_pairs": differing,
        "missing": missing,
        "extra": extra,
        "reordered": reordered,
        "first": topic.first.as_ref().map(divergence),
        "fields": topic.fields.iter().map(field).collect::<Vec<_>>(),
        "first_missing": topic.missing.iter().map(unpaired).collect::<Vec<_>>(),
        "first_extra": topic.extra.iter().map(unpaired).collect::<Vec<_>>(),
    })
}

fn field(field: &FieldOutcome) -> Json {
    let worst = |worst: &Option<Worst>| {
        worst.map(|worst| {
            json!({ "value": number(worst.value), "golden_index": worst.golden_index, "stamp": text::stamp(worst.stamp_ns) })
        })
    };
    json!({
        "field": field.name,
        "unit": field.unit,
        "differing_pairs": field.differing,
        "first": field.first.as_ref().map(divergence),
        "worst_absolute": worst(&field.worst_absolute),
        "worst_relative": worst(&field.worst_relative),
        "rms": field.rms.map(number),
    })
}

fn divergence(divergence: &Divergence) -> Json {
    let mut json = json!({
        "golden_index": divergence.golden_index,
        "computed_index": divergence.computed_index,
        "stamp": text::stamp(divergence.stamp_ns),
        "what": match divergence.change {
            Change::Missing => "missing",
            Change::Extra => "extra",
            Change::Reordered => "reordered",
            Change::Value(_) => "value",
        },
    });
    if let (Change::Value(change), Some(object)) = (&divergence.change, json.as_object_mut()) {
        object.insert("field".to_owned(), json!(change.field));
        object.insert("unit".to_owned(), json!(change.unit));
        object.insert("golden".to_owned(), value(&change.golden));
        object.insert("computed".to_owned(), value(&change.computed));
        object.insert("difference".to_owned(), json!(change.difference.map(number)));
    }
    json
}

fn unpaired(unpaired: &Unpaired) -> Json {
    json!({ "index": unpaired.index, "stamp": text::stamp(unpaired.stamp_ns) })
}

fn value(value: &Value) -> Json {
    match value {
        Value::Number(own) => number(*own),
        Value::Single(own) => number(f64::from(*own)),
        Value::Text(text) => json!(text),
    }
}

fn number(number: f64) -> Json {
    if number.is_finite() { json!(number) } else { json!(number.to_string()) }
}

fn reason(verdict: &Verdict) -> Option<&str> {
    match verdict {
        Verdict::NotCompared(reason) => Some(reason),
        Verdict::Same | Verdict::Different => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::text::sample;
    use super::json;
    use recording::{Change, Value};

    #[test]
    fn a_program_finds_verdict_place_and_values() {
        let mut outcome = sample::outcome();
        if let Some(Change::Value(change)) = outcome.topics[0].first.as_mut().map(|first| &mut first.change) {
            change.computed = Value::Number(f64::NAN);
            change.difference = Some(f64::NAN);
        }
        let json = json(&outcome);
        assert_eq!(json["verdict"], "different");
        let force = &json["topics"][0];
        assert_eq!((&force["missing"], &force["first_missing"][1]["index"]), (&2.into(), &31.into()));
        assert_eq!(force["first"]["stamp"], "10.020000000");
        assert_eq!(
            (&force["first"]["golden"], &force["first"]["computed"]),
            (&(-1.25).into(), &"NaN".into())
        );
        assert_eq!(force["fields"][0]["worst_relative"]["value"], 0.2);
        assert_eq!(
            (&json["topics"][1]["verdict"], &json["topics"][1]["first"]),
            (&"same".into(), &serde_json::Value::Null)
        );
        assert_eq!(json["topics"][2]["presence"], "computed only");
    }
}
