//! Every file in config/ is a scene that runs, and feels as its comments say.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::path::{Path, PathBuf};

use glam::DVec3;
use rhombus_chain::{ContactShape, Formulation, SurfacePoint};
use scene::{Parameters, Reader, Scene, read_response};

fn config() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config")
}

fn read(name: &str) -> Scene {
    Scene::from_file(&config().join(name), Reader::Everything).expect(name)
}

fn files() -> Vec<PathBuf> {
    let in_folder = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).expect("a folder");
        entries
            .map(|entry| entry.expect("an entry").path())
            .filter(|p| p.extension().is_some_and(|e| e == "yaml"))
    };
    in_folder(config()).chain(in_folder(config().join("tissues"))).collect()
}

#[test]
fn every_file_is_a_scene_with_a_contact_law_and_a_body_of_likely_size() {
    let files = files();
    assert!(files.len() >= 7, "{files:?}");
    for file in files {
        let scene = Scene::from_file(&file, Reader::Everything).expect("accepted");
        scene.tissue().expect("a tissue");
        assert_eq!(scene.load_body().expect("a body").warnings, [], "{}", file.display());
    }
}

#[test]
fn the_liver_is_soft_and_has_3116_vertices() {
    let scene = read("liver.yaml");
    let law = scene.law().expect("a law");
    assert!((100.0..300.0).contains(&law.rest_stiffness_n_per_m()), "{}", law.rest_stiffness_n_per_m());
    let pressed = law.at_depth(0.005).expect("finite");
    assert!((0.9..1.1).contains(&pressed.force_n), "{} N at 5 mm", pressed.force_n);
    let mut shape = ContactShape::new(&law, &scene.surface_parameters()).expect("a shape");
    shape.set_depth(&law, 0.005).expect("finite");
    assert!((0.030..0.040).contains(&shape.reach_m()), "{} m reach at 5 mm", shape.reach_m());
    let body = scene.load_body().expect("a body").body;
    assert_eq!((body.mesh().vertices().len(), body.mesh().triangles().len()), (3116, 6228));
}

#[test]
fn the_default_scene_is_the_same_liver_calibrated_within_what_its_file_says() {
    let (organ, liver) = (read("organ.yaml"), read("liver.yaml"));
    assert_eq!(organ.body.mesh, liver.body.mesh);
    let path = organ.body.response.as_deref().expect("a calibrated body");
    assert!(std::fs::metadata(path).expect("a file").len() < 8_000_000);
    let header = read_response(path).expect("whole").header;
    let judged = header.errors.iter().find(|errors| errors.region == "reference sites").expect("judged");
    assert!(judged.field[0] <= 0.10 && judged.field[1] <= 0.27, "{judged:?}");
    assert!(judged.near_field[0] <= 0.08, "{judged:?}");
    assert!(judged.force[0] <= 0.025 && judged.force[1] <= 0.10, "{judged:?}");
    let body = organ.load_body().expect("a body").body;
    let (low, high) = body.stiffness().expect("factors").range();
    assert!(0.5 < low && low < 1.0 && 1.0 < high && high < 2.0, "{low} to {high}");
    assert!(body.response().is_some_and(|response| response.harmonics() > 0 && response.modes() > 0));
}

#[test]
fn no_tissue_is_at_a_guard_where_a_hand_presses_and_pulls() {
    for file in files() {
        let law = Scene::from_file(&file, Reader::Everything).expect("accepted").law().expect("a law");
        // The published law gives way when pulled: that is how it was printed.
        let pulled_m = if law.formulation() == Formulation::Energy { -0.008 } else { -0.004 };
        for depth_m in [0.02, pulled_m] {
            let response = law.at_depth(depth_m).expect("finite");
            assert!(!response.saturated, "{} at {depth_m} m", file.display());
        }
    }
}

#[test]
fn tissues_have_the_stiffness_their_comments_promise() {
    for (name, stiffness_n_per_m) in [("fat", 60.0), ("liver", 200.0), ("muscle", 400.0), ("tumour", 1200.0)]
    {
        let scene = read(&format!("tissues/{name}.yaml"));
        let found = scene.law().expect("a law").rest_stiffness_n_per_m();
        assert!((found / stiffness_n_per_m - 1.0).abs() < 0.05, "{name}: {found} N/m");
    }
}

#[test]
fn scenes_have_the_tissue_their_comments_name() {
    assert_eq!(read("liver.yaml").chains, read("tissues/liver.yaml").chains);
    assert_eq!(read("block.yaml").chains, read("tissues/muscle.yaml").chains);
    assert_eq!(read("nodule.yaml").chains, read("liver.yaml").chains);
    assert_eq!(read("two_hands.yaml").chains, read("liver.yaml").chains);
}

#[test]
fn the_two_hands_stand_on_both_sides_of_the_liver_and_only_they_say_where() {
    let file = config().join("two_hands.yaml");
    let scene = read("two_hands.yaml");
    assert_eq!(scene.session.devices, ["left", "right"]);
    assert!(!scene.parameters().is_given("device.scene_from_device"));
    assert_eq!(
        Parameters::drivers_in_file(&file).expect("accepted"),
        ["/left/haptic_device", "/right/haptic_device"]
    );
    let base = |name| {
        let driver = Scene::from_file(&file, Reader::Node(name)).expect("accepted");
        driver.device.scene_from_device.translation.x
    };
    assert_eq!((base("/left/haptic_device"), base("/right/haptic_device")), (-0.2, 0.2));
}

#[test]
fn the_hidden_nodule_is_six_times_as_stiff_and_24_mm_wide() {
    let body = read("nodule.yaml").load_body().expect("a body").body;
    let map = body.stiffness().expect("a map");
    assert_eq!(map.range(), (1.0, 6.0));
    let centre = DVec3::new(-0.010, 0.023, 0.058);
    for face in 0..body.mesh().triangles().len() as u32 {
        let corner = SurfacePoint { face, barycentric: DVec3::X };
        let (factor, away_m) = (map.at(&corner), body.mesh().position(corner).distance(centre));
        assert_eq!(factor > 3.5, away_m < 0.012, "{factor} at {away_m} m");
    }
}
