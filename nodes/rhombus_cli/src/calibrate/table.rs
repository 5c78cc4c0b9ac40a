//! Measured tables: CSV with units in the header.
//!
//! ```text
//! # comment
//! depth [mm],force [N],distance [mm],displacement [mm]
//! ```
//!
//! Depth and force, distance and displacement, or both pairs in one file; a row may leave one of two pairs empty.
//! Depth is positive into the body, force is on the hand and positive pushes out, distance is from the middle of the
//! contact along the surface, displacement is positive into the body.

use std::path::Path;

use thiserror::Error;

use super::force::ForcePoint;

/// What a table has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// By depth, smallest first.
    pub force: Vec<ForcePoint>,
    /// By distance, smallest first.
    pub profile: Vec<ProfilePoint>,
}

/// A measured point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// From the middle of the contact along the surface, m.
    pub distance_m: f64,
    /// Into the body, m.
    pub displacement_m: f64,
}

/// Why a table is not accepted, with the line, the value and what is accepted.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}{}: {problem}", line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct TableError {
    /// The file.
    pub file: String,
    /// Counted from 1, where one line is to blame.
    pub line: Option<usize>,
    /// What is wrong, and what is accepted.
    pub problem: String,
}

const COLUMNS: [&str; 4] = ["depth", "force", "distance", "displacement"];
const LENGTHS: [(&str, f64); 5] = [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6)];
const FORCES: [(&str, f64); 3] = [("N", 1.0), ("mN", 1e-3), ("kN", 1e3)];
const ACCEPTED: &str = "accepted: depth [mm],force [N] or distance [mm],displacement [mm] or all four; lengths in m, cm, \
                        mm, um, forces in N, mN, kN";

/// A force may have the wrong sign by this share of the largest one: a sensor's zero is never exact.
const SENSOR_ZERO: f64 = 0.02;

/// A cell with its column's factor.
struct Column {
    /// Index into [`COLUMNS`].
    kind: usize,
    factor: f64,
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// The file cannot be read; the header has an unknown column or unit; a row has a missing cell, one that is no number, or
    /// a depth or distance before the one above it; a force pulls where the depth presses.
    pub fn read(path: &Path) -> Result<Self, TableError> {
        let file = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|cause| TableError {
            file: file.clone(),
            line: None,
            problem: format!("cannot be read: {cause}"),
        })?;
        Self::parse(&file, &String::from_utf8_lossy(&bytes))
    }

    /// Reads the text of a table; `file` stands for it in messages.
    ///
    /// # Errors
    /// As [`Table::read`].
    pub fn parse(file: &str, text: &str) -> Result<Self, TableError> {
        let at =
            |line: usize, problem: String| TableError { file: file.to_owned(), line: Some(line), problem };
        let mut rows = text
            .lines()
            .enumerate()
            .map(|(index, row)| (index + 1, row.trim_start_matches('\u{feff}').trim()))
            .filter(|(_, row)| !row.is_empty() && !row.starts_with('#'));
        let Some((line, header)) = rows.next() else {
            let problem = format!("the table is empty; {ACCEPTED}");
            return Err(TableError { file: file.to_owned(), line: None, problem });
        };
        let columns = columns(header).map_err(|problem| at(line, problem))?;
        let mut table = Self::default();
        let mut force_lines = Vec::new();
        for (line, row) in rows {
            let cells = cells(&columns, row).map_err(|problem| at(line, problem))?;
            if let Some([depth_m, force_n]) = cells.force {
                if let Some(before) = table.force.last().filter(|before| depth_m < before.depth_m) {
                    let before_m = before.depth_m;
                    let problem = format!(
                        "depth {depth_m:?} m comes after {before_m:?} m; accepted: rows sorted by depth, smallest first"
                    );
                    return Err(at(line, problem));
                }
                table.force.push(ForcePoint { depth_m, force_n });
                force_lines.push(line);
            }
            if let Some([distance_m, displacement_m]) = cells.profile {
                if distance_m < 0.0 {
                    return Err(at(line, format!("distance {distance_m:?} m; accepted: 0 or more")));
                }
                if let Some(before) = table.profile.last().filter(|before| distance_m < before.distance_m) {
                    let before_m = before.distance_m;
                    let problem = format!(
                        "distance {distance_m:?} m comes after {before_m:?} m; accepted: rows sorted by distance, smallest \
                         first"
                    );
                    return Err(at(line, problem));
                }
                table.profile.push(ProfilePoint { distance_m, displacement_m });
            }
        }
        table
            .check_signs()
            .map_err(|(row, problem)| at(force_lines.get(row).copied().unwrap_or(line), problem))?;
        Ok(table)
    }

    /// The row of a force that does not oppose its depth.
    fn check_signs(&self) -> Result<(), (usize, String)> {
        let largest_n = self.force.iter().map(|point| point.force_n.abs()).fold(0.0, f64::max);
        let wrong = |point: &ForcePoint| {
            point.force_n * point.depth_m < 0.0 && point.force_n.abs() > SENSOR_ZERO * largest_n
        };
        match self.force.iter().position(wrong) {
            None => Ok(()),
            Some(row) => {
                let ForcePoint { depth_m, force_n } = self.force[row];
                let problem = format!(
                    "force {force_n:?} N at depth {depth_m:?} m has the wrong sign; accepted: the force on the hand, positive \
                     where the depth is positive (pressed), negative where it is negative (pulled)"
                );
                Err((row, problem))
            }
        }
    }
}

fn columns(header: &str) -> Result<Vec<Column>, String> {
    let columns = header.split(',').map(column).collect::<Result<Vec<_>, _>>()?;
    let has = |kind: usize| columns.iter().filter(|column| column.kind == kind).count();
    if let Some(twice) = (0..COLUMNS.len()).find(|kind| has(*kind) > 1) {
        return Err(format!("column {} is there twice; {ACCEPTED}", COLUMNS[twice]));
    }
    for (a, b) in [(0, 1), (1, 0), (2, 3), (3, 2)] {
        if has(a) > has(b) {
            return Err(format!("column {} without {}; {ACCEPTED}", COLUMNS[a], COLUMNS[b]));
        }
    }
    Ok(columns)
}

/// `depth [mm]`: the column and what makes its numbers SI.
fn column(text: &str) -> Result<Column, String> {
    let text = text.trim();
    let (name, unit) = match text.split_once('[') {
        Some((name, unit)) => (name.trim(), unit.trim_end().strip_suffix(']').map(str::trim)),
        None => (text, None),
    };
    let Some(kind) = COLUMNS.iter().position(|known| *known == name) else {
        return Err(format!("column {text:?} is not known; {ACCEPTED}"));
    };
    let Some(unit) = unit else {
        return Err(format!("column {text:?} has no unit in brackets; {ACCEPTED}"));
    };
    let units: &[(&str, f64)] = if kind == 1 { &FORCES } else { &LENGTHS };
    match units.iter().find(|(known, _)| *known == unit) {
        Some((_, factor)) => Ok(Column { kind, factor: *factor }),
        None => Err(format!("unit {unit:?} of {name} is not known; {ACCEPTED}")),
    }
}

/// The numbers of a row, SI; a pair that is left empty is none.
struct Cells {
    force: Option<[f64; 2]>,
    profile: Option<[f64; 2]>,
}

fn cells(columns: &[Column], row: &str) -> Result<Cells, String> {
    let cells: Vec<&str> = row.split(',').map(str::trim).collect();
    if cells.len() != columns.len() {
        let (found, expected) = (cells.len(), columns.len());
        return Err(format!("{found} cells; accepted: {expected}, one for each column of the header"));
    }
    let mut values = [None; 4];
    for (cell, column) in cells.iter().zip(columns) {
        if cell.is_empty() {
            continue;
        }
        let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
        let Some(number) = number else {
            return Err(format!(
                "{} = {cell:?} is not a number; accepted: a finite number",
                COLUMNS[column.kind]
            ));
        };
        values[column.kind] = Some(number * column.factor);
    }
    let pair = |a: usize| match (values[a], values[a + 1]) {
        (Some(first), Some(second)) => Ok(Some([first, second])),
        (None, None) => Ok(None),
        (first, _) => {
            let missing = COLUMNS[if first.is_none() { a } else { a + 1 }];
            Err(format!("{missing} is missing; accepted: a number in every cell, or a pair that is empty"))
        }
    };
    let cells = Cells { force: pair(0)?, profile: pair(2)? };
    if cells.force.is_none() && cells.profile.is_none() {
        let all: Vec<&str> = columns.iter().map(|column| COLUMNS[column.kind]).collect();
        return Err(format!("{} are missing; accepted: a number in every cell", all.join(" and ")));
    }
    Ok(cells)
}
