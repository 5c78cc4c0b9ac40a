//! `rhombus report`: a folder that is whole or not there, and a page whose numbers are its files' numbers.
#![expect(clippy::unwrap_used, reason = "a test may fail here")]

mod common;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::Folder;

const HALF_SPACE: [&str; 5] = ["report", "--out", "out", "--only", "half_space"];

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A report of the half-space alone.
fn half_space() -> Folder {
    let folder = Folder::new();
    let run = folder.run(&HALF_SPACE);
    assert_eq!(run.code, 0, "{}", run.stderr);
    folder
}

fn read(folder: &Folder, name: &str) -> String {
    std::fs::read_to_string(folder.path("out").join(name)).unwrap()
}

/// What stands between two marks, every time.
fn between<'a>(text: &'a str, open: &'a str, close: &'a str) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split(close).next())
}

#[test]
fn the_page_needs_nothing_from_outside_and_every_link_leads_somewhere() {
    let folder = half_space();
    let html = read(&folder, "index.html");
    for outside in ["http:", "https:", "//cdn", "<script", "<link", "@import", "src="] {
        let found = html.replace("http://www.w3.org/2000/svg", "").contains(outside);
        assert!(!found, "{outside} in index.html");
    }
    assert!(html.contains("<svg") && html.contains("prefers-color-scheme: dark"));
    let files = names(&folder.path("out"));
    for link in between(&html, "href=\"", "\"") {
        match link.strip_prefix('#') {
            Some(anchor) => assert!(html.contains(&format!("id=\"{anchor}\"")), "{link}"),
            None => assert!(files.iter().any(|file| file == link), "{link} is not in {files:?}"),
        }
    }
    let markdown = read(&folder, "report.md");
    let links: Vec<&str> = between(&markdown, "](", ")").collect();
    assert!(links.len() >= 6, "{links:?}");
    for link in links {
        assert!(files.iter().any(|file| file == link), "{link} is not in {files:?}");
    }
}

#[test]
fn the_table_on_the_page_shows_the_numbers_of_the_csv_file() {
    let folder = half_space();
    let csv = read(&folder, "half_space_error.csv");
    let html = read(&folder, "index.html");
    let (_, after) = html.split_once("id=\"half_space_error\"").unwrap();
    let table = between(after, "<table>", "</table>").next().unwrap();
    let rows = between(table, "<tr>", "</tr>").skip(1);
    let shown: Vec<Vec<&str>> = rows.map(|row| row.split("</td>").collect()).collect();
    let exact: Vec<Vec<&str>> = csv.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!(shown.len(), 5);
    assert_eq!(shown.len(), exact.len());
    for (shown, exact) in shown.iter().zip(&exact) {
        // Behind the last </td> there is nothing.
        assert_eq!(shown.len(), exact.len() + 1);
        for (shown, exact) in shown.iter().zip(exact) {
            let shown = shown.rsplit('>').next().unwrap();
            match (shown.parse::<f64>(), exact.parse::<f64>()) {
                (Ok(shown), Ok(exact)) => {
                    assert!((shown - exact).abs() <= 0.005 * exact.abs(), "{shown} {exact}")
                }
                _ => assert_eq!(shown, *exact),
            }
        }
    }
    let points = read(&folder, "half_space_error.points.csv");
    for row in &exact {
        let drawn = format!("model,{:?},{},", row[0].parse::<f64>().unwrap(), row[1]);
        assert!(points.contains(&drawn), "{drawn} is plotted");
    }
}

#[test]
fn one_to_four_chains_reach_what_is_asked_of_the_flat_punch() {
    let markdown = read(&half_space(), "report.md");
    let verdicts: Vec<&str> = markdown.lines().filter(|line| line.contains("| flat punch")).collect();
    assert_eq!(verdicts.len(), 4);
    assert!(verdicts.iter().all(|line| line.ends_with("| reached |")), "{verdicts:?}");
    for word in ["mode: quick", "commit: ", "compiler: rustc", "machine: ", "date: "] {
        assert!(markdown.contains(word), "{word}");
    }
}

#[test]
fn an_existing_folder_is_refused_and_force_replaces_reports_only() {
    let folder = half_space();
    let marked = folder.path("out").join("mine.txt");
    std::fs::write(&marked, "kept").unwrap();
    let refusal = folder.refusal(&HALF_SPACE);
    assert!(refusal.contains("out exists; --force"), "{refusal}");
    assert_eq!(std::fs::read_to_string(&marked).unwrap(), "kept");

    let forced = folder.run(&[&HALF_SPACE[..], &["--force"]].concat());
    assert_eq!(forced.code, 0, "{}", forced.stderr);
    assert!(!marked.exists() && folder.path("out").join("index.html").exists());
    assert_eq!(names(&folder.path(".")), ["out"]);

    std::fs::create_dir(folder.path("photos")).unwrap();
    let refusal = folder.refusal(&["report", "--out", "photos", "--force", "--only", "half_space"]);
    assert!(refusal.contains("is not a report"), "{refusal}");
    assert!(folder.path("photos").is_dir());
}

#[test]
fn a_missing_reference_is_named_with_the_command_that_makes_it() {
    let folder = Folder::new();
    let arguments = ["report", "--out", "out", "--only", "liver", "half_space", "--reference", "nowhere"];
    let run = folder.run(&arguments);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let markdown = read(&folder, "report.md");
    for words in ["nowhere/results/liver", "liver.py sites", "not judged", "flat punch, 1 chain"] {
        assert!(markdown.replace('\\', "").contains(words), "{words}: {markdown}");
    }
}

#[test]
fn a_missing_calibrated_body_is_named_with_the_command_that_makes_it() {
    let folder = Folder::new();
    let run = folder.run(&["report", "--out", "out", "--only", "calibrated", "--reference", "nowhere"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let markdown = read(&folder, "report.md").replace('\\', "");
    for words in ["nowhere/bodies/liver.body is missing", "rhombus calibrate --body MESH"] {
        assert!(markdown.contains(words), "{words}: {markdown}");
    }
    // Every demand is there all the same.
    let open =
        markdown.lines().filter(|line| line.contains("calibrated liver") && line.contains("not judged"));
    assert!(open.count() >= 6, "{markdown}");
}

#[test]
fn the_command_line_is_checked_before_anything_is_computed() {
    let folder = Folder::new();
    let refusal = folder.refusal(&["report", "--out", "out", "--only", "weather"]);
    assert!(refusal.contains("weather") && refusal.contains("half_space"), "{refusal}");
    assert!(folder.refusal(&["report", "--out", "out", "--quick", "--full"]).contains("--full"));
    assert!(folder.refusal(&["report"]).contains("--out"));
    assert!(folder.refusal(&["report", "--out", "no/such/out"]).contains("no/such"));
    assert!(names(&folder.path(".")).is_empty());
}

#[test]
fn an_interrupted_run_leaves_nothing_and_keeps_the_old_report() {
    let folder = half_space();
    let before = read(&folder, "index.html");
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let mut run = folder
            .command(&["report", "--out", "out", "--force", "--full", "--only", "stability_map"])
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let patience = Instant::now();
        while names(&folder.path(".")).len() < 2 {
            assert!(patience.elapsed() < Duration::from_secs(60), "no unfinished folder");
            std::thread::sleep(Duration::from_millis(20));
        }
        let sent = Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap();
        assert!(sent.success());
        assert_eq!(run.wait().unwrap().code(), Some(code));
        assert_eq!(names(&folder.path(".")), ["out"]);
    }
    assert_eq!(read(&folder, "index.html"), before);
}
