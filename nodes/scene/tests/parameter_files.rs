//! What is read from a parameter file, and for every kind of bad file the one message that says where and what.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::path::Path;

use rhombus_chain::Formulation;
use scene::{MeshSource, Reader, Scene};

/// One chain that the model accepts, as the lines below `ros__parameters:`.
const CHAIN: &str = "    chains.rod_length: [0.004]
    chains.angle: [0.9]
    chains.ratio: [0.78]
    chains.units: [24]
    chains.normal_stiffness: [1060.0]
    chains.tangential_stiffness: [100.0]
    chains.tangential_growth: [10.0]
";

fn with_chain(more: &str) -> String {
    format!("/**:\n  ros__parameters:\n{CHAIN}{more}")
}

fn read_bytes(text: &[u8], reader: Reader<'_>) -> Result<Scene, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.yaml");
    std::fs::write(&path, text).expect("a file");
    let shortened = |message: String| message.replace(&format!("{}/", folder.path().display()), "");
    let scene = Scene::from_file(&path, reader).map_err(|error| shortened(error.to_string()))?;
    // What the chains say together is checked where the law is made.
    if scene.chains.is_some() {
        scene.tissue().map_err(|error| shortened(error.to_string()))?;
    }
    Ok(scene)
}

fn read(text: &str) -> Result<Scene, String> {
    read_bytes(text.as_bytes(), Reader::Everything)
}

fn error(text: &str) -> String {
    read(text).expect_err("should be refused")
}

// ---- what is read

#[test]
fn block_and_flow_style_nested_and_dotted_keys_mean_the_same() {
    let flow = "{'/**': {ros__parameters: {chains: {rod_length: [0.004], angle: [0.9], ratio: [0.78], units: [24], \
                normal_stiffness: [1060.0], tangential_stiffness: [100.0], tangential_growth: [10.0]}, surface.rate: 30}}}";
    let block = with_chain("    surface:\n      rate: 30\n");
    let (flow, block) = (read(flow).expect("flow"), read(&block).expect("block"));
    assert_eq!(flow.chains, block.chains);
    assert_eq!((flow.surface.rate_hz, block.surface.rate_hz), (30.0, 30.0));
}

#[test]
fn everything_but_the_chains_has_a_default() {
    let scene = read("/**:\n  ros__parameters: {}\n").expect("an empty section");
    assert_eq!(scene.chains, None);
    assert_eq!(scene.surface.cutoff, 0.05);
    assert_eq!(scene.body.mesh, MeshSource::BuiltIn(scene::BodyKind::Liver));
    let scene = read(&with_chain("")).expect("chains only");
    let chains = scene.chains.expect("given");
    assert_eq!(chains.formulation, Formulation::Energy);
    assert_eq!(chains.chains[0].weight, 1.0);
    assert_eq!(chains.chains[0].pitch_m, 2.0 * 0.004 * libm::cos(0.9));
}

#[test]
fn an_integer_is_accepted_for_a_number_and_yaml_integers_for_units_only() {
    assert_eq!(read(&with_chain("    body.scale: 2\n")).expect("accepted").body.scale, 2.0);
}

#[test]
fn a_node_reads_the_sections_that_its_own_reader_would_apply_in_file_order() {
    let text = "/**:\n  ros__parameters: {surface.rate: 1.0}\n\
                deformation:\n  ros__parameters: {surface.rate: 2.0}\n\
                /left/deformation:\n  ros__parameters: {surface.rate: 3.0}\n\
                /right/deformation:\n  ros__parameters: {surface.rate: 4.0}\n\
                somebody_else:\n  ros__parameters: {surface.rate: 5.0, their.own: 1}\n";
    let rate = |node| read_bytes(text.as_bytes(), Reader::Node(node)).expect("accepted").surface.rate_hz;
    assert_eq!(rate("/left/deformation"), 3.0);
    assert_eq!(rate("/deformation"), 2.0);
    assert_eq!(rate("/right/deformation"), 4.0);
    assert_eq!(rate("/visualization"), 1.0);
}

#[test]
fn namespaces_may_be_nested() {
    let text = "/left:\n  deformation:\n    ros__parameters: {surface.rate: 7.0}\n";
    let rate = |reader| read_bytes(text.as_bytes(), reader).expect("accepted").surface.rate_hz;
    assert_eq!(rate(Reader::Node("/left/deformation")), 7.0);
    assert_eq!(rate(Reader::Everything), 7.0);
}

#[test]
fn for_everything_sections_of_other_peoples_nodes_do_not_count() {
    let text =
        "camera:\n  ros__parameters: {exposure: auto}\n/**:\n  ros__parameters: {surface.rate: 10.0}\n";
    assert_eq!(read(text).expect("accepted").surface.rate_hz, 10.0);
}

#[test]
fn the_same_value_in_two_sections_is_one_value() {
    let text = "/**:\n  ros__parameters: {surface.rate: 10}\ndeformation:\n  ros__parameters: {surface.rate: 10.0}\n";
    assert_eq!(read(text).expect("accepted").surface.rate_hz, 10.0);
}

#[test]
fn a_mesh_path_is_relative_to_the_parameter_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.yaml");
    std::fs::write(&path, "/**: {ros__parameters: {body.mesh: meshes/organ.obj}}").expect("a file");
    let scene = Scene::from_file(&path, Reader::Everything).expect("accepted");
    assert_eq!(scene.body.mesh, MeshSource::File(folder.path().join("meshes/organ.obj")));
}

#[test]
fn a_nodes_mesh_path_is_relative_to_its_parameter_file() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("organ.obj"), "").expect("a file");
    let arguments = ["--ros-args", "--params-file", "/elsewhere/b.yaml", "--params-file"].map(str::to_owned);
    let file = folder.path().join("a.yaml").display().to_string();
    let origin = scene::Origin::node("deformation", arguments.into_iter().chain([file]));
    let values = [("body.mesh".to_owned(), scene::Value::String("organ.obj".to_owned()))];
    let scene = Scene::from_values(values, origin).expect("accepted");
    assert_eq!(scene.body.mesh, MeshSource::File(folder.path().join("organ.obj")));
}

// ---- what is not a parameter file

#[test]
fn a_missing_file() {
    let message = Scene::from_file(Path::new("nowhere/scene.yaml"), Reader::Everything).expect_err("missing");
    assert_eq!(
        message.to_string(),
        "nowhere/scene.yaml: cannot be read: No such file or directory (os error 2)"
    );
}

#[test]
fn an_empty_file() {
    for text in ["", "\n\n", "# only a comment\n"] {
        assert_eq!(
            error(text),
            "scene.yaml: the file is empty; a ROS 2 parameter file has a section (/**: or a node's name), in it \
             ros__parameters:, and in that the parameters"
        );
    }
}

#[test]
fn text_that_is_not_yaml() {
    let message = error("/**:\n  ros__parameters:\n    surface.rate: [1.0\n");
    assert!(message.starts_with("scene.yaml:4: not valid YAML: "), "{message}");
    let message = error("/**: *nothing\n");
    assert!(message.starts_with("scene.yaml:1: not valid YAML: unknown anchor"), "{message}");
}

#[test]
fn bytes_that_are_not_utf_8() {
    let message = read_bytes(b"/**:\n  ros__parameters:\n    \xff\xfe: 1\n", Reader::Everything);
    assert_eq!(message.expect_err("refused"), "scene.yaml:3: not valid YAML: not UTF-8 text");
}

#[test]
fn ros_parameters_forgotten() {
    assert_eq!(
        error("/**:\n  chains:\n    ratio: [0.5]\n"),
        "scene.yaml:3: no ros__parameters: above /**/chains/ratio; a ROS 2 parameter file has a section (/**: or a \
         node's name), in it ros__parameters:, and in that the parameters"
    );
    let message = error("ros__parameters:\n  surface.rate: 1.0\n");
    assert!(message.starts_with("scene.yaml:1: ros__parameters: is in no section; "), "{message}");
    let message = error("surface.rate\n");
    assert!(message.starts_with("scene.yaml:1: found \"surface.rate\"; "), "{message}");
}

#[test]
fn a_wildcard_that_the_nodes_would_ignore() {
    assert_eq!(
        error("/**/deformation:\n  ros__parameters: {surface.rate: 1.0}\n"),
        "scene.yaml:2: section /**/deformation would be ignored by the nodes; accepted: /**, a node's name, or its full name"
    );
}

#[test]
fn a_full_name_without_its_first_slash_that_the_nodes_would_ignore() {
    for text in [
        "left:\n  deformation:\n    ros__parameters: {surface.rate: 7.0}\n",
        "# a scene\n\nleft/deformation: {ros__parameters: {surface.rate: 7.0}}\n",
    ] {
        assert_eq!(
            error(text),
            "scene.yaml:3: section left/deformation would be ignored by the nodes; accepted: /left/deformation, with its \
             first slash"
        );
    }
}

#[test]
fn a_full_name_that_lacks_the_namespace_of_the_session() {
    let text = "/**:\n  ros__parameters: {surface.rate: 1.0}\n/left/deformation:\n  ros__parameters: {surface.rate: 7.0}\n";
    let read =
        |text: &str, node| read_bytes(text.as_bytes(), Reader::Node(node)).map(|scene| scene.surface.rate_hz);
    assert_eq!(
        read(text, "/or/left/deformation"),
        Err("scene.yaml:4: section /left/deformation would be ignored by /or/left/deformation; accepted: the full name, or \
             a node's bare name"
            .to_owned())
    );
    assert_eq!(read(text, "/right/deformation"), Ok(1.0), "another one's");
    assert_eq!(read(text, "/cleft/deformation"), Ok(1.0));
    let both = format!("{text}/or/left/deformation:\n  ros__parameters: {{surface.rate: 9.0}}\n");
    assert_eq!(read(&both, "/or/left/deformation"), Ok(9.0));
}

#[test]
fn a_section_twice() {
    assert_eq!(
        error("/**:\n  ros__parameters: {surface.rate: 1.0}\n/**:\n  ros__parameters: {surface.rate: 1.0}\n"),
        "scene.yaml:4: section /** is there twice; one section is accepted"
    );
}

// ---- keys

#[test]
fn an_unknown_key_gets_the_nearest_known_name_and_its_line() {
    assert_eq!(
        error(&with_chain("    surface:\n      cutof: 0.05\n")),
        "scene.yaml:11: surface.cutof: unknown parameter; did you mean surface.cutoff?; `rhombus parameters` lists all"
    );
    assert_eq!(
        error(&with_chain("    chain.ratio: [0.5]\n")),
        "scene.yaml:10: chain.ratio: unknown parameter; did you mean chains.ratio?; `rhombus parameters` lists all"
    );
    assert_eq!(
        error(&with_chain("    zzzz: 1\n")),
        "scene.yaml:10: zzzz: unknown parameter; `rhombus parameters` lists all"
    );
}

#[test]
fn a_key_twice_however_it_is_written() {
    assert_eq!(
        error(&with_chain("    surface.rate: 1.0\n    surface:\n      rate: 1.0\n")),
        "scene.yaml:12: surface.rate: given twice in one section; the first is in line 10"
    );
    assert_eq!(
        error(&with_chain("    chains.ratio: [0.5]\n")),
        "scene.yaml:10: chains.ratio: given twice in one section; the first is in line 5"
    );
}

#[test]
fn a_key_with_two_values_in_two_sections() {
    let text = "/**:\n  ros__parameters: {surface.rate: 10.0}\n/left/deformation:\n  ros__parameters:\n    surface.rate: 20.0\n";
    assert_eq!(
        error(text),
        "scene.yaml:5: surface.rate: 20.0 here and 10.0 in section /**; one value is accepted for all sections"
    );
}

// ---- types

#[test]
fn a_value_of_the_wrong_type() {
    let cases = [
        (
            "    surface.rate: fast\n",
            "scene.yaml:10: surface.rate: \"fast\" is a string; accepted: number, 0 to 1000 [Hz]; write the number \
             without quotes or unit",
        ),
        (
            "    probe.radius: 5 mm\n",
            "scene.yaml:10: probe.radius: \"5 mm\" is a string; accepted: number, > 0 [m]; write the number without \
             quotes or unit",
        ),
        (
            "    surface.rate: true\n",
            "scene.yaml:10: surface.rate: true is a boolean; accepted: number, 0 to 1000 [Hz]",
        ),
        (
            "    surface.rate:\n",
            "scene.yaml:10: surface.rate: nothing is empty; accepted: number, 0 to 1000 [Hz]",
        ),
        (
            "    surface.rate: [60.0]\n",
            "scene.yaml:10: surface.rate: [60.0] is an array of numbers; accepted: number, 0 to 1000 [Hz]",
        ),
        (
            "    surface.rate: {hz: 60.0}\n",
            "scene.yaml:10: surface.rate: {...} is a group of parameters; accepted: number, 0 to 1000 [Hz]",
        ),
        (
            "    chains.weight: 1.0\n",
            "scene.yaml:10: chains.weight: 1.0 is a number; accepted: array of numbers, one entry for each chain, > 0; \
             write an array of one entry in brackets, like [x]",
        ),
        (
            "    body.frame_id: 7\n",
            "scene.yaml:10: body.frame_id: 7 is an integer; accepted: string, not empty, without spaces; write it in quotes",
        ),
        (
            "    body.frame_id: on\n",
            "scene.yaml:10: body.frame_id: on is a boolean to ROS 2; accepted: string, not empty, without spaces; \
             write it in quotes",
        ),
        (
            "    use_sim_time: yes please\n",
            "scene.yaml:10: use_sim_time: \"yes please\" is a string; accepted: boolean; write true or false without quotes",
        ),
    ];
    for (line, message) in cases {
        assert_eq!(error(&with_chain(line)), message);
    }
    assert_eq!(read(&with_chain("    body.frame_id: \"on\"\n")).expect("quoted").body.frame_id, "on");
}

#[test]
fn arrays_of_integers_for_numbers_and_of_numbers_for_integers() {
    let text = with_chain("").replace("angle: [0.9]", "angle: [1]");
    assert_eq!(
        error(&text),
        "scene.yaml:4: chains.angle: [1] is an array of integers; accepted: array of numbers, one entry for each chain, \
         > 0 and < 1.5707963267948966 [rad]; write every entry with a decimal point, like 1.0"
    );
    let text = with_chain("").replace("units: [24]", "units: [24.0]");
    assert_eq!(
        error(&text),
        "scene.yaml:6: chains.units: [24.0] is an array of numbers; accepted: array of integers, one entry for each \
         chain, 1 to 1000000; write whole numbers without a decimal point"
    );
}

#[test]
fn an_array_that_mixes_integers_and_numbers_is_refused_as_ros_refuses_it() {
    assert_eq!(
        error(&with_chain("    body.pose: [0.0, 0, 0, 0, 0, 0, 1]\n")),
        "scene.yaml:10: body.pose: [0.0, 0, 0, 0, 0, 0, 1] mixes a number with an integer, which ROS 2 refuses; \
         accepted: array of numbers, 7 entries, x y z qx qy qz qw with a unit quaternion [m]"
    );
}

// ---- ranges

#[test]
fn values_out_of_range() {
    let cases = [
        (
            "    surface.cutoff: 1.0\n",
            "scene.yaml:10: surface.cutoff: 1.0 is not accepted; accepted: number, >= 0 and < 1",
        ),
        (
            "    body.scale: -0.001\n",
            "scene.yaml:10: body.scale: -0.001 is not accepted; accepted: number, > 0",
        ),
        (
            "    probe.radius: .nan\n",
            "scene.yaml:10: probe.radius: NaN is not accepted; accepted: number, > 0 [m]",
        ),
        (
            "    probe.radius: .inf\n",
            "scene.yaml:10: probe.radius: inf is not accepted; accepted: number, > 0 [m]",
        ),
        (
            "    grasp.close_below: .nan\n",
            "scene.yaml:10: grasp.close_below: NaN is not accepted; accepted: number [rad]",
        ),
        (
            "    chains.formulation: exact\n",
            "scene.yaml:10: chains.formulation: \"exact\" is not accepted; accepted: string, \"energy\" or \"published\"",
        ),
        (
            "    body.frame_id: my body\n",
            "scene.yaml:10: body.frame_id: \"my body\" is not accepted; accepted: string, not empty, without spaces",
        ),
        (
            "    body.mesh: \"\"\n",
            "scene.yaml:10: body.mesh: \"\" is not accepted; accepted: an OBJ file or one of the generated bodies \
             \"liver\" or \"block\" or \"sphere\"",
        ),
        (
            "    body.pose: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0]\n",
            "scene.yaml:10: body.pose: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0] is not accepted; accepted: array of numbers, \
             7 entries, x y z qx qy qz qw with a unit quaternion [m]",
        ),
        (
            "    body.pose: [0.0, 0.0, 0.0]\n",
            "scene.yaml:10: body.pose: [0.0, 0.0, 0.0] has 3 entries; accepted: array of numbers, 7 entries, x y z qx qy \
             qz qw with a unit quaternion [m]",
        ),
    ];
    for (line, message) in cases {
        assert_eq!(error(&with_chain(line)), message);
    }
}

#[test]
fn a_chain_entry_out_of_range_names_the_entry() {
    let text = with_chain("").replace("ratio: [0.78]", "ratio: [1.2]");
    assert_eq!(
        error(&text),
        "scene.yaml:5: chains.ratio: 1.2 is not accepted (entry 0, counted from 0); accepted: array of numbers, one entry \
         for each chain, > 0 and < 1"
    );
    let text = with_chain("").replace("units: [24]", "units: [0]");
    assert_eq!(
        error(&text),
        "scene.yaml:6: chains.units: 0 is not accepted (entry 0, counted from 0); accepted: array of integers, one entry \
         for each chain, 1 to 1000000"
    );
    let text = with_chain("").replace("units: [24]", "units: []");
    assert_eq!(
        error(&text),
        "scene.yaml:6: chains.units: [] has 0 entries; accepted: array of integers, one entry for each chain, 1 to 1000000"
    );
}

// ---- the chains together

#[test]
fn chain_arrays_of_unequal_length() {
    let text = with_chain("").replace("angle: [0.9]", "angle: [0.9, 0.9]");
    assert_eq!(
        error(&text),
        "scene.yaml:4: chains.angle: has 2 entries and chains.rod_length has 1; every chains.* array has one entry for \
         each chain"
    );
}

#[test]
fn a_required_chain_array_missing() {
    let text = with_chain("").replace("    chains.units: [24]\n", "");
    assert_eq!(
        error(&text),
        "scene.yaml: chains.units: missing; it has no default; accepted: array of integers, one entry for each chain, \
         1 to 1000000"
    );
    let scene = read("/**: {ros__parameters: {}}").expect("no chains at all");
    let message = scene.tissue().expect_err("no chains").to_string();
    assert!(
        message.contains("chains: missing; it has no default; accepted: the arrays chains.rod_length, "),
        "{message}"
    );
}

#[test]
fn parameters_the_model_does_not_accept_name_the_ways_out() {
    let text = with_chain("").replace("tangential_stiffness: [100.0]", "tangential_stiffness: [90000.0]");
    let message = error(&text);
    assert!(
        message
            .starts_with("scene.yaml:8: chains.tangential_stiffness: chain 0: the energy law snaps through"),
        "{message}"
    );
    assert!(message.contains("90000") && message.contains("accepted is normal_stiffness > "), "{message}");

    let message = error(&format!("{text}    chains.formulation: published\n"));
    assert!(
        message.starts_with(
            "scene.yaml:8: chains.tangential_stiffness: chain 0: the published law does not push back"
        ),
        "{message}"
    );

    let message = error(&with_chain("    chains.weight: [0.9]\n"));
    assert_eq!(
        message,
        "scene.yaml:10: chains.weight: chains.weight: the 1 weights add up to 0.9; accepted is 1 within 1e-9"
    );
}

#[test]
fn a_package_path_that_no_package_has() {
    let message = error("/**: {ros__parameters: {body.mesh: package://rhombus_haptics/config/none.obj}}");
    assert!(
        message.starts_with(
            "scene.yaml:1: body.mesh: \"package://rhombus_haptics/config/none.obj\" is in no package"
        ),
        "{message}"
    );
}

#[test]
fn two_devices_on_the_same_topics() {
    let error = error(&with_chain("    devices: [left, left]\n"));
    assert!(error.starts_with("scene.yaml:10: devices: \"left\" is not accepted"), "{error}");
    assert!(error.ends_with("accepted: each name once"), "{error}");
}
