//! Order statistics of a sample.

/// Minimum, quartiles and upper tail of a sample, in the sample's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Number of values.
    pub count: usize,
    /// Smallest value.
    pub min: f64,
    /// Lower quartile.
    pub q1: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub q3: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest value.
    pub max: f64,
}

impl Spread {
    /// Statistics of `values`, which are sorted in place; `None` for an empty sample.
    pub fn of(values: &mut [f64]) -> Option<Spread> {
        values.sort_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        let at = |fraction: f64| values[(fraction * last as f64).round() as usize];
        Some(Spread {
            count: values.len(),
            min: values[0],
            q1: at(0.25),
            median: at(0.5),
            q3: at(0.75),
            p99: at(0.99),
            max: values[last],
        })
    }

    /// Header of [`Spread::csv`].
    pub const CSV_HEADER: &'static str = "count,min,q1,median,q3,p99,max";

    /// The statistics as CSV fields.
    pub fn csv(&self) -> String {
        let Spread { count, min, q1, median, q3, p99, max } = self;
        format!("{count},{min:.4},{q1:.4},{median:.4},{q3:.4},{p99:.4},{max:.4}")
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn quantiles_of_0_to_100_are_their_own_percentages() {
        let mut values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let spread = Spread::of(&mut values).unwrap();
        assert_eq!(
            (spread.min, spread.q1, spread.median, spread.q3, spread.p99, spread.max),
            (0.0, 25.0, 50.0, 75.0, 99.0, 100.0)
        );
        assert_eq!(Spread::of(&mut []), None);
    }
}
