//! Where the Force Dimension SDK may be, in the order in which it is looked for.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Names of the libraries inside a folder, best first. libdrd has everything of libdhd and can home the device.
const NAMES: [&str; 4] = ["libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"];

/// One place in which a library may be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// A folder, with the reason why it is looked into.
    Folder { path: PathBuf, why: &'static str },
    /// The system's loader: LD_LIBRARY_PATH, the loader's cache, /lib and /usr/lib.
    Loader,
}

/// A file or, for the loader, a name to load.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Candidate {
    pub(super) path: PathBuf,
    /// Whether it is libdrd, which must then have the drd functions too.
    pub(super) is_drd: bool,
}

/// Every place, first to last. `sdk` is the parameter `force_dimension.sdk`, `variable` looks up the environment.
pub(super) fn places(sdk: &Path, variable: impl Fn(&str) -> Option<OsString>) -> Vec<Place> {
    let mut places = Vec::new();
    let mut add_sdk = |root: PathBuf, why| {
        let release = root.join("lib").join("release").join(format!("lin-{}-gcc", architecture()));
        places.push(Place::Folder { path: root, why });
        places.push(Place::Folder { path: release, why });
    };
    if !sdk.as_os_str().is_empty() {
        add_sdk(sdk.to_path_buf(), "force_dimension.sdk");
    }
    for name in ["FORCEDIM_SDK", "FDSDK"] {
        if let Some(root) = variable(name).filter(|root| !root.is_empty()) {
            add_sdk(PathBuf::from(root), name);
        }
    }
    if let Some(home) = variable("HOME").filter(|home| !home.is_empty()) {
        places.push(Place::Folder { path: PathBuf::from(home).join(".local/lib"), why: "home" });
    }
    places.push(Place::Folder { path: PathBuf::from("/usr/local/lib"), why: "system" });
    places.push(Place::Loader);
    places
}

impl Place {
    /// What to try to load here: in a folder only files that exist.
    pub(super) fn candidates(&self) -> Vec<Candidate> {
        match self {
            Place::Folder { path, .. } => {
                // The vendor's archive may be unpacked without its symbolic links: libdrd.so.3.17.5 alone is enough.
                let mut versioned: Vec<PathBuf> = std::fs::read_dir(path)
                    .map(|entries| entries.flatten().map(|entry| entry.path()).collect())
                    .unwrap_or_default();
                versioned.retain(|file| {
                    let name = file.file_name().unwrap_or_default().to_string_lossy();
                    name.starts_with("libdrd.so.3.") || name.starts_with("libdhd.so.3.")
                });
                versioned.sort();
                let named = NAMES.iter().map(|name| path.join(name)).filter(|file| file.is_file());
                let mut candidates: Vec<Candidate> =
                    named.chain(versioned.into_iter().rev()).map(Candidate::new).collect();
                candidates.sort_by_key(|candidate| !candidate.is_drd);
                candidates
            }
            Place::Loader => NAMES.iter().map(|name| Candidate::new(PathBuf::from(name))).collect(),
        }
    }
}

impl Candidate {
    fn new(path: PathBuf) -> Candidate {
        let is_drd = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("libdrd"));
        Candidate { path, is_drd }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Folder { path, why: "home" | "system" } => write!(f, "{}", path.display()),
            Place::Folder { path, why } => write!(f, "{} (from {why})", path.display()),
            Place::Loader => f.write_str("the system's loader (LD_LIBRARY_PATH, ldconfig)"),
        }
    }
}

/// The processor's name as the vendor spells it in folder names.
fn architecture() -> &'static str {
    match std::env::consts::ARCH {
        "arm" => "armv7l",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folders(places: &[Place]) -> Vec<String> {
        places.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn the_parameter_comes_before_the_environment_before_the_system() {
        let variable = |name: &str| match name {
            "FORCEDIM_SDK" => Some(OsString::from("/forcedim")),
            "FDSDK" => Some(OsString::from("/fdsdk")),
            "HOME" => Some(OsString::from("/home/someone")),
            _ => None,
        };
        let release = format!("lib/release/lin-{}-gcc", architecture());
        assert_eq!(
            folders(&places(Path::new("/given"), variable)),
            [
                "/given (from force_dimension.sdk)".to_owned(),
                format!("/given/{release} (from force_dimension.sdk)"),
                "/forcedim (from FORCEDIM_SDK)".to_owned(),
                format!("/forcedim/{release} (from FORCEDIM_SDK)"),
                "/fdsdk (from FDSDK)".to_owned(),
                format!("/fdsdk/{release} (from FDSDK)"),
                "/home/someone/.local/lib".to_owned(),
                "/usr/local/lib".to_owned(),
                "the system's loader (LD_LIBRARY_PATH, ldconfig)".to_owned(),
            ]
        );
    }

    #[test]
    fn an_empty_parameter_or_variable_is_no_place() {
        let places = places(Path::new(""), |_| Some(OsString::new()));
        assert_eq!(folders(&places), ["/usr/local/lib", "the system's loader (LD_LIBRARY_PATH, ldconfig)"]);
    }

    #[test]
    fn in_one_folder_libdrd_comes_before_libdhd_and_a_bare_version_is_found() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["libdhd.so.3", "libdhd.so.3.17.5", "libdrd.so.3.16.1", "libdrd.so.3.17.5", "libdrd.txt"]
        {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let place = Place::Folder { path: folder.path().to_path_buf(), why: "home" };
        let found: Vec<_> = place
            .candidates()
            .iter()
            .map(|candidate| {
                (candidate.path.file_name().unwrap().to_str().unwrap().to_owned(), candidate.is_drd)
            })
            .collect();
        let expected = [
            ("libdrd.so.3.17.5", true),
            ("libdrd.so.3.16.1", true),
            ("libdhd.so.3", false),
            ("libdhd.so.3.17.5", false),
        ];
        assert_eq!(found, expected.map(|(name, is_drd)| (name.to_owned(), is_drd)));
    }
}
