//! Error of the calibrated liver over the number of chains, harmonics, body modes and calibration sites.
//!
//! The numbers are measured when the bodies are made, since each needs a calibration of its own: `bodies/curves.csv`.

use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};

use super::from_zero;
use crate::report::figure::{Axis, Figure, Marker, Series};
use crate::report::section::Exhibit;
use crate::report::table::{Cell, Table};

const COLUMNS: [&str; 8] =
    ["sites", "chains", "harmonics", "modes", "median_field", "worst_field", "median_near", "worst_near"];

/// What is varied: a column and how it is shown.
const VARIED: [(&str, &str, &str); 4] = [
    ("calibrated_sites", "Error against the number of calibration sites", "calibration sites"),
    ("calibrated_chains", "Error against the number of chains", "chains"),
    ("calibrated_harmonics", "Error against the number of harmonics", "harmonics"),
    ("calibrated_modes", "Error against the number of body modes", "body modes"),
];

/// One calibration of the liver.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    /// Sites, chains, harmonics, modes.
    sizes: [usize; 4],
    /// Whole field, median and worst; near field, median and worst; shares.
    errors: [f64; 4],
}

/// One exhibit for each number that is varied.
pub(super) fn all(reference: &Path) -> Result<Vec<Exhibit>> {
    let path = reference.join("bodies").join("curves.csv");
    ensure!(
        path.is_file(),
        "{} is missing; make it with: python tests/reference/curves.py, which runs rhombus calibrate --body for each row",
        path.display()
    );
    let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let rows = parse(&text).with_context(|| path.display().to_string())?;
    Ok((0..VARIED.len()).map(|varied| exhibit(varied, &rows)).collect())
}

fn parse(text: &str) -> Result<Vec<Row>> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let (_, head) = lines.next().context("empty; accepted: a heading and one row for each calibration")?;
    let head: Vec<&str> = head.split(',').map(str::trim).collect();
    ensure!(head == COLUMNS, "line 1 is {}; accepted: {}", head.join(","), COLUMNS.join(","));
    let mut rows = Vec::new();
    for (line, text) in lines {
        let cells: Vec<&str> = text.split(',').map(str::trim).collect();
        ensure!(
            cells.len() == COLUMNS.len(),
            "line {}: {} cells; accepted: {}",
            line + 1,
            cells.len(),
            COLUMNS.len()
        );
        let refused = |column: usize, accepted: &str| {
            format!("line {}: {} is {}; accepted: {accepted}", line + 1, COLUMNS[column], cells[column])
        };
        let mut row = Row { sizes: [0; 4], errors: [0.0; 4] };
        for (column, size) in row.sizes.iter_mut().enumerate() {
            *size = cells[column].parse().ok().with_context(|| refused(column, "a whole number"))?;
        }
        for (column, error) in (4..).zip(&mut row.errors) {
            let found = cells[column].parse().ok().filter(|share: &f64| share.is_finite() && *share >= 0.0);
            *error = found.with_context(|| refused(column, "a share of 1, 0 or more"))?;
        }
        rows.push(row);
    }
    if rows.is_empty() {
        bail!("no rows; accepted: one for each calibration");
    }
    Ok(rows)
}

/// Of the rows that differ in `varied` alone, the longest series; of equally long ones that with the largest other numbers.
fn curve(varied: usize, rows: &[Row]) -> Vec<Row> {
    let others = |row: &Row| {
        let mut sizes = row.sizes;
        sizes[varied] = 0;
        sizes
    };
    let of = |key: [usize; 4]| {
        let mut own: Vec<Row> = rows.iter().copied().filter(|row| others(row) == key).collect();
        own.sort_by_key(|row| row.sizes[varied]);
        own.dedup_by_key(|row| row.sizes[varied]);
        own
    };
    let longest = rows.iter().map(others).max_by_key(|key| (of(*key).len(), *key));
    longest.map(of).unwrap_or_default()
}

fn exhibit(varied: usize, rows: &[Row]) -> Exhibit {
    let (name, title, axis) = VARIED[varied];
    let rows = curve(varied, rows);
    let errors =
        ["whole surface, median", "whole surface, worst", "within 30 mm, median", "within 30 mm, worst"];
    let sizes = VARIED.map(|(_, _, words)| (words, ""));
    let mut table = Table::new(sizes.into_iter().chain(errors.map(|error| (error, "%"))));
    for row in &rows {
        let numbers = row.errors.map(|share| Cell::from(100.0 * share));
        table.push(row.sizes.into_iter().map(Cell::from).chain(numbers));
    }
    let curves = errors.into_iter().enumerate().map(|(which, words)| {
        let curve = rows.iter().map(|row| (row.sizes[varied] as f64, 100.0 * row.errors[which]));
        let line = Series::line(words, which / 2, curve);
        if which % 2 == 0 { line.marked(Marker::Circle) } else { line.dashed().marked(Marker::Ring) }
    });
    let series: Vec<Series> = curves.collect();
    // Counts are whole.
    let across =
        rows.first().zip(rows.last()).map_or(0, |(low, high)| high.sizes[varied] - low.sizes[varied]);
    let fixed = (0..VARIED.len()).filter(|place| *place != varied);
    let fixed = fixed.filter_map(|place| Some(format!("{} {}", rows.first()?.sizes[place], VARIED[place].2)));
    Exhibit {
        name,
        title: title.to_owned(),
        caption: format!(
            "The liver with {}, at the held-out sites; measured when the bodies were made.",
            fixed.collect::<Vec<_>>().join(", ")
        ),
        figure: Some(Figure {
            x: Axis::linear(axis).divided((1.1 * across as f64).clamp(1.1, 8.0)),
            y: from_zero("relative L2 error [%]", &series),
            series,
        }),
        table,
        raw: None,
    }
}

#[cfg(test)]
mod tests {
    use super::{COLUMNS, curve, parse};

    fn text(rows: &[&str]) -> String {
        [&[COLUMNS.join(",").as_str()], rows].concat().join("\n")
    }

    #[test]
    fn a_curve_is_the_longest_series_in_which_one_number_varies() {
        let rows = parse(&text(&[
            "80,6,2,24,0.09,0.2,0.07,0.1",
            "40,6,2,24,0.12,0.3,0.09,0.2",
            "20,6,2,24,0.15,0.3,0.09,0.2",
            "80,6,1,24,0.19,0.4,0.11,0.2",
            "80,6,0,24,0.34,0.5,0.17,0.3",
            "80,4,2,24,0.10,0.2,0.08,0.1",
            "20,4,2,24,0.17,0.3,0.09,0.2",
        ]))
        .unwrap();
        let sizes = |varied: usize| -> Vec<usize> {
            curve(varied, &rows).iter().map(|row| row.sizes[varied]).collect()
        };
        assert_eq!(sizes(0), [20, 40, 80]);
        assert_eq!(sizes(1), [4, 6]);
        assert_eq!(sizes(2), [0, 1, 2]);
        assert_eq!(sizes(3), [24]);
        // Of two series of two, the one with more sites.
        assert!(curve(1, &rows).iter().all(|row| row.sizes[0] == 80));
    }

    #[test]
    fn what_is_not_accepted_is_named_with_its_line() {
        for (rows, words) in [
            (text(&[]), "no rows"),
            (String::new(), "empty"),
            ("a,b\n".to_owned(), "line 1 is a,b"),
            (text(&["80,6,2,24,0.09,0.2,0.07"]), "line 2: 7 cells"),
            (text(&["80,six,2,24,0.09,0.2,0.07,0.1"]), "line 2: chains is six"),
            (text(&["80,6,2,24,0.09,NaN,0.07,0.1"]), "line 2: worst_field is NaN"),
        ] {
            let refusal = parse(&rows).unwrap_err().to_string();
            assert!(refusal.contains(words), "{refusal}");
        }
    }
}
