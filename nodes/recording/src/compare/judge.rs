//! Compares two messages value by value and keeps the first and worst differences of each field.

use super::kind::{Column, Compared, Field, Kind};
use super::outcome::{Change, Divergence, FieldOutcome, Value, ValueChange, Worst};
use super::surface::on_vertices;
use super::tolerance::Tolerance;
use crate::messages::Time;

/// Which messages are compared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) golden_index: u64,
    pub(super) computed_index: u64,
    /// Of the golden message.
    pub(super) stamp_ns: i64,
}

/// The differences of a topic so far.
#[derive(Debug)]
pub(super) struct Judge {
    fields: Vec<FieldJudge>,
}

#[derive(Debug)]
struct FieldJudge {
    field: Field,
    tolerance: Tolerance,
    differs: bool,
    differing: u64,
    first: Option<Divergence>,
    worst_absolute: Option<Worst>,
    worst_relative: Option<Worst>,
    sum_of_squares: f64,
}

/// What one field of one pair differs in.
#[derive(Debug, Default)]
pub(super) struct Found {
    tolerance: Tolerance,
    /// The first value outside of its tolerance: place in the field, both values, difference.
    outside: Option<(Place, Value, Value, Option<f64>)>,
    /// The largest over the elements.
    absolute: f64,
    relative: Option<f64>,
    differs: bool,
    has_numbers: bool,
}

/// Where in a field.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place {
    /// The field is one value.
    Whole,
    /// An element of an array.
    Element(usize),
    /// A component of a vertex's displacement.
    Vertex(u32, char),
}

impl Judge {
    pub(super) fn new(kind: Kind, tolerances: Vec<Tolerance>) -> Self {
        let fields = kind.fields().iter().zip(tolerances).map(|(field, tolerance)| FieldJudge {
            field: *field,
            tolerance,
            differs: false,
            differing: 0,
            first: None,
            worst_absolute: None,
            worst_relative: None,
            sum_of_squares: 0.0,
        });
        Self { fields: fields.collect() }
    }

    /// The first difference that is not tolerated, in the order of the fields.
    ///
    /// # Errors
    /// When a surface is not one: the sentence says which and why.
    pub(super) fn compare<M: Compared>(
        &mut self,
        pair: Pair,
        golden: &M,
        computed: &M,
    ) -> Result<Option<Divergence>, String> {
        let mut first = None;
        for (own, (golden, computed)) in self.fields.iter_mut().zip(golden.columns().zip(computed.columns()))
        {
            let mut found = Found { tolerance: own.tolerance, ..Found::default() };
            found.columns(golden, computed)?;
            if let Some(divergence) = own.note(pair, found) {
                first.get_or_insert(divergence);
            }
        }
        Ok(first)
    }

    pub(super) fn finish(self, paired: u64) -> Vec<FieldOutcome> {
        let differing = self.fields.into_iter().filter(|field| field.differs);
        let outcome = |judge: FieldJudge| FieldOutcome {
            name: judge.field.name,
            unit: judge.field.unit,
            differing: judge.differing,
            first: judge.first,
            rms: judge.worst_absolute.map(|_| (judge.sum_of_squares / paired.max(1) as f64).sqrt()),
            worst_absolute: judge.worst_absolute,
            worst_relative: judge.worst_relative,
        };
        differing.map(outcome).collect()
    }
}

impl FieldJudge {
    fn note(&mut self, pair: Pair, found: Found) -> Option<Divergence> {
        if !found.differs {
            return None;
        }
        self.differs = true;
        let Pair { golden_index, computed_index, stamp_ns } = pair;
        let worst = |value| Worst { value, golden_index, stamp_ns };
        let is_worse = |value: f64, than: Option<Worst>| than.is_none_or(|known| value > known.value);
        if found.has_numbers {
            self.sum_of_squares += found.absolute * found.absolute;
            if is_worse(found.absolute, self.worst_absolute) {
                self.worst_absolute = Some(worst(found.absolute));
            }
        }
        if let Some(relative) = found.relative
            && is_worse(relative, self.worst_relative)
        {
            self.worst_relative = Some(worst(relative));
        }
        let (place, golden, computed, difference) = found.outside?;
        self.differing += 1;
        let field = place.said(self.field.name);
        let change =
            Change::Value(ValueChange { field, unit: self.field.unit, golden, computed, difference });
        let (golden_index, computed_index) = (Some(golden_index), Some(computed_index));
        let divergence = Divergence { golden_index, computed_index, stamp_ns, change };
        self.first.get_or_insert_with(|| divergence.clone());
        Some(divergence)
    }
}

impl Found {
    fn columns(&mut self, golden: Column<'_>, computed: Column<'_>) -> Result<(), String> {
        let text = |text: &str| Value::Text(format!("{text:?}"));
        match (golden, computed) {
            (Column::Number(golden), Column::Number(computed)) => self.number(Place::Whole, golden, computed),
            (Column::Numbers(golden), Column::Numbers(computed)) => {
                self.lengths(golden.len(), computed.len());
                for (place, (golden, computed)) in golden.iter().zip(computed).enumerate() {
                    self.number(Place::Element(place), *golden, *computed);
                }
            }
            (Column::Stamp(golden), Column::Stamp(computed)) => self.stamps(golden, computed),
            (Column::Text(golden), Column::Text(computed)) => {
                self.exact(Place::Whole, golden, computed, text)
            }
            (Column::Flag(golden), Column::Flag(computed)) => {
                self.exact(Place::Whole, golden, computed, |own| Value::Text(own.to_string()))
            }
            (Column::Whole(golden), Column::Whole(computed)) => {
                self.exact(Place::Whole, golden, computed, |own| Value::Text(own.to_string()))
            }
            (Column::Wholes(golden), Column::Wholes(computed)) => {
                self.lengths(golden.len(), computed.len());
                for (place, (golden, computed)) in golden.iter().zip(computed).enumerate() {
                    self.exact(Place::Element(place), golden, computed, |own| Value::Text(own.to_string()));
                }
            }
            (Column::Texts(golden), Column::Texts(computed)) => {
                self.lengths(golden.len(), computed.len());
                for (place, (golden, computed)) in golden.iter().zip(computed).enumerate() {
                    self.exact(Place::Element(place), golden, computed, |own| text(own));
                }
            }
            (Column::Vertices(golden), Column::Vertices(computed)) => on_vertices(golden, computed, self)?,
            // Two messages of one type have the same columns.
            _ => {}
        }
        Ok(())
    }

    fn stamps(&mut self, golden: &Time, computed: &Time) {
        let [golden_ns, computed_ns] =
            [golden, computed].map(|time| i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec));
        if golden != computed {
            let seconds = (computed_ns - golden_ns) as f64 / 1e9;
            self.measure(seconds.abs(), None);
            let [golden, computed] = [golden_ns, computed_ns].map(|stamp_ns| Value::Text(said(stamp_ns)));
            self.outside.get_or_insert((Place::Whole, golden, computed, Some(seconds)));
        }
    }

    fn lengths(&mut self, golden: usize, computed: usize) {
        self.exact(Place::Whole, golden, computed, |own| Value::Text(format!("{own} elements")));
    }

    fn exact<T: PartialEq>(&mut self, place: Place, golden: T, computed: T, said: impl Fn(T) -> Value) {
        if golden != computed {
            self.differs = true;
            self.outside.get_or_insert_with(|| (place, said(golden), said(computed), None));
        }
    }

    fn number(&mut self, place: Place, golden: f64, computed: f64) {
        if golden.to_bits() == computed.to_bits() || golden.is_nan() && computed.is_nan() {
            return;
        }
        self.differing_numbers(place, [golden, computed], Value::Number);
    }

    pub(super) fn single(&mut self, place: Place, golden: f32, computed: f32) {
        if golden.to_bits() == computed.to_bits() || golden.is_nan() && computed.is_nan() {
            return;
        }
        // Back to 32 bits without loss: that is where they come from.
        self.differing_numbers(place, [golden.into(), computed.into()], |number| {
            Value::Single(number as f32)
        });
    }

    fn differing_numbers(
        &mut self,
        place: Place,
        [golden, computed]: [f64; 2],
        value: impl Fn(f64) -> Value,
    ) {
        let difference = computed - golden;
        // A NaN on one side alone, which is as far apart as can be.
        let absolute = if difference.is_nan() { f64::INFINITY } else { difference.abs() };
        let relative = absolute / golden.abs();
        self.measure(absolute, relative.is_finite().then_some(relative));
        if !self.tolerance.accepts(golden, absolute) {
            self.outside.get_or_insert_with(|| (place, value(golden), value(computed), Some(difference)));
        }
    }

    fn measure(&mut self, absolute: f64, relative: Option<f64>) {
        self.differs = true;
        self.has_numbers = true;
        self.absolute = self.absolute.max(absolute);
        self.relative = [self.relative, relative].into_iter().flatten().reduce(f64::max);
    }
}

impl Place {
    fn said(self, field: &str) -> String {
        match self {
            Self::Whole => field.to_owned(),
            Self::Element(place) => format!("{field}[{place}]"),
            Self::Vertex(vertex, component) => format!("{field}.{component} of vertex {vertex}"),
        }
    }
}

/// A stamp in seconds with all its digits.
pub(super) fn said(stamp_ns: i64) -> String {
    let sign = if stamp_ns < 0 { "-" } else { "" };
    let ns = stamp_ns.unsigned_abs();
    format!("{sign}{}.{:09}", ns / 1_000_000_000, ns % 1_000_000_000)
}
