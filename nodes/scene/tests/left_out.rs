//! What a scene leaves out is not there: counted in bytes that the allocator handed out.
#![expect(unsafe_code, reason = "a counting allocator is an allocator")]
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use rhombus_chain::{StiffnessMap, SurfaceMesh};
use scene::{BodyKind, Origin, Parameters, Plan, Scene, StiffnessFile, TopicState, Value, generate};

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call goes to the system's allocator unchanged; the counter is a thread's own and never allocates.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = HELD.try_with(|held| held.set(held.get() + layout.size() as isize));
        // SAFETY: the caller's contract is the system's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        let _ = HELD.try_with(|held| held.set(held.get() - layout.size() as isize));
        // SAFETY: the caller's contract is the system's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes that are held after `make` and were not before.
fn held<T>(make: impl FnOnce() -> T) -> (T, isize) {
    let before = HELD.get();
    let made = make();
    (made, HELD.get() - before)
}

fn scene(changes: &[(&str, Value)]) -> Scene {
    let array = |x: f64| Value::DoubleArray(vec![x]);
    let chain = [
        ("chains.rod_length", array(0.004)),
        ("chains.angle", array(0.9)),
        ("chains.ratio", array(0.78)),
        ("chains.units", Value::IntegerArray(vec![24])),
        ("chains.normal_stiffness", array(1060.0)),
        ("chains.tangential_stiffness", array(100.0)),
        ("chains.tangential_growth", array(10.0)),
    ];
    let values = chain.iter().chain(changes).map(|(name, value)| ((*name).to_owned(), value.clone()));
    let parameters = Parameters::from_values(values, Origin::named("a test")).expect("accepted");
    Scene::from_parameters(parameters).expect("accepted")
}

fn plan(changes: &[(&str, Value)]) -> Plan {
    scene(changes).plan().expect("a plan")
}

fn bytes(plan: &Plan, part: &str) -> usize {
    plan.part(part).and_then(|part| part.bytes).unwrap_or(0)
}

#[test]
fn the_memory_that_is_explained_is_the_memory_that_is_held() {
    for expansion in [0.0, 0.5] {
        let scene = scene(&[("surface.expansion", Value::Double(expansion))]);
        let explained = bytes(&scene.plan().expect("a plan"), "surface") as isize;
        let body = scene.load_body().expect("a body").body;
        let tissue = scene.tissue().expect("a tissue");
        let (field, held) = held(|| scene.surface_field(&body, &tissue));
        assert!(field.is_some());
        // Besides its buffers the field has its own copy of the few chains.
        assert!((held - explained).abs() < 4096, "expansion {expansion}: explained {explained} held {held}");
    }
    let liver = generate::body(BodyKind::Liver, BodyKind::Liver.default_vertices());
    let (mesh, held) = held(|| SurfaceMesh::new(liver.vertices.clone(), liver.triangles.clone()));
    assert!(mesh.is_ok());
    assert_eq!(held, bytes(&plan(&[]), "body") as isize);
}

#[test]
fn without_expansion_its_memory_is_not_there() {
    let without = plan(&[]);
    let with = plan(&[("surface.expansion", Value::Double(0.5))]);
    assert!(without.leaves_out("expansion") && without.part("expansion").is_none());
    assert!(with.part("expansion").is_some() && !with.leaves_out("expansion"));
    assert!(bytes(&with, "surface") > bytes(&without, "surface"));
}

#[test]
fn at_surface_rate_0_no_surface_is_built_and_nothing_allocated_for_it() {
    let still = scene(&[("surface.rate", Value::Double(0.0)), ("surface.expansion", Value::Double(1.0))]);
    let plan = still.plan().expect("a plan");
    for part in ["surface", "boundary", "expansion"] {
        assert!(plan.leaves_out(part) && plan.part(part).is_none(), "{part}");
    }
    let displacement = plan.topics.iter().find(|topic| topic.name == "surface_displacement").expect("there");
    assert_eq!(displacement.state, TopicState::Absent("surface.rate is 0"));
    let body = still.load_body().expect("a body").body;
    let tissue = still.tissue().expect("a tissue");
    let (field, held) = held(|| still.surface_field(&body, &tissue));
    assert!(field.is_none());
    assert_eq!(held, 0);
}

#[test]
fn viewer_boundary_and_clutch_are_left_out_by_their_parameters() {
    let bare = plan(&[("visualization.rate", Value::Double(0.0)), ("surface.cutoff", Value::Double(0.0))]);
    for part in ["viewer", "drawn chains", "boundary", "clutch"] {
        assert!(bare.leaves_out(part) && bare.part(part).is_none(), "{part}");
    }
    let full = plan(&[("clutch.button", Value::String("0".to_owned()))]);
    for part in ["viewer", "drawn chains", "boundary", "clutch"] {
        assert!(full.part(part).is_some() && !full.leaves_out(part), "{part}");
    }
}

#[test]
fn a_stiffness_map_is_there_only_when_it_is_named() {
    let without = plan(&[]);
    assert!(without.leaves_out("stiffness map") && without.part("stiffness map").is_none());
    let liver = generate::body(BodyKind::Liver, BodyKind::Liver.default_vertices());
    let mut factors = vec![1.0; liver.vertices.len()];
    factors[17] = 4.5;
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), StiffnessFile { comment: "a nodule", factors: &factors }.to_string())
        .expect("written");
    let named = scene(&[("body.stiffness_map", Value::String(file.path().display().to_string()))]);
    let with = named.plan().expect("a plan");
    let part = with.part("stiffness map").expect("built");
    assert!(part.what.ends_with(": 1 to 4.5 times the contact law"), "{}", part.what);
    let mesh = SurfaceMesh::new(liver.vertices, liver.triangles).expect("a liver");
    let (map, held) = held(|| StiffnessMap::new(factors, &mesh));
    assert!(map.is_ok());
    assert_eq!(held + 8 * mesh.vertices().len() as isize, bytes(&with, "stiffness map") as isize);
}

#[test]
fn every_device_has_its_own_topics_and_memory() {
    let two = plan(&[("devices", Value::StringArray(vec!["left".to_owned(), "right".to_owned()]))]);
    for name in ["left/measured_cp", "right/measured_cp", "left/servo_cf", "surface_displacement"] {
        assert_eq!(two.topics.iter().filter(|topic| topic.name == name).count(), 1, "{name}");
    }
    assert!(two.topics.iter().all(|topic| topic.name != "measured_cp"));
    assert_eq!(bytes(&two, "contact memory"), 2 * bytes(&plan(&[]), "contact memory"));
}
