//! The first usable SDK among the places where it may be. Not RT safe.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::sdk::{Sdk, Unusable};
use super::search::{Candidate, Place, places};
use crate::DeviceError;

/// What to do about a missing or unusable library.
const REMEDY: &str = "install the Force Dimension SDK 3.16 or newer (3.x) from forcedimension.com/software/sdk, then set \
                      force_dimension.sdk or FORCEDIM_SDK to its folder";

/// Libraries that this process has loaded.
static LOADED: Mutex<Vec<&'static Sdk>> = Mutex::new(Vec::new());

/// The first library in the order of [`places`]; one that is found but not usable ends the search. `sdk` is the
/// parameter `force_dimension.sdk`.
pub(super) fn load(sdk: &Path) -> Result<&'static Sdk, DeviceError> {
    load_from(&places(sdk, |name| std::env::var_os(name)))
}

fn load_from(places: &[Place]) -> Result<&'static Sdk, DeviceError> {
    let unusable = |what: String| DeviceError::Library { what, remedy: REMEDY.to_owned() };
    let mut loaded = LOADED.lock().unwrap_or_else(PoisonError::into_inner);
    let mut looked = Vec::new();
    for place in places {
        let mut found = "not there".to_owned();
        for Candidate { path, is_drd } in place.candidates() {
            if let Some(&sdk) = loaded.iter().find(|sdk| sdk.path() == path) {
                return Ok(sdk);
            }
            match Sdk::of(path.clone(), is_drd) {
                Ok(sdk) => {
                    let sdk: &'static Sdk = Box::leak(Box::new(sdk));
                    loaded.push(sdk);
                    return Ok(sdk);
                }
                Err(Unusable::Refused(what)) => return Err(unusable(what)),
                // The loader's words for a name that it does not find say no more than that.
                Err(Unusable::NotLoaded(_)) if *place == Place::Loader => {}
                Err(Unusable::NotLoaded(why)) => {
                    found = format!("{} cannot be loaded: {why}", path.display())
                }
            }
        }
        looked.push(format!("{place}: {found}"));
    }
    Err(unusable(format!(
        "no Force Dimension SDK (libdrd.so.3 or libdhd.so.3); looked in {}",
        looked.join("; ")
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn folder(path: &Path) -> Vec<Place> {
        vec![Place::Folder { path: path.to_path_buf(), why: "force_dimension.sdk" }]
    }

    fn refusal(places: &[Place]) -> String {
        load_from(places).err().expect("no usable library").to_string()
    }

    #[test]
    fn every_place_looked_at_is_named_and_how_to_get_the_sdk() {
        let empty = tempfile::tempdir().unwrap();
        let mut places = folder(empty.path());
        places.push(Place::Folder { path: PathBuf::from("/nowhere"), why: "FDSDK" });
        let text = refusal(&places);
        let here = format!("{} (from force_dimension.sdk): not there", empty.path().display());
        for part in [here.as_str(), "/nowhere (from FDSDK): not there", "libdrd.so.3", "forcedimension.com"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }

    #[test]
    fn a_file_that_is_no_library_says_what_the_loader_says() {
        let path = tempfile::tempdir().unwrap();
        std::fs::write(path.path().join("libdrd.so.3"), "text").unwrap();
        let text = refusal(&folder(path.path()));
        assert!(text.contains("libdrd.so.3 cannot be loaded"), "{text}");
    }
}
