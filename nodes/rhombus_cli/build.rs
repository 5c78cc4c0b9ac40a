//! Tells `rhombus report` what it was built from. Without the feature `report` it does nothing.

use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var_os("CARGO_FEATURE_REPORT").is_none() {
        return;
    }
    // Whatever can change the commit, its cleanness or the numbers.
    for path in
        ["../../.git/HEAD", "../../.git/index", "../../.git/refs", "../../Cargo.lock", "..", "../../tests"]
    {
        println!("cargo:rerun-if-changed={path}");
    }
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    if let Some(version) = answer(&rustc, &["--version"]) {
        println!("cargo:rustc-env=RHOMBUS_RUSTC={version}");
    }
    let commit = match (answer("git", &["rev-parse", "HEAD"]), answer("git", &["status", "--porcelain"])) {
        (Some(commit), Some(changes)) if changes.is_empty() => commit,
        (Some(commit), _) => format!("{commit} + uncommitted changes"),
        (None, _) => "unknown: not built in a git checkout".to_owned(),
    };
    println!("cargo:rustc-env=RHOMBUS_COMMIT={commit}");
}

/// What a program prints, if it runs and succeeds.
fn answer(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
