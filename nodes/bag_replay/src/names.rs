//! Names: of topics in a namespace, and of recordings.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use anyhow::bail;

/// `name` as the graph knows it: relative names stand in the node's namespace.
pub(crate) fn absolute(namespace: &str, name: &str) -> String {
    if name.starts_with('/') {
        name.to_owned()
    } else {
        format!("{}/{name}", namespace.trim_end_matches('/'))
    }
}

/// The absolute name that a parameter means.
///
/// # Errors
/// ROS would not accept the name; `key` is the parameter.
pub(crate) fn topic(namespace: &str, name: &str, key: &str) -> anyhow::Result<String> {
    let name = absolute(namespace, name);
    if is_topic(&name) {
        return Ok(name);
    }
    bail!("{key}: {name:?} is not the name of a topic; accepted: letters, digits and '_' behind each '/'")
}

/// Whether an absolute name is one that ROS accepts for a topic: words of letters, digits and `_` behind a `/` each.
fn is_topic(name: &str) -> bool {
    let is_word = |word: &str| {
        word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    name.strip_prefix('/').is_some_and(|words| words.split('/').all(is_word))
}

/// Name of a recording that got none: namespace, date and time of day (UTC), so that two sessions side by side and two
/// sessions after each other differ.
pub(crate) fn by_time(namespace: &str, now: SystemTime) -> String {
    let since_epoch = now.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs();
    let (days, second) = (since_epoch / 86_400, since_epoch % 86_400);
    let (year, month, day) = date(days);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    let time = format!("{year:04}-{month:02}-{day:02}_{hour:02}-{minute:02}-{second:02}");
    let namespace = namespace.trim_matches('/').replace('/', "_");
    if namespace.is_empty() { time } else { format!("{namespace}_{time}") }
}

/// Year, month and day of a number of days since 1970 in the Gregorian calendar. Years are counted from March, so that
/// the leap day comes last.
fn date(days: u64) -> (u64, u64, u64) {
    const DAYS_OF_400_YEARS: u64 = 146_097;
    // From 0000-03-01.
    let days = days + 719_468;
    let era = days / DAYS_OF_400_YEARS;
    let day_of_era = days % DAYS_OF_400_YEARS;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    (era * 400 + year_of_era + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_names_stand_in_the_namespace_and_absolute_ones_do_not() {
        assert_eq!(absolute("/", "measured_cp"), "/measured_cp");
        assert_eq!(absolute("/left", "gripper/measured_js"), "/left/gripper/measured_js");
        assert_eq!(absolute("/left", "/tf"), "/tf");
    }

    #[test]
    fn a_topic_is_words_behind_slashes() {
        for name in ["/tf", "/left/measured_cp", "/_hidden/a1"] {
            assert!(is_topic(name), "{name:?}");
        }
        for name in ["tf", "/", "/a/", "//a", "/1a", "/white space", "/~/a", "/a-b"] {
            assert!(!is_topic(name), "{name:?}");
        }
    }

    #[test]
    fn dates_agree_with_the_calendar() {
        let name = |seconds| by_time("/", UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(name(0), "1970-01-01_00-00-00");
        assert_eq!(name(951_782_399), "2000-02-28_23-59-59");
        assert_eq!(name(951_782_400), "2000-02-29_00-00-00");
        assert_eq!(name(951_868_800), "2000-03-01_00-00-00");
        assert_eq!(name(1_735_689_599), "2024-12-31_23-59-59");
        assert_eq!(name(1_735_689_600), "2025-01-01_00-00-00");
        assert_eq!(by_time("/or/left", UNIX_EPOCH), "or_left_1970-01-01_00-00-00");
    }
}
