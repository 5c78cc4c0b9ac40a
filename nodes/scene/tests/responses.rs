//! `body.response`: what is read, and what is refused and why.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use rhombus_chain::ResponseParts;
use scene::{
    ChainShape, LoadedBody, Reader, RegionError, ResponseFile, ResponseHeader, Scene, mesh_checksum,
    read_response,
};

/// A tetrahedron, outward.
const TETRAHEDRON: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const CHAINS: &str = "chains.rod_length: [0.004], chains.angle: [0.8], chains.ratio: [0.9], chains.units: [20], \
    chains.normal_stiffness: [200.0], chains.tangential_stiffness: [10.0], chains.tangential_growth: [10.0], chains.pitch: [0.004]";

/// A folder with an organ, its scene and, if there are any, the bytes of its response.
fn folder(response: Option<&[u8]>, more: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("a file");
    write("organ.obj", TETRAHEDRON.as_bytes());
    let scene = format!(
        "/**: {{ros__parameters: {{body.mesh: organ.obj, body.response: organ.response, {CHAINS}{more}}}}}\n"
    );
    write("scene.yaml", scene.as_bytes());
    if let Some(bytes) = response {
        write("organ.response", bytes);
    }
    folder
}

/// What such a scene loads, messages without the folder's name.
fn load(response: Option<&[u8]>, more: &str) -> Result<LoadedBody, String> {
    let folder = folder(response, more);
    let scene = Scene::from_file(&folder.path().join("scene.yaml"), Reader::Everything).expect("accepted");
    scene.load_body().map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

/// One harmonic, two modes, a factor for each of the four vertices.
fn file() -> ResponseFile {
    let folder = folder(None, "");
    let scene = format!("/**: {{ros__parameters: {{body.mesh: organ.obj, {CHAINS}}}}}\n");
    let path = folder.path().join("without.yaml");
    std::fs::write(&path, scene).expect("a file");
    let scene = Scene::from_file(&path, Reader::Everything).expect("accepted");
    let mesh = scene.load_body().expect("a tetrahedron").body.mesh().clone();
    let coefficients = [1.0, 0.1, -0.2, 0.3, 0.0, 0.1, -0.1, 0.2].repeat(4);
    let parts = ResponseParts {
        chains: 1,
        harmonics: 1,
        modes: 2,
        coefficients,
        amplitudes: (0_u8..8).map(f32::from).collect(),
        mode_fields: (0_u8..24).map(|i| 0.01 * f32::from(i)).collect(),
    };
    let chains =
        scene.law().expect("a law").chains().iter().map(|chain| ChainShape::of(chain.parameters())).collect();
    let header = ResponseHeader {
        vertices: 4,
        mesh_crc32: mesh_checksum(&mesh),
        chains,
        contact_radius_m: 0.005,
        harmonics: 1,
        modes: 2,
        made: vec!["by a test".to_owned()],
        errors: Vec::new(),
    };
    ResponseFile { header, parts, factors: vec![1.0, 2.0, 0.5, 1.5] }
}

fn bytes(change: impl FnOnce(&mut ResponseFile)) -> Vec<u8> {
    let mut file = file();
    change(&mut file);
    file.to_bytes().expect("a header")
}

#[test]
fn what_is_written_reads_back_and_belongs_to_the_body() {
    let written = file();
    let loaded = load(Some(&bytes(|_| {})), "").expect("accepted").body;
    assert_eq!(loaded.response().expect("a response").parts(), &written.parts);
    assert_eq!(loaded.stiffness().expect("factors").range(), (0.5, 2.0));
    let folder = folder(Some(&bytes(|_| {})), "");
    assert_eq!(read_response(&folder.path().join("organ.response")).expect("accepted"), written);
}

#[test]
fn a_cut_file_and_one_with_any_byte_changed_are_refused() {
    let whole = bytes(|_| {});
    let folder = folder(None, "");
    let path = folder.path().join("organ.response");
    let refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("a file");
        read_response(&path).expect_err("refused").to_string()
    };
    for end in 0..whole.len() {
        let reason = refused(&whole[..end]);
        assert!(reason.contains("organ.response: body.response: "), "{reason}");
    }
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        refused(&damaged);
    }
    assert!(refused(b"factor\n1\n").contains("accepted: what rhombus calibrate --body writes"));
}

#[test]
fn what_does_not_fit_the_scene_is_refused_with_what_is_accepted() {
    let with_version = |version: &str| {
        let mut bytes = bytes(|_| {});
        let place = bytes.iter().position(|byte| *byte == b'\n').expect("a first line") - 1;
        bytes.splice(place..=place, version.bytes());
        bytes
    };
    let off_by = |force| RegionError {
        region: "all".to_owned(),
        sites: 1,
        field: [0.1; 2],
        near_field: [0.1; 2],
        force: [0.0, force],
    };
    let cases: [(Vec<u8>, &str, &str); 11] = [
        (with_version("2"), "", "version 2; accepted: 1"),
        (bytes(|file| file.header.mesh_crc32 ^= 1), "", "made for another mesh (4 vertices"),
        (
            bytes(|file| file.header.chains[0].units = 21),
            "",
            "made for chains with (ratio, units, pitch) (0.9, 21, 0.004 m); the scene has (0.9, 20, 0.004 m)",
        ),
        (
            bytes(|file| file.header.contact_radius_m = f64::INFINITY),
            "",
            "header: contact_radius_m is inf; accepted: a finite number greater than 0",
        ),
        (bytes(|file| file.header.chains[0].pitch_m = 0.0), "", "header: pitch_m is 0; accepted: "),
        (
            bytes(|file| file.header.errors = vec![off_by(f64::NAN)]),
            "",
            "header: an error of force is NaN; accepted: a finite number, 0 or more",
        ),
        (bytes(|file| file.parts.coefficients[0] = 0.5), "", "add up to 0.5; accepted: 1"),
        (bytes(|file| file.factors[2] = 0.0), "", "stiffness factor 0 of vertex 2"),
        (bytes(|file| file.header.modes = 3), "", "bytes of numbers, and its header asks for"),
        (bytes(|_| {}), ", surface.spread: rings", "accepted: surface.spread: geodesic"),
        (bytes(|_| {}), ", body.stiffness_map: map.csv", "accepted: without body.stiffness_map"),
    ];
    for (bytes, more, words) in cases {
        let more_files = more.contains("map.csv");
        let reason = if more_files {
            let folder = folder(Some(&bytes), more);
            std::fs::write(folder.path().join("map.csv"), "factor\n1\n1\n1\n1\n").expect("a file");
            let scene =
                Scene::from_file(&folder.path().join("scene.yaml"), Reader::Everything).expect("accepted");
            scene.load_body().map(drop).expect_err("refused").to_string()
        } else {
            load(Some(&bytes), more).map(drop).expect_err("refused")
        };
        assert!(reason.contains(words) && reason.contains("body.response"), "{reason}");
    }
    let missing = load(None, "").map(drop).expect_err("refused");
    assert!(missing.contains("organ.response: body.response: cannot be read"), "{missing}");
}
