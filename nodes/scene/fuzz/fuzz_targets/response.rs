//! Any bytes as the file of a calibrated body, with the checksum that they have: what a damaged disk does not write, but an
//! editor may.
#![no_main]

use libfuzzer_sys::fuzz_target;
use rhombus_chain::{Response, SurfaceMesh};
use scene::ResponseFile;

fuzz_target!(|bytes: &[u8]| {
    let _ = ResponseFile::from_bytes(bytes);
    let mut signed = bytes.to_vec();
    signed.extend(crc32fast::hash(bytes).to_le_bytes());
    let Ok(file) = ResponseFile::from_bytes(&signed) else { return };
    let again = file.to_bytes().ok().and_then(|bytes| ResponseFile::from_bytes(&bytes).ok());
    // NaN is not equal to itself.
    if file.parts.coefficients.iter().chain(&file.parts.amplitudes).all(|x| x.is_finite()) && again.is_some() {
        assert_eq!(again.map(|again| again.header), Some(file.header.clone()), "a file that is read is written alike");
    }
    let corners = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let vertices = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    let mesh = SurfaceMesh::new(vertices.map(Into::into).to_vec(), corners).expect("a tetrahedron");
    let _ = Response::new(file.parts, &mesh);
});
