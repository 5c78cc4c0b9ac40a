//! `body.stiffness_map`: a CSV file with one factor on the contact law for each vertex of the mesh; in and out.

use std::fmt;
use std::path::Path;

use rhombus_chain::{StiffnessMap, StiffnessMapError, SurfaceMesh};

use crate::{BodySettings, Problem, SceneError, read_response};

const KEY: &str = "body.stiffness_map";
const HEADER: &str = "factor";
const ACCEPTED: &str = "accepted: a line \"factor\", then one number from 0.001 to 1000 for each vertex of the mesh, in its order";

/// Reads the factors for `mesh`: `#` comments and empty lines are skipped, the header is `factor`, then one number in a line.
///
/// # Errors
/// The file cannot be read, has another header, a line that is no number from 0.001 to 1000, or another number of lines than
/// the mesh has vertices; the error names the line.
pub fn read_stiffness_map(path: &Path, mesh: &SurfaceMesh) -> Result<StiffnessMap, SceneError> {
    let (factors, lines) = factors_and_lines(path)?;
    StiffnessMap::new(factors, mesh).map_err(|fault| {
        let line = match fault {
            StiffnessMapError::Factor { vertex, .. } => lines.get(vertex).copied(),
            StiffnessMapError::Count { .. } | StiffnessMapError::OtherMesh { .. } => None,
        };
        error(path, line, Problem::Stiffness(fault.to_string()))
    })
}

/// The factors of a body's stiffness map or of its calibrated response, for a picture: neither their range nor their count is
/// checked. Empty where the law is the same everywhere.
///
/// # Errors
/// The file cannot be read or is not what it should be; the error names the line of a map.
pub fn read_stiffness_factors(body: &BodySettings) -> Result<Vec<f64>, SceneError> {
    match (&body.stiffness_map, &body.response) {
        (Some(path), _) => Ok(factors_and_lines(path)?.0),
        (None, Some(path)) => Ok(read_response(path)?.factors.into_iter().map(f64::from).collect()),
        (None, None) => Ok(Vec::new()),
    }
}

fn error(path: &Path, line: Option<usize>, problem: Problem) -> SceneError {
    let file = path.display().to_string();
    SceneError { file, line, key: Some(KEY.to_owned()), problem: Box::new(problem) }
}

/// Each number and the line it stands in.
fn factors_and_lines(path: &Path) -> Result<(Vec<f64>, Vec<usize>), SceneError> {
    let error = |line, problem| error(path, line, problem);
    let bytes = std::fs::read(path).map_err(|fault| error(None, Problem::Unreadable(fault)))?;
    let text = String::from_utf8_lossy(&bytes);
    let mut rows = rows(&text);
    match rows.next() {
        None => return Err(error(None, Problem::Empty { accepted: ACCEPTED })),
        Some((_, HEADER)) => {}
        Some((line, other)) => {
            let message = format!("header {:?} is not accepted; {ACCEPTED}", shortened(other));
            return Err(error(Some(line), Problem::Stiffness(message)));
        }
    }
    let (mut factors, mut lines) = (Vec::new(), Vec::new());
    for (line, row) in rows {
        let number = row.parse::<f64>().map_err(|_| {
            let message =
                format!("factor {:?} is not accepted; accepted: a number from 0.001 to 1000", shortened(row));
            error(Some(line), Problem::Stiffness(message))
        })?;
        factors.push(number);
        lines.push(line);
    }
    Ok((factors, lines))
}

/// What is neither comment nor empty, with its line counted from 1.
fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Factors as the text of such a file; they read back to the same bits.
pub struct StiffnessFile<'a> {
    /// Comment lines at the top, without `#`.
    pub comment: &'a str,
    /// One factor for each vertex of the mesh, in its order.
    pub factors: &'a [f64],
}

impl fmt::Display for StiffnessFile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in self.comment.lines() {
            writeln!(f, "# {line}")?;
        }
        writeln!(f, "{HEADER}")?;
        self.factors.iter().try_for_each(|factor| writeln!(f, "{factor:?}"))
    }
}
