//! Sections of single drivers: what may differ between two devices of one scene, and what may not.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use scene::{Parameters, Reader, Scene};

const SCENE: &str = "/**:
  ros__parameters:
    devices: [left, right]
    device.max_force: 10.0
/left/haptic_device:
  ros__parameters:
    device.scene_from_device: [-0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    device.backend: serial
    serial.port: /dev/ttyACM0
/right/haptic_device:
  ros__parameters:
    device.scene_from_device: [0.2, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    device.max_force: 5.0
";

fn in_file<T>(text: &str, then: impl FnOnce(&std::path::Path) -> T) -> T {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.yaml");
    std::fs::write(&path, text).expect("a file");
    then(&path)
}

fn read(text: &str, reader: Reader<'_>) -> Scene {
    in_file(text, |path| Scene::from_file(path, reader)).expect("accepted")
}

/// The scene with one more line in the section of the left driver, which is then line 10.
fn error(line: &str) -> String {
    let text = SCENE.replace("/right", &format!("    {line}\n/right"));
    let error =
        in_file(&text, |path| Scene::from_file(path, Reader::Everything)).expect_err("refused").to_string();
    error.split_once("scene.yaml").expect("the file").1.to_owned()
}

#[test]
fn each_driver_reads_its_own_section_and_the_scene_as_a_whole_none_of_them() {
    let left = read(SCENE, Reader::Node("/left/haptic_device")).device;
    let right = read(SCENE, Reader::Node("/right/haptic_device")).device;
    assert_eq!((left.scene_from_device.translation.x, right.scene_from_device.translation.x), (-0.2, 0.2));
    assert_eq!((left.backend.as_str(), right.backend.as_str()), ("serial", "simulated"));
    assert_eq!((left.max_force_n, right.max_force_n), (10.0, 5.0));
    for scene in [read(SCENE, Reader::Everything), read(SCENE, Reader::Node("/deformation"))] {
        assert!(!scene.parameters().is_given("device.scene_from_device"), "the drivers say where they stand");
        assert_eq!((scene.device.max_force_n, scene.device.backend.as_str()), (10.0, "simulated"));
    }
}

#[test]
fn the_drivers_with_a_section_of_their_own_are_known_by_their_full_names() {
    let drivers = |text| in_file(text, Parameters::drivers_in_file).expect("accepted");
    assert_eq!(drivers(SCENE), ["/left/haptic_device", "/right/haptic_device"]);
    let in_namespaces = "/or: {1/left: {haptic_device: {ros__parameters: {}}}}\nhaptic_device: {ros__parameters: {}}\n\
                         /haptic_device: {ros__parameters: {}}\n/left/my_haptic_device: {ros__parameters: {}}\n";
    assert_eq!(drivers(in_namespaces), ["/or/1/left/haptic_device"]);
}

#[test]
fn a_drivers_section_is_checked_like_any_other() {
    assert_eq!(
        error("device.max_forse: 1.0"),
        ":10: device.max_forse: unknown parameter; did you mean device.max_force?; `rhombus parameters` lists all"
    );
    assert_eq!(
        error("device.rate: 1.0"),
        ":10: device.rate: 1.0 is not accepted; accepted: number, 200 to 4000 [Hz]"
    );
}

#[test]
fn what_only_other_nodes_read_is_refused_in_a_drivers_section() {
    assert_eq!(
        error("surface.rate: 30.0"),
        ":10: surface.rate: in section /left/haptic_device, but read by deformation only; accepted in /** or in the \
         section of one of those"
    );
}

#[test]
fn what_the_driver_shares_with_the_model_has_one_value() {
    assert_eq!(
        error("device.motion_scale: 2.0"),
        ":10: device.motion_scale: 2.0 in section /left/haptic_device, but deformation would take 1.0; one value is \
         accepted for all who read it"
    );
    // The place is the driver's own, but not when the model has been told another.
    let placed = SCENE.replace(
        "    device.max_force: 10.0\n",
        "    device.scene_from_device: [0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0]\n",
    );
    let error =
        in_file(&placed, |path| Scene::from_file(path, Reader::Everything)).expect_err("refused").to_string();
    assert!(
        error.contains(
            "scene.yaml:7: device.scene_from_device: [-0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0] in section /left/"
        ) && error.contains("deformation, visualization would take [0.0, 0.0, 0.1,"),
        "{error}"
    );
}

#[test]
fn a_later_section_that_would_overrule_a_driver_is_refused() {
    let (everybody, drivers) = SCENE.split_once("/left/").expect("two parts");
    let error =
        in_file(&format!("/left/{drivers}{everybody}"), |path| Scene::from_file(path, Reader::Everything))
            .expect_err("refused")
            .to_string();
    assert!(
        error.ends_with(
            "scene.yaml:9: device.max_force: 5.0 in section /right/haptic_device would be overruled by 10.0 in section \
             /**, which comes later in the file; accepted: in the reverse order"
        ),
        "{error}"
    );
}
