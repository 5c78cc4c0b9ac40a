//! One line of a check.

/// How it stands with one thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// As it should be.
    Ok,
    /// It works, but not as well as it could.
    Warning,
    /// It does not work, or must not be used like this.
    Failure,
}

impl Verdict {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Ok => "ok",
            Verdict::Warning => "warning",
            Verdict::Failure => "failure",
        }
    }
}

/// What was found about one thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is about, in snake_case.
    pub name: &'static str,
    /// How it stands.
    pub verdict: Verdict,
    /// What was found, with its numbers.
    pub found: String,
    /// What it is held against; empty: nothing.
    pub limit: String,
    /// What to do; empty when there is nothing to do.
    pub remedy: String,
    /// The numbers in `found`, with their units in their names.
    pub numbers: Vec<(&'static str, f64)>,
}

impl Finding {
    /// As it should be.
    pub fn ok(name: &'static str, found: impl Into<String>) -> Finding {
        Finding::new(name, Verdict::Ok, found, "")
    }

    /// It works, but not as well as it could.
    pub fn warning(name: &'static str, found: impl Into<String>, remedy: impl Into<String>) -> Finding {
        Finding::new(name, Verdict::Warning, found, remedy)
    }

    /// It does not work.
    pub fn failure(name: &'static str, found: impl Into<String>, remedy: impl Into<String>) -> Finding {
        Finding::new(name, Verdict::Failure, found, remedy)
    }

    /// A finding; a remedy is kept only where something is wrong.
    pub fn new(
        name: &'static str,
        verdict: Verdict,
        found: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Finding {
        let remedy = if verdict == Verdict::Ok { String::new() } else { remedy.into() };
        Finding { name, verdict, found: found.into(), limit: String::new(), remedy, numbers: Vec::new() }
    }

    /// With what it is held against.
    #[must_use]
    pub fn held_against(mut self, limit: impl Into<String>) -> Finding {
        self.limit = limit.into();
        self
    }

    /// With one of its numbers.
    #[must_use]
    pub fn with(mut self, name: &'static str, number: f64) -> Finding {
        self.numbers.push((name, number));
        self
    }
}
