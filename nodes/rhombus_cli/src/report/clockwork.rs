//! How long a call takes: every repeat, by the clock.

use std::hint::black_box;
use std::time::Instant;

use rhombus_benches::Spread;

/// Fewest repeats that a median is taken of.
pub(crate) const FEWEST: usize = 30;

/// Microseconds of each repeat, in the order in which they were measured.
#[derive(Clone, Debug)]
pub(crate) struct Times(pub(crate) Vec<f64>);

/// Times `call` for each of `repeats`, after a tenth of them as warm-up.
pub(crate) fn times(repeats: usize, mut call: impl FnMut(usize) -> f64) -> Times {
    for repeat in 0..repeats.div_ceil(10) {
        black_box(call(repeat));
    }
    Times(
        (0..repeats)
            .map(|repeat| {
                let start = Instant::now();
                black_box(call(black_box(repeat)));
                start.elapsed().as_secs_f64() * 1e6
            })
            .collect(),
    )
}

impl Times {
    /// Order statistics; `None` without repeats.
    pub(crate) fn spread(&self) -> Option<Spread> {
        Spread::of(&mut self.0.clone())
    }

    /// The median, us.
    pub(crate) fn median_us(&self) -> f64 {
        self.spread().map_or(f64::NAN, |spread| spread.median)
    }
}
