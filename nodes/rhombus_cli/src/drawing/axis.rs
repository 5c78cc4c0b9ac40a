//! What an axis says about itself.

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit: `force [N]`.
    pub label: String,
    /// Linear or logarithmic. Points at or below zero are not drawn on a logarithmic axis.
    pub scale: Scale,
    /// Drawn range; by default what the points need.
    pub range: Option<(f64, f64)>,
    /// About so many divisions are made on a linear axis.
    pub divisions: f64,
}

/// How an axis is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal factors.
    Log,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Linear, range: None, divisions: 8.0 }
    }

    /// A logarithmic axis.
    pub fn log(label: &str) -> Self {
        Self { scale: Scale::Log, ..Self::linear(label) }
    }

    /// With a fixed range.
    pub fn within(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }

    /// With about so many divisions, for an axis that is shorter than others.
    pub fn divided(self, divisions: f64) -> Self {
        Self { divisions, ..self }
    }
}

impl Scale {
    /// Whether a value has a place on such an axis.
    pub fn has(self, value: f64) -> bool {
        value.is_finite() && (self == Scale::Linear || value > 0.0)
    }
}
