//! Writes the corpus that fuzzing starts from: `write_scene_fuzz_corpus nodes/scene/fuzz/corpus`. The same files each time.

use std::path::Path;

use rhombus_chain::ResponseParts;
use scene::{ChainShape, RegionError, ResponseFile, ResponseHeader};

const VERTICES: usize = 4;
const CHECKSUM_BYTES: usize = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corpus = std::env::args().nth(1).ok_or("usage: write_scene_fuzz_corpus DIRECTORY")?;
    let directory = Path::new(&corpus).join("response");
    std::fs::create_dir_all(&directory)?;
    for (name, chains, harmonics, modes) in [("plain", 1, 0, 0), ("directional", 2, 2, 3)] {
        let bytes = file(chains, harmonics, modes).to_bytes()?;
        std::fs::write(directory.join(name), &bytes)?;
        // The target adds the checksum of whatever it was given.
        let unsigned = bytes.get(..bytes.len() - CHECKSUM_BYTES).unwrap_or_default();
        std::fs::write(directory.join(format!("{name}_unsigned")), unsigned)?;
    }
    Ok(())
}

fn file(chains: usize, harmonics: usize, modes: usize) -> ResponseFile {
    let mut chain = vec![0.0; 2 + 6 * harmonics];
    if let Some(share) = chain.first_mut() {
        *share = 1.0 / chains as f32;
    }
    let parts = ResponseParts {
        chains,
        harmonics,
        modes,
        coefficients: chain.repeat(chains * VERTICES),
        amplitudes: vec![0.5; modes * VERTICES],
        mode_fields: vec![0.25; 3 * modes * VERTICES],
    };
    let header = ResponseHeader {
        vertices: VERTICES,
        mesh_crc32: 0,
        chains: vec![ChainShape { ratio: 0.9, units: 20, pitch_m: 0.004 }; chains],
        contact_radius_m: 0.005,
        harmonics,
        modes,
        made: vec!["by hand".to_owned()],
        errors: vec![RegionError {
            region: "all".to_owned(),
            sites: 1,
            field: [0.1; 2],
            near_field: [0.1; 2],
            force: [0.01; 2],
        }],
    };
    ResponseFile { header, parts, factors: vec![1.0; VERTICES] }
}
