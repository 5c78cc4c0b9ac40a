//! A table: the same numbers on the page (three or four digits) and in a CSV file (all digits).

use std::fmt::Write;

/// Rows of cells under named columns. Every row has one cell for each column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    name: String,
    unit: &'static str,
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// A number in the column's unit.
    Number(f64),
    /// A count, shown with all digits.
    Count(u64),
    /// A word or a remark.
    Text(String),
    /// Does not apply.
    Empty,
}

impl Table {
    /// A table without rows. Columns are (name, unit); a unit may be empty.
    pub(crate) fn new<'a>(columns: impl IntoIterator<Item = (&'a str, &'static str)>) -> Self {
        let columns =
            columns.into_iter().map(|(name, unit)| Column { name: name.to_owned(), unit }).collect();
        Self { columns, rows: Vec::new() }
    }

    /// Adds a row; missing cells at its end are empty, surplus ones are dropped.
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        let mut row: Vec<Cell> = row.into_iter().collect();
        row.resize(self.columns.len(), Cell::Empty);
        self.rows.push(row);
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Headings: name and, in brackets, unit.
    pub(crate) fn headings(&self) -> impl Iterator<Item = String> + '_ {
        self.columns.iter().map(|Column { name, unit }| match *unit {
            "" => name.clone(),
            unit => format!("{name} [{unit}]"),
        })
    }

    /// The rows.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[Cell]> {
        self.rows.iter().map(Vec::as_slice)
    }

    /// As CSV (RFC 4180, one header line); every number reads back to the same bits.
    pub(crate) fn csv(&self) -> String {
        let mut text = String::new();
        let mut line = |cells: &mut dyn Iterator<Item = String>| {
            text.push_str(&cells.collect::<Vec<_>>().join(","));
            text.push('\n');
        };
        line(&mut self.headings().map(|heading| quoted(&heading)));
        for row in &self.rows {
            line(&mut row.iter().map(Cell::exact));
        }
        text
    }
}

impl Cell {
    /// A number, or empty when there is none.
    pub(crate) fn maybe(number: Option<f64>) -> Self {
        number.map_or(Cell::Empty, Cell::Number)
    }

    /// As a person reads it.
    pub(crate) fn shown(&self) -> String {
        match self {
            Cell::Number(number) => readable(*number),
            Cell::Count(count) => count.to_string(),
            Cell::Text(text) => text.clone(),
            Cell::Empty => String::new(),
        }
    }

    /// As a program reads it.
    fn exact(&self) -> String {
        match self {
            Cell::Number(number) => format!("{number:?}"),
            Cell::Count(count) => count.to_string(),
            Cell::Text(text) => quoted(text),
            Cell::Empty => String::new(),
        }
    }

    /// Whether it is set flush right.
    pub(crate) fn is_number(&self) -> bool {
        matches!(self, Cell::Number(_) | Cell::Count(_))
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Cell::Number(number)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Cell::Count(count as u64)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Cell::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Cell::Text(text)
    }
}

/// Three significant digits; plain between 0.001 and a million, otherwise with an exponent.
pub(crate) fn readable(number: f64) -> String {
    let size = number.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !size.is_finite() {
        return number.to_string();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{number:.2e}");
    }
    let decimals = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write!(text, "{number:.decimals$}");
    text
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::{Cell, Table, readable};

    #[test]
    fn csv_numbers_read_back_to_the_same_bits() {
        let mut table = Table::new([("force", "N"), ("who", "")]);
        let numbers = [1.0 / 3.0, 1e-300, -0.0, 123_456_789.123_456_79, 5e-324, f64::MAX];
        for number in numbers {
            table.push([Cell::Number(number), "a, \"b\"".into()]);
        }
        let csv = table.csv();
        let mut lines = csv.lines();
        assert_eq!(lines.next(), Some("force [N],who"));
        for (line, number) in lines.zip(numbers) {
            let (first, rest) = line.split_once(',').unwrap();
            assert_eq!(first.parse::<f64>().unwrap().to_bits(), number.to_bits(), "{line}");
            assert_eq!(rest, "\"a, \"\"b\"\"\"");
        }
    }

    #[test]
    fn people_get_three_digits() {
        for (number, text) in [
            (0.0, "0"),
            (0.123_45, "0.123"),
            (12.345, "12.3"),
            (123.45, "123"),
            (123_456.0, "123456"),
            (-0.5, "-0.500"),
            (1e-9, "1.00e-9"),
            (2.5e9, "2.50e9"),
        ] {
            assert_eq!(readable(number), text);
        }
    }
}
