//! The page as one HTML file that needs nothing else: figures inline, style inline, no script.

use std::collections::BTreeMap;
use std::fmt::Write;

use rhombus_cli::markup::xml as escaped;

use super::page::{Chapter, Page, ROWS_IN_SIGHT};
use super::section::{Exhibit, Outcome};
use super::table::{Cell, Table};

/// The page. `figures` holds the SVG of each exhibit by name.
pub(crate) fn page(page: &Page, figures: &BTreeMap<&str, String>) -> String {
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Rhombus Haptics: error against run time, and stability</title>\n<style>\n{}</style>\n</head>\n<body>\n",
        include_str!("style.css")
    );
    let mut parts = vec![head(page)];
    parts.extend(page.chapters.iter().map(|chapter| chapter_text(chapter, figures)));
    text.push_str(&parts.concat());
    text.push_str("</body>\n</html>\n");
    text
}

fn head(page: &Page) -> String {
    let mut text = "<h1>Error against run time, and stability</h1>\n<dl>\n".to_owned();
    for (name, value) in page.origin.lines() {
        push(&mut text, format_args!("<dt>{name}</dt><dd>{}</dd>\n", escaped(&value)));
    }
    text.push_str("</dl>\n<nav>\n");
    for Chapter { section, .. } in &page.chapters {
        push(&mut text, format_args!("<a href=\"#{}\">{}</a>\n", section.name, escaped(section.title)));
    }
    let [reached, missed, open] = page.counts();
    push(
        &mut text,
        format_args!(
            "</nav>\n<h2 id=\"verdicts\">Asked and measured</h2>\n<p>{reached} reached, {missed} missed, {open} not judged.</p>\n\
             <div class=\"wide\"><table class=\"verdicts\">\n<tr><th>what</th><th>asked</th><th>measured</th><th>verdict</th></tr>\n"
        ),
    );
    for line in page.lines() {
        let class = match line.outcome {
            Outcome::Reached => "reached",
            Outcome::Missed => "missed",
            Outcome::NotJudged => "open",
        };
        push(
            &mut text,
            format_args!(
                "<tr class=\"{class}\"><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                line.section.name,
                escaped(line.ask.what),
                escaped(line.ask.asked),
                escaped(line.measured),
                line.outcome.word()
            ),
        );
    }
    text.push_str("</table></div>\n");
    text
}

fn chapter_text(chapter: &Chapter, figures: &BTreeMap<&str, String>) -> String {
    let section = chapter.section;
    let mut text = format!("<h2 id=\"{}\">{}</h2>\n", section.name, escaped(section.title));
    match &chapter.outcome {
        Err(problem) => {
            push(&mut text, format_args!("<p class=\"problem\">Not computed: {}</p>\n", escaped(problem)))
        }
        Ok(output) => {
            for paragraph in &output.text {
                push(&mut text, format_args!("<p>{}</p>\n", escaped(paragraph)));
            }
            for exhibit in &output.exhibits {
                text.push_str(&exhibit_text(exhibit, figures.get(exhibit.name)));
            }
        }
    }
    push(&mut text, format_args!("<p class=\"links\">Computed in {:.1} s.</p>\n", chapter.seconds));
    text
}

fn exhibit_text(exhibit: &Exhibit, figure: Option<&String>) -> String {
    let mut text = format!("<h3 id=\"{}\">{}</h3>\n<figure>\n", exhibit.name, escaped(&exhibit.title));
    if let Some(svg) = figure {
        push(&mut text, format_args!("<div class=\"wide\">{}</div>\n", scalable(svg)));
    }
    push(
        &mut text,
        format_args!("<figcaption>{}</figcaption>\n</figure>\n", escaped(&exhibit.whole_caption())),
    );
    let shown = table(&exhibit.table);
    if exhibit.table.len() > ROWS_IN_SIGHT {
        push(
            &mut text,
            format_args!(
                "<details><summary>Table, {} rows</summary>\n{shown}</details>\n",
                exhibit.table.len()
            ),
        );
    } else {
        text.push_str(&shown);
    }
    let names = exhibit.svg_name().into_iter().chain(exhibit.data_files().into_iter().map(|(name, _)| name));
    let links: Vec<String> = names.map(|name| format!("<a href=\"{name}\">{name}</a>")).collect();
    push(&mut text, format_args!("<p class=\"links\">{}</p>\n", links.join(" · ")));
    text
}

/// A drawing that takes the width it is given: the view box stays, the size goes.
fn scalable(svg: &str) -> String {
    let size =
        svg.split_once("<svg ").and_then(|(_, rest)| rest.split_once(" viewBox")).map(|(size, _)| size);
    let drawing = size.map_or_else(|| svg.to_owned(), |size| svg.replacen(&format!("{size} "), "", 1));
    drawing.lines().filter(|line| !line.starts_with("<?xml")).collect::<Vec<_>>().join("\n")
}

fn table(table: &Table) -> String {
    let class = |column: usize| {
        let cells = || table.rows().map(|row| &row[column]);
        // Long remarks may be broken; everything else stays on one line.
        let is_long = |cell: &Cell| matches!(cell, Cell::Text(text) if text.len() > 48);
        if cells().any(is_long) {
            " class=\"t\""
        } else if cells().all(|cell: &Cell| cell.is_number() || *cell == Cell::Empty) {
            " class=\"n\""
        } else {
            ""
        }
    };
    let classes: Vec<&str> = (0..table.headings().count()).map(class).collect();
    let mut text = "<div class=\"wide\"><table>\n<tr>".to_owned();
    for (class, heading) in classes.iter().zip(table.headings()) {
        push(&mut text, format_args!("<th{class}>{}</th>", escaped(&heading)));
    }
    text.push_str("</tr>\n");
    for row in table.rows() {
        text.push_str("<tr>");
        for (class, cell) in classes.iter().zip(row) {
            push(&mut text, format_args!("<td{class}>{}</td>", escaped(&cell.shown())));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</table></div>\n");
    text
}

/// Writing to a string cannot fail.
fn push(text: &mut String, more: std::fmt::Arguments) {
    let _ = text.write_fmt(more);
}
