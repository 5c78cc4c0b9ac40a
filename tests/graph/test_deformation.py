"""The deformation node over DDS: poses in, forces, contact and surface out."""

import math
import struct
import subprocess
import zlib

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped
from pytest import approx
from rhombus_haptics_msgs.msg import ContactState, SurfaceDisplacement
from shape_msgs.msg import Mesh
from tf2_msgs.msg import TFMessage

import peer as graph
from peer import MS, SCENE, Device, Peer, Program, about_x, about_z, force_of, latched, pressed, reliable, turned, vector


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def start(tmp_path):
    """Starts nodes and peers that end with the test."""
    started = []

    def start(values=SCENE, namespace="", **options):
        program = Program(tmp_path, "deformation", values, namespace, **options)
        started.append(program.kill)
        program.wait_ready()
        peer = Peer(namespace)
        started.append(peer.close)
        return program, peer

    yield start
    for end in reversed(started):
        end()


def send_transform(peer, topic, qos, parent, child, translation, rotation=(0.0, 0.0, 0.0, 1.0)):
    edge = TransformStamped()
    edge.header.frame_id, edge.child_frame_id = parent, child
    t, q = edge.transform.translation, edge.transform.rotation
    t.x, t.y, t.z = translation
    q.x, q.y, q.z, q.w = rotation
    peer.publish(TFMessage(transforms=[edge]), topic, qos)


def test_every_pose_gets_one_force_with_its_stamp_in_order(start):
    program, peer = start()
    device = Device(peer)
    sent = [device.send(pressed(0.001 * (i % 7))) for i in range(500)]
    peer.wait_for(lambda: len(device.forces) >= 500, "500 forces")
    peer.spin(0.3)
    assert [graph.stamp_of(force) for force in device.forces] == sent
    assert [graph.stamp_of(state) for state in device.states] == sent
    assert all(force.header.frame_id == "device_base" for force in device.forces)
    assert all(vector(force.wrench.torque) == (0.0, 0.0, 0.0) for force in device.forces)
    code, _ = program.interrupt()
    assert code == 0
    report = program.closing_report()
    assert (report["poses"], report["forces"], report["rejected"]) == (500, 500, 0)
    assert report["peak_depth_mm"] == approx(6.0)


def test_the_force_is_the_librarys_for_the_depth(start):
    program, peer = start()
    device = Device(peer)
    for depth_m in (0.0005, 0.002, 0.006, 0.011):
        force, law, state = device.ask(pressed(depth_m))
        expected_n = graph.library_force_n(program.file, depth_m)
        assert force_of(force) == approx((0.0, 0.0, expected_n), rel=1e-9, abs=1e-12)
        assert (state.mode, law.mode) == (ContactState.CONTACT, ContactState.CONTACT)
        assert (state.depth, state.force) == approx((depth_m, expected_n), rel=1e-9)
        assert vector(state.normal) == approx((0.0, 0.0, 1.0), abs=1e-9)
        assert vector(state.proxy) == approx((0.011, 0.007, graph.BLOCK_TOP_M), abs=1e-9)
        assert vector(state.probe) == approx(pressed(depth_m), abs=1e-12)
        assert sum(state.barycentric) == approx(1.0)
    golden_n = graph.library_force_n(program.file, 0.006)
    assert golden_n == approx(0.406381075179724, rel=1e-12), "the model's golden value"
    force, _, state = device.ask(pressed(-0.001))
    assert force_of(force) == (0.0, 0.0, 0.0)
    assert (state.mode, state.depth, state.force) == (ContactState.NONE, 0.0, 0.0)


def test_the_contact_law_gives_a_motor_loop_the_same_depth_and_chains(start):
    program, peer = start({**SCENE, "device.scene_from_device": [0.3, -0.1, 0.2, *about_x(0.4)]})
    device = Device(peer)
    in_device = lambda p: turned(about_x(-0.4), (p[0] - 0.3, p[1] + 0.1, p[2] - 0.2))
    hand = in_device(pressed(0.004))
    _, law, state = device.ask(hand)
    height_m = sum((hand[i] - vector(law.anchor)[i]) * vector(law.normal)[i] for i in range(3))
    assert law.probe_radius + law.depth_offset - height_m == approx(0.004, abs=1e-12)
    assert state.depth == approx(0.004, abs=1e-12)
    assert law.stiffness_factor == 1.0
    assert 0 < law.validity.sec * 1_000_000_000 + law.validity.nanosec <= 200 * MS
    for field in ("rod_length", "angle", "ratio", "normal_stiffness", "tangential_stiffness", "tangential_growth"):
        assert list(getattr(law, field)) == SCENE[f"chains.{field}"], field
    assert list(law.units) == SCENE["chains.units"]


def test_the_force_leaves_in_the_frame_the_pose_came_in(start):
    program, peer = start({**SCENE, "body.pose": [0.2, 0.0, 0.1, *about_z(0.5)]})
    device = Device(peer)
    depth_m, turn = 0.003, 1.1
    expected_n = graph.library_force_n(program.file, depth_m)
    # scene <- world (static), world <- arm (moving): the arm's z axis is turned away from the scene's.
    send_transform(peer, "/tf_static", latched(10), "world", "scene", (5.0, 6.0, 7.0))
    send_transform(peer, "/tf", reliable(10), "world", "arm", (5.5, 6.0, 7.0), about_x(turn))
    in_scene = turned(about_z(0.5), pressed(depth_m))
    in_scene = (in_scene[0] + 0.2, in_scene[1], in_scene[2] + 0.1)
    in_arm = turned(about_x(-turn), (in_scene[0] - 0.5, in_scene[1], in_scene[2]))
    device.frame = "arm"
    touches = lambda force, law, state: state.mode == ContactState.CONTACT
    force, law, state = device.until(in_arm, touches, "the transforms arrive")
    assert force.header.frame_id == law.header.frame_id == state.header.frame_id == "arm"
    assert force_of(force) == approx(turned(about_x(-turn), (0.0, 0.0, expected_n)), rel=1e-9, abs=1e-12)
    # The device's own frame, by the parameters.
    device.frame = "device_base"
    force, _, _ = device.ask(in_scene)
    assert force_of(force) == approx((0.0, 0.0, expected_n), rel=1e-9, abs=1e-12)


BAD_POSES = {
    "not_finite": [{"position": (math.nan, 0.0, 0.0)}, {"position": (0.0, math.inf, 0.0)}],
    "not_unit_quaternion": [
        {"orientation": (0.0, 0.0, 0.0, 1.002)},
        {"orientation": (0.0, 0.0, 0.0, 0.0)},
    ],
    "unknown_frame": [{"frame": "nowhere"}, {"frame": ""}],
    "stamp_backwards": [{"stamp_ns": 999_000_000_000}],
    "out_of_reach": [{"position": (1e300, 0.0, 0.0)}],
}


@pytest.mark.parametrize("cause", BAD_POSES)
def test_a_bad_pose_is_answered_with_no_force_counted_and_survived(start, cause):
    program, peer = start()
    device = Device(peer)
    good = pressed(0.003)
    assert force_of(device.ask(good)[0])[2] > 0.0
    for bad in BAD_POSES[cause]:
        pose = {"position": good, **bad}
        force, law, state = device.ask(**pose)
        assert force_of(force) == (0.0, 0.0, 0.0)
        assert (law.mode, state.mode) == (ContactState.NONE, ContactState.NONE)
        assert force.header.frame_id == pose.get("frame", "device_base")
    count = len(BAD_POSES[cause])
    peer.wait_for(
        lambda: any(
            level == 1 and values[f"rejected_{cause}"] == str(count)
            for level, _, values in peer.statuses.get("/deformation: device", [])
        ),
        "a warning in the diagnostics",
    )
    level, summary, values = peer.new_status("/deformation: device")
    assert (level, values["rejected"]) == (0, str(count)), summary
    # A stamp that went back has begun a new time line.
    device.now_ns += 1_000 * MS
    assert force_of(device.ask(good)[0])[2] > 0.0
    assert program.process.poll() is None
    assert "rejected" in program.log()


def test_a_grasp_pulls_and_lets_go_over_fifty_milliseconds(start):
    program, peer = start()
    device = Device(peer)
    device.ask(pressed(0.002))
    device.grasp(True)
    holds = lambda force, law, state: state.mode == ContactState.GRASP
    device.until(pressed(0.002), holds, "the grasp")
    device.now_ns += 50 * MS
    pulled = pressed(-0.004)
    force, law, state = device.ask(pulled)
    assert (state.mode, law.mode) == (ContactState.GRASP, ContactState.GRASP)
    assert state.depth == approx(-0.006, abs=1e-9), "from where the gripper closed"
    assert force_of(force)[2] == approx(graph.library_force_n(program.file, -0.006), rel=1e-9)
    assert force_of(force)[2] < 0.0, "pulls the hand back"
    device.grasp(False)
    released = lambda force, law, state: state.mode != ContactState.GRASP
    first, _, _ = device.until(pulled, released, "the release")
    assert force_of(first)[2] < 0.0, "does not jump"
    device.now_ns += 50 * MS
    assert force_of(device.ask(pulled)[0]) == (0.0, 0.0, 0.0)


def test_the_gripper_holds_below_its_angle_and_nonsense_from_it_is_counted(start):
    program, peer = start({**SCENE, "grasp.close_below": 0.3})
    device = Device(peer)
    device.gripper(0.31)
    device.gripper()
    device.gripper(math.nan)
    assert device.ask(pressed(0.002))[2].mode == ContactState.CONTACT
    peer.wait_for(
        lambda: any(v["ignored_inputs"] == "2" for _, _, v in peer.statuses.get("/deformation: device", [])),
        "two ignored inputs",
    )
    device.gripper(0.29)
    device.until(pressed(0.002), lambda f, l, state: state.mode == ContactState.GRASP, "the grasp")


def test_the_clutch_freezes_the_probe_and_the_motion_goes_on_from_there(start):
    program, peer = start({**SCENE, "device.motion_scale": 2.0})
    device = Device(peer)
    hand = lambda depth_m, away=0.0: tuple(c / 2 + away for c in pressed(depth_m))
    before, _, state = device.ask(hand(0.003))
    assert state.depth == approx(0.003, abs=1e-9), "the way of the hand is doubled"
    device.clutch(1)
    device.until(hand(0.003), lambda f, l, state: state.clutched, "the clutch")
    for away in (0.01, 0.02, 0.05):
        force, law, state = device.ask(hand(0.003, away))
        assert state.clutched and state.depth == approx(0.003, abs=1e-9)
        assert force_of(force) == approx(force_of(before))
        height_m = hand(0.003, away)[2] - law.anchor.z
        assert law.probe_radius - height_m == approx(0.003 / 2, abs=1e-9), "the law is for the hand"
    device.clutch(0)
    device.until(hand(0.003, 0.05), lambda f, l, state: not state.clutched, "the release")
    force, _, state = device.ask(hand(0.004, 0.05))
    assert state.depth == approx(0.004, abs=1e-9)


HERE = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


def test_of_two_devices_nobody_has_placed_none_feels_a_force_until_its_driver_says_where_it_stands(start):
    program, peer = start({**SCENE, "devices": ["left", "right"]})
    left, right = (Device(peer, f"{side}/", f"{side}/device_base") for side in ("left", "right"))
    for device in (left, right):
        assert force_of(device.ask(pressed(0.003))[0]) == (0.0, 0.0, 0.0)
    send_transform(peer, "/tf_static", latched(100), "scene", "left/device_base", (0.02, 0.0, 0.0))
    away = pressed(0.003, x=-0.02)
    force, _, state = left.until(away, lambda f, l, state: state.mode != ContactState.NONE, "a contact of left")
    assert force_of(force)[2] == approx(graph.library_force_n(program.file, 0.003), rel=1e-9)
    assert vector(state.proxy)[0] == approx(-0.02, abs=1e-9), "in the frame of its poses"
    assert force_of(right.ask(pressed(0.003))[0]) == (0.0, 0.0, 0.0), "right still stands nowhere"
    _, _, values = peer.new_status("/deformation: right")
    assert int(values["rejected_unknown_frame"]) == 2, values


def test_two_devices_press_one_body_without_feeling_each_other(start):
    program, peer = start({**SCENE, "devices": ["left", "right"], "device.scene_from_device": HERE})
    left = Device(peer, "left/", "left/device_base")
    right = Device(peer, "right/", "right/device_base")
    surfaces = peer.heard(SurfaceDisplacement, "surface_displacement", reliable(10))
    peer.spin(0.3)
    left_n = force_of(left.ask(pressed(0.002, x=-0.03))[0])
    right_n = force_of(right.ask(pressed(0.005, x=0.03))[0])
    assert left_n[2] == approx(graph.library_force_n(program.file, 0.002), rel=1e-9)
    assert right_n[2] == approx(graph.library_force_n(program.file, 0.005), rel=1e-9)
    assert force_of(left.ask(pressed(0.002, x=-0.03))[0]) == left_n
    # Displacements add: both dents are in one message.
    left.now_ns = right.now_ns = left.now_ns + 100 * MS
    surfaces.clear()
    left.ask(pressed(0.002, x=-0.03))
    peer.wait_for(lambda: surfaces, "a surface")
    lowest = min(surfaces[-1].displacement[2::3])
    assert lowest == approx(-0.005, abs=0.002)
    assert force_of(right.ask(pressed(-0.01))[0]) == (0.0, 0.0, 0.0)
    assert force_of(left.ask(pressed(0.002, x=-0.03))[0]) == approx(left_n)
    assert {"/deformation: body", "/deformation: left", "/deformation: right"} <= set(peer.statuses)


def test_two_sessions_in_two_namespaces_do_not_hear_each_other(start):
    (one, one_peer), (two, two_peer) = start(namespace="one"), start(namespace="room/two")
    first, second = Device(one_peer, frame="one/device_base"), Device(two_peer, frame="room/two/device_base")
    assert force_of(first.ask(pressed(0.002))[0])[2] > 0.0
    one_peer.spin(0.2), two_peer.spin(0.2)
    assert (len(first.forces), len(second.forces)) == (1, 0)
    assert force_of(second.ask(pressed(0.004))[0])[2] > 0.0
    assert (len(first.forces), len(second.forces)) == (1, 1)
    # The other session's frames are not this one's.
    assert force_of(first.ask(pressed(0.002), frame="room/two/device_base")[0]) == (0.0, 0.0, 0.0)
    assert {"/one/deformation", "/room/two/deformation"} <= one_peer.nodes()


def test_the_body_is_latched_and_the_surface_refers_to_it(start):
    program, peer = start()
    meshes = peer.heard(Mesh, "body_mesh", latched(1))
    surfaces = peer.heard(SurfaceDisplacement, "surface_displacement", reliable(10))
    peer.wait_for(lambda: meshes, "the mesh for a late joiner")
    mesh = meshes[0]
    device = Device(peer)
    device.ask(pressed(0.006))
    peer.wait_for(lambda: surfaces, "a surface")
    surface = surfaces[0]
    data = b"".join(struct.pack("<3d", v.x, v.y, v.z) for v in mesh.vertices)
    data += b"".join(struct.pack("<3I", *t.vertex_indices) for t in mesh.triangles)
    assert surface.topology_version == zlib.crc32(data)
    assert surface.header.frame_id == "body" and graph.stamp_of(surface) == device.now_ns
    assert list(surface.vertex) == sorted(set(surface.vertex)) and len(surface.vertex) > 0
    assert len(surface.displacement) == 3 * len(surface.vertex)
    # Pressed down by at most the depth, deepest at the vertices nearest to the probe.
    depths = dict(zip(surface.vertex, surface.displacement[2::3]))
    distance = lambda i: math.dist(vector(mesh.vertices[i]), (0.011, 0.007, graph.BLOCK_TOP_M))
    nearest = min(range(len(mesh.vertices)), key=distance)
    assert min(depths.values()) == depths[nearest] and -0.006 <= depths[nearest] < -0.003
    # Complete in itself: after the probe has left, nothing is listed.
    device.now_ns += 100 * MS
    device.ask(pressed(-0.02))
    peer.wait_for(lambda: len(surfaces) >= 2, "the next surface")
    assert len(surfaces[-1].vertex) == 0


def test_the_surface_is_published_at_its_rate_of_stamps_and_not_of_the_clock(start):
    program, peer = start({**SCENE, "surface.rate": 50.0})
    surfaces = peer.heard(SurfaceDisplacement, "surface_displacement", reliable(100))
    device = Device(peer)
    for _ in range(400):
        device.send(pressed(0.002))
    peer.wait_for(lambda: len(device.forces) >= 400, "400 forces")
    peer.spin(0.2)
    assert len(surfaces) == 20
    gaps = {graph.stamp_of(b) - graph.stamp_of(a) for a, b in zip(surfaces, surfaces[1:])}
    assert gaps == {20 * MS}


def test_a_surface_rate_of_zero_leaves_the_topic_out(start):
    program, peer = start({**SCENE, "surface.rate": 0.0})
    device = Device(peer)
    device.ask(pressed(0.002))
    topics = {name for name, _ in peer.node.get_topic_names_and_types()}
    assert "/contact_state" in topics and "/surface_displacement" not in topics


def test_a_mesh_in_millimetres_is_used_with_a_warning(start):
    program, peer = start({**SCENE, "body.scale": 1000.0})
    assert "body.scale" in program.log() and "80" in program.log()
    level, summary, _ = peer.new_status("/deformation: body")
    assert level == 1 and "body.scale" in summary


def test_a_stiff_nodule_is_found_by_sliding_over_it(start, tmp_path):
    nodule_x, radius_m, factor = 0.02, 0.012, 5.0
    ball = [str(value) for value in (nodule_x, 0.0, graph.BLOCK_TOP_M, radius_m, factor)]
    command = [graph.PROGRAMS / "rhombus", "mesh", "stiffness", "block", "--ball", *ball]
    subprocess.run([*command, "--out", tmp_path / "nodule.csv"], check=True, capture_output=True)
    program, peer = start({**SCENE, "body.stiffness_map": "nodule.csv"})
    device = Device(peer)
    depth_m = 0.003
    tissue_n = graph.library_force_n(program.file, depth_m)
    slide = {}
    for mm in range(-30, 42, 2):
        force, law, state = device.ask(pressed(depth_m, x=0.001 * mm, y=0.0))
        slide[mm] = force_of(force)
        assert state.force == approx(force_of(force)[2]) == approx(law.stiffness_factor * tissue_n)
        g, f = vector(law.stiffness_gradient), force_of(force)
        # Sideways it is the stored energy times the gradient; the law is nearly straight.
        assert (f[0], f[1]) == approx([-c * 0.5 * depth_m * tissue_n for c in g[:2]], rel=0.05, abs=1e-9)
    stiffest = max(slide, key=lambda mm: slide[mm][2])
    assert abs(stiffest - 1000 * nodule_x) <= 4, slide
    assert slide[stiffest][2] == approx(factor * tissue_n, rel=0.05)
    assert slide[-20] == approx((0.0, 0.0, tissue_n)), "beside it the tissue is as the chains say"
    assert slide[10][0] < -0.1 * tissue_n and slide[30][0] > 0.1 * tissue_n, "pushed off its edges"


def test_a_stiffness_map_of_another_mesh_stops_the_start_with_file_and_count(tmp_path):
    (tmp_path / "map.csv").write_text("factor\n1.0\n2.0\n")
    program = Program(tmp_path, "deformation", {**SCENE, "body.stiffness_map": "map.csv"})
    try:
        assert program.process.wait(graph.TIMEOUT_S) != 0
        assert "map.csv: body.stiffness_map: 2 stiffness factors; accepted: one for each of the mesh's" in program.log()
    finally:
        program.kill()
