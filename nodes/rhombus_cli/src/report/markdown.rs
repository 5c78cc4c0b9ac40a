//! The page as Markdown, with the figures as files beside it.

use std::fmt::Write;

use rhombus_cli::markup::markdown as escaped;

use super::page::{Chapter, Page, ROWS_IN_SIGHT};
use super::section::Exhibit;
use super::table::Table;

/// The page.
pub(crate) fn page(page: &Page) -> String {
    let mut text = "# Error against run time, and stability\n\n".to_owned();
    for (name, value) in page.origin.lines() {
        push(&mut text, format_args!("- {name}: {}\n", escaped(&value)));
    }
    let [reached, missed, open] = page.counts();
    push(
        &mut text,
        format_args!(
            "\n## Asked and measured\n\n{reached} reached, {missed} missed, {open} not judged.\n\n\
             | what | asked | measured | verdict |\n|---|---|---|---|\n"
        ),
    );
    for line in page.lines() {
        let cells = [line.ask.what, line.ask.asked, line.measured, line.outcome.word()].map(escaped);
        push(&mut text, format_args!("| {} |\n", cells.join(" | ")));
    }
    for chapter in &page.chapters {
        text.push_str(&chapter_text(chapter));
    }
    text
}

fn chapter_text(chapter: &Chapter) -> String {
    let mut text = format!("\n## {}\n", escaped(chapter.section.title));
    match &chapter.outcome {
        Err(problem) => push(&mut text, format_args!("\n**Not computed:** {}\n", escaped(problem))),
        Ok(output) => {
            for paragraph in &output.text {
                push(&mut text, format_args!("\n{}\n", escaped(paragraph)));
            }
            for exhibit in &output.exhibits {
                exhibit_text(&mut text, exhibit);
            }
        }
    }
    text
}

fn exhibit_text(text: &mut String, exhibit: &Exhibit) {
    let title = escaped(&exhibit.title);
    push(text, format_args!("\n### {title}\n\n"));
    if let Some(svg) = exhibit.svg_name() {
        push(text, format_args!("![{title}]({svg})\n\n"));
    }
    push(text, format_args!("{}\n\n", escaped(&exhibit.whole_caption())));
    if exhibit.table.len() > ROWS_IN_SIGHT {
        push(
            text,
            format_args!("Table: {} rows in [{1}.csv]({1}.csv).\n", exhibit.table.len(), exhibit.name),
        );
    } else {
        table_text(text, &exhibit.table);
    }
    let links: Vec<String> =
        exhibit.data_files().into_iter().map(|(name, _)| format!("[{name}]({name})")).collect();
    push(text, format_args!("\n{}\n", links.join(", ")));
}

fn table_text(text: &mut String, table: &Table) {
    let headings: Vec<String> = table.headings().map(|heading| escaped(&heading)).collect();
    push(text, format_args!("| {} |\n|{}\n", headings.join(" | "), "---|".repeat(headings.len())));
    for row in table.rows() {
        let cells: Vec<String> = row.iter().map(|cell| escaped(&cell.shown())).collect();
        push(text, format_args!("| {} |\n", cells.join(" | ")));
    }
}

/// Writing to a string cannot fail.
fn push(text: &mut String, more: std::fmt::Arguments) {
    let _ = text.write_fmt(more);
}
