//! Embeds the Python programs of `elasticity/`, and tells `rhombus report` what it was built from.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    embed_programs();
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

/// Makes `PROGRAMS`, name and text of each file of `elasticity/*.py`.
fn embed_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("elasticity");
    println!("cargo:rerun-if-changed={}", folder.display());
    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut programs: Vec<_> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "py"))
        .collect();
    programs.sort();
    let mut text =
        "/// The Python programs: file name and text.\nconst PROGRAMS: &[(&str, &str)] = &[\n".to_owned();
    for path in &programs {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // Writing to a String does not fail.
        let _ = writeln!(text, "    ({name:?}, include_str!({:?})),", path.display().to_string());
    }
    text.push_str("];\n");
    let out = std::env::var_os("OUT_DIR").unwrap_or_default();
    if let Err(error) = std::fs::write(Path::new(&out).join("elasticity.rs"), text) {
        println!("cargo:error=the Python programs cannot be embedded: {error}");
    }
}

/// What a program prints, if it runs and succeeds.
fn answer(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
