//! The committed recordings are what the committed script makes, byte for byte.

#[path = "../examples/make_bags.rs"]
#[allow(dead_code, unreachable_pub, reason = "its command line is not used here")]
mod make_bags;

use std::path::Path;

#[test]
fn the_script_makes_exactly_the_committed_recordings() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let made = tempfile::tempdir().unwrap();
    make_bags::make(&root, made.path());
    let names = |path: &Path| {
        let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap());
        let mut names: Vec<_> = entries.map(|entry| entry.file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let bags = names(made.path());
    assert_eq!(bags.len(), 6, "{bags:?}");
    for bag in bags {
        let (made, committed) = (made.path().join(&bag), root.join("tests/bags").join(&bag));
        assert_eq!(names(&made), names(&committed), "{bag}");
        for file in names(&made) {
            let is_same =
                std::fs::read(made.join(&file)).unwrap() == std::fs::read(committed.join(&file)).unwrap();
            assert!(is_same, "{bag}/{file} is not what `tests/bags/make` makes");
        }
    }
}
