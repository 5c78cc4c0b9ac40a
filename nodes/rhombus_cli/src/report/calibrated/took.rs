//! What calibrations took, measured when the bodies were made: `bodies/took.csv`.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};

/// Time and memory of one calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Took {
    /// s.
    pub(super) seconds: f64,
    /// Largest at once, GB.
    pub(super) gigabytes: f64,
}

const HEAD: &str = "body,seconds,memory_gb";

impl Took {
    /// Of a body by its name.
    ///
    /// # Errors
    /// The file is missing, not as it should be, or has no row for the body.
    pub(super) fn read(reference: &Path, name: &str) -> Result<Self> {
        let path = reference.join("bodies").join("took.csv");
        let text = std::fs::read_to_string(&path);
        let text = text.with_context(|| format!("{}, with {HEAD} for each body", path.display()))?;
        Self::of(&text, name).with_context(|| path.display().to_string())
    }

    fn of(text: &str, name: &str) -> Result<Self> {
        let mut rows = text.lines().filter(|line| !line.starts_with('#'));
        let head = rows.next().unwrap_or_default();
        ensure!(head == HEAD, "the heading is {head:?}; accepted: {HEAD}");
        let row = rows.find_map(|row| row.strip_prefix(name)?.strip_prefix(','));
        let row = row.with_context(|| format!("no row for {name}; accepted: {name},SECONDS,GIGABYTES"))?;
        let numbers = row.split_once(',').and_then(|(s, gb)| Some((s.parse().ok()?, gb.parse().ok()?)));
        let (seconds, gigabytes): (f64, f64) =
            numbers.with_context(|| format!("{name},{row}; accepted: {name},SECONDS,GIGABYTES"))?;
        ensure!(seconds > 0.0 && gigabytes > 0.0, "{name},{row}; accepted: numbers greater than 0");
        Ok(Self { seconds, gigabytes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_found_by_its_body_and_what_is_none_is_named() {
        let text = "# why\nbody,seconds,memory_gb\nliver_nu30,1,2\nliver,154.2,1.04\n";
        assert_eq!(Took::of(text, "liver").unwrap(), Took { seconds: 154.2, gigabytes: 1.04 });
        for (text, words) in [
            ("", "the heading is \"\""),
            ("body,seconds,memory_gb\n", "no row for liver"),
            ("body,seconds,memory_gb\nliver,1\n", "liver,1; accepted"),
            ("body,seconds,memory_gb\nliver,-1,2\n", "greater than 0"),
            ("body,seconds,memory_gb\nliver,NaN,2\n", "greater than 0"),
        ] {
            let refused = format!("{:#}", Took::of(text, "liver").unwrap_err());
            assert!(refused.contains(words), "{refused}");
        }
    }
}
