//! What the names of files say of the parts of a recording: rosbag2 calls them NAME_0.mcap, NAME_1.mcap and so on.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use crate::storage::COMPRESSED;

/// Recordings that an error names; it counts the others.
const MOST_NAMED: usize = 10;

/// What the parts of one recording have in common: the name up to the number, and the storage.
pub(crate) type Series = (Vec<u8>, Option<OsString>);

/// The series and the number of a file; a file without a number is a series of its own.
pub(crate) fn part(file: &Path) -> (Series, Option<u64>) {
    let plain = plain(file);
    let stem = plain.file_stem().unwrap_or_default().as_bytes();
    let storage = plain.extension().map(OsString::from);
    let before = stem.iter().rposition(|byte| *byte == b'_').map(|last| last + 1).unwrap_or_default();
    let (name, digits) = stem.split_at(before);
    match number(digits).filter(|_| !name.is_empty()) {
        Some(number) => ((name.to_owned(), storage), Some(number)),
        None => ((stem.to_owned(), storage), None),
    }
}

/// Without the ending of a file that is compressed as a whole.
pub(crate) fn plain(file: &Path) -> PathBuf {
    let is_compressed = file.extension().is_some_and(|extension| extension == COMPRESSED);
    if is_compressed { file.with_extension("") } else { file.to_owned() }
}

/// As rosbag2 writes them: a time of day such as 08 is none.
fn number(digits: &[u8]) -> Option<u64> {
    let has_zeros_in_front = digits.len() > 1 && digits.first() == Some(&b'0');
    let is_number = digits.iter().all(u8::is_ascii_digit) && !has_zeros_in_front;
    std::str::from_utf8(digits).ok().filter(|_| is_number)?.parse().ok()
}

/// The series that are among `files`, each by its first and last file; `None` where there are not several.
pub(crate) fn several(files: &[PathBuf]) -> Option<String> {
    let mut found: BTreeMap<Series, (&PathBuf, &PathBuf)> = BTreeMap::new();
    for file in files {
        found.entry(part(file).0).or_insert((file, file)).1 = file;
    }
    let name = |file: &Path| file.file_name().unwrap_or_default().display().to_string();
    let mut said: Vec<_> = found
        .values()
        .take(MOST_NAMED)
        .map(|(first, last)| match first == last {
            true => name(first),
            false => format!("{} to {}", name(first), name(last)),
        })
        .collect();
    if let Some(more) = found.len().checked_sub(MOST_NAMED).filter(|more| *more > 0) {
        said.push(format!("and {more} more"));
    }
    (found.len() > 1).then(|| said.join("; "))
}

/// The parts that are missing between `files` of one series, a sentence for each hole. The series begins with `first`, or
/// with the first that is there.
pub(crate) fn holes(files: &[PathBuf], first: Option<u64>) -> Vec<String> {
    let numbered: BTreeMap<u64, &PathBuf> =
        files.iter().filter_map(|file| Some((part(file).1?, file))).collect();
    let mut sentences = Vec::new();
    let mut next = first.or_else(|| numbered.keys().next().copied());
    for (number, file) in numbered {
        if let Some(missing) = next.filter(|next| *next < number) {
            let (from, to) = (named(file, missing), named(file, number - 1));
            let there = file.file_name().unwrap_or_default().display();
            sentences.push(match from == to {
                true => format!("{from} is not there, and {there} is: a part of the recording is missing"),
                false => format!(
                    "{from} to {to} are not there, and {there} is: {} parts of the recording are missing",
                    number - missing
                ),
            });
        }
        next = number.checked_add(1);
    }
    sentences
}

/// The name of a part by that of another one.
fn named(other: &Path, number: u64) -> String {
    let ((name, storage), _) = part(other);
    let (name, storage) = (String::from_utf8_lossy(&name), storage.unwrap_or_default());
    format!("{name}{number}.{}", storage.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_a_number_behind_the_last_underscore() {
        let numbers = ["a_0.mcap", "b/a_12.mcap.zstd", "a_1_2.db3", "a.mcap", "a0.mcap", "_3.mcap"];
        let numbers = numbers.map(|name| part(Path::new(name)).1);
        assert_eq!(numbers, [Some(0), Some(12), Some(2), None, None, Some(3)]);
        let none = ["08", "", "x", "+1", "99999999999999999999"];
        assert!(none.iter().all(|digits| number(digits.as_bytes()).is_none()));
    }

    #[test]
    fn a_series_has_one_name_and_one_storage() {
        let series = |name: &str| part(Path::new(name)).0;
        assert_eq!(series("a_0.mcap"), series("a_11.mcap.zstd"));
        for other in ["b_0.mcap", "a_0.db3", "a.mcap", "a_00.mcap"] {
            assert_ne!(series("a_0.mcap"), series(other), "{other}");
        }
    }

    #[test]
    fn the_last_number_there_is_has_no_next_one() {
        let last = PathBuf::from(format!("a_{}.mcap", u64::MAX));
        assert_eq!(holes(&[last], Some(0)).len(), 1);
    }
}
