"""The visualization node over DDS: what a viewer gets to see of a body, a contact and its chains.

The real executable stands between a peer that speaks as device and model do and a peer that reads as RViz does.
"""

import math
import struct
import time
import zlib
from pathlib import Path

import numpy
import peer
import pytest
import rclpy
import yaml
from geometry_msgs.msg import Point, PoseStamped, WrenchStamped
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rhombus_haptics_msgs.msg import ContactState, SurfaceDisplacement
from shape_msgs.msg import Mesh, MeshTriangle
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

REPOSITORY = Path(__file__).resolve().parents[2]
LATCHED = peer.latched(10)

# One chain, as in the model's second golden value, pressed by 6 mm.
ROD_LENGTH_M, ANGLE_RAD, RATIO, UNITS = 0.01, math.pi / 6, 0.8, 12
DEPTH_M, GOLDEN_DL_1_M = 0.006, -0.0012885483697159
CHAIN = {
    "chains.rod_length": [ROD_LENGTH_M],
    "chains.angle": [ANGLE_RAD],
    "chains.ratio": [RATIO],
    "chains.units": [UNITS],
    "chains.normal_stiffness": [500.0],
    "chains.tangential_stiffness": [100.0],
    "chains.tangential_growth": [10.0],
}


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


class Session(peer.Peer):
    """The node's process, and the peers around it in one rclpy node."""

    def __init__(self, folder, namespace, values):
        super().__init__(namespace)
        self.namespace = namespace
        self.program = peer.Program(folder, "visualization", values, namespace)
        self.static_transforms = {}
        self.node.create_subscription(TFMessage, "/tf_static", self.hear_static, LATCHED)
        self.program.wait_ready()

    def hear_static(self, message):
        self.static_transforms.update({each.child_frame_id: each for each in message.transforms})

    def publish(self, topic, message, qos=10):
        super().publish(message, topic, qos)

    def wait_for(self, condition, what, meanwhile=lambda: None):
        def met():
            assert self.program.process.poll() is None, self.program.log()
            meanwhile()
            return condition()

        super().wait_for(met, what)

    def reports(self):
        """What diagnostics said so far: level, summary, values."""
        return self.statuses.get(f"/{self.namespace}/visualization: markers", [])

    def value(self, key):
        """A number from the newest diagnostics."""
        return float(self.reports()[-1][2][key]) if self.reports() else None

    def fresh_value(self, key):
        """The same, from diagnostics made after this call."""
        return float(self.new_status(f"/{self.namespace}/visualization: markers")[2][key])

    def set(self, name, value):
        if isinstance(value, bool):
            value = ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=value)
        else:
            value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        return self.call(SetParameters, f"/{self.namespace}/visualization/set_parameters", request).results[0]

    def close(self):
        self.program.kill()
        super().close()


class Viewer:
    """Reads markers and keeps them as RViz does."""

    def __init__(self, session):
        self.session = session
        self.shown = {}
        self.arrivals = []
        topic = session.node.create_subscription(MarkerArray, "markers", self.hear, 10)
        self.close = lambda: session.node.destroy_subscription(topic)

    def hear(self, message):
        for marker in message.markers:
            key = (marker.ns, marker.id)
            self.arrivals.append((time.monotonic(), key))
            if marker.action == Marker.DELETE:
                self.shown.pop(key, None)
            else:
                self.shown[key] = marker

    def names(self):
        return {name for name, _ in self.shown}

    def lowest(self):
        """z of the body's lowest corner, m."""
        return points(self.shown["body", 0])[:, 2].min() if "body" in self.names() else 0.0

    def lightest(self):
        """Brightness of the body's lightest corner."""
        return max(colour.r + colour.g + colour.b for colour in self.shown["body", 0].colors)

    def count(self, name):
        return sum(key[0] == name for _, key in self.arrivals)


@pytest.fixture
def start(tmp_path, request):
    sessions = []

    def started(values=None):
        namespace = f"{request.node.name[-40:]}_{len(sessions)}"
        sessions.append(Session(tmp_path, namespace, values or {"visualization.rate": 30.0}))
        return sessions[-1]

    yield started
    for session in sessions:
        session.close()


def points(marker):
    return numpy.array([[point.x, point.y, point.z] for point in marker.points])


def grid_mesh(cells=20, size_m=0.1):
    """A square plate in the plane z = 0 around the origin."""
    line = numpy.linspace(-size_m / 2, size_m / 2, cells + 1)
    vertices = [(x, y, 0.0) for y in line for x in line]
    triangles = []
    for row in range(cells):
        for column in range(cells):
            a = row * (cells + 1) + column
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            triangles += [(a, b, d), (a, d, c)]
    return vertices, triangles


def mesh_message(vertices, triangles):
    return Mesh(
        vertices=[Point(x=x, y=y, z=z) for x, y, z in vertices],
        triangles=[MeshTriangle(vertex_indices=list(triangle)) for triangle in triangles],
    )


def topology_version(vertices, triangles):
    text = b"".join(struct.pack("<3d", *vertex) for vertex in vertices)
    return zlib.crc32(text + b"".join(struct.pack("<3I", *triangle) for triangle in triangles))


VERTICES, TRIANGLES = grid_mesh()
CENTRE = len(VERTICES) // 2


def displacement(vertex, z_m, version=None):
    version = topology_version(VERTICES, TRIANGLES) if version is None else version
    return SurfaceDisplacement(
        topology_version=version, vertex=list(vertex), displacement=[value for _ in vertex for value in (0.0, 0.0, z_m)]
    )


def contact(mode=ContactState.CONTACT, frame_id="device_base"):
    state = ContactState(mode=mode)
    state.header.frame_id = frame_id
    state.probe.z = 0.005 - DEPTH_M
    if mode != ContactState.NONE:
        state.normal.z, state.depth, state.force = 1.0, DEPTH_M, 0.4
    return state


def wrench(newton, frame_id="device_base"):
    message = WrenchStamped()
    message.header.frame_id = frame_id
    message.wrench.force.z = newton
    return message


def pose(frame_id="device_base"):
    message = PoseStamped()
    message.header.frame_id = frame_id
    message.header.stamp.sec = 12
    message.pose.position.z = 0.005 - DEPTH_M
    message.pose.orientation.w = 1.0
    return message


def shifted(x=0.0, z=0.0):
    """A pose parameter."""
    return [x, 0.0, z, 0.0, 0.0, 0.0, 1.0]


def press(session, device=""):
    """What device and model say while the probe presses."""
    topic = (device + "/{}").format if device else "{}".format
    session.publish(topic("contact_state"), contact())
    session.publish(topic("servo_cf"), wrench(0.4))
    session.publish(topic("measured_cp"), pose())


def test_the_body_is_drawn_with_every_triangle_and_moves_with_its_displacement(start):
    session = start({"body.frame_id": "organ"})
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    viewer = Viewer(session)
    session.wait_for(lambda: "body" in viewer.names(), "the body")
    body = viewer.shown["body", 0]
    assert (body.type, body.header.frame_id) == (Marker.TRIANGLE_LIST, f"{session.namespace}/organ")
    assert len(body.points) == len(body.colors) == 3 * len(TRIANGLES)
    expected = numpy.array([VERTICES[vertex] for triangle in TRIANGLES for vertex in triangle])
    assert numpy.array_equal(points(body), expected)

    before = viewer.count("body")
    session.publish("surface_displacement", displacement([CENTRE, CENTRE + 1], -0.004))
    session.wait_for(lambda: viewer.count("body") > before, "the deformed body")
    moved = numpy.flatnonzero(points(viewer.shown["body", 0])[:, 2])
    corners = [vertex for triangle in TRIANGLES for vertex in triangle]
    assert {corners[i] for i in moved} == {CENTRE, CENTRE + 1}
    assert numpy.allclose(points(viewer.shown["body", 0])[moved, 2], -0.004, atol=1e-9)
    rest, pressed = (viewer.shown["body", 0].colors[i] for i in (0, moved[0]))
    assert pressed.r + pressed.g + pressed.b > rest.r + rest.g + rest.b + 0.3, "more displacement is lighter"
    assert session.fresh_value("moved_vertices") == 2


def test_a_contact_is_drawn_and_deleted_when_the_probe_leaves(start):
    session = start({"probe.radius": 0.005, "visualization.force_scale": 0.1, **CHAIN})
    viewer = Viewer(session)
    complete = {"probe", "proxy", "force", "chains"}
    session.wait_for(lambda: viewer.names() == complete, "the contact", lambda: press(session))
    probe, arrow = viewer.shown["probe", 0], viewer.shown["force", 0]
    assert (probe.type, probe.scale.x, probe.header.frame_id) == (Marker.SPHERE, 0.01, "device_base")
    assert probe.pose.position.z == pytest.approx(0.005 - DEPTH_M, abs=1e-15)
    assert arrow.type == Marker.ARROW
    assert points(arrow)[1] - points(arrow)[0] == pytest.approx([0, 0, 0.04], abs=1e-15)
    assert viewer.shown["proxy", 0].pose.position.z == 0.0

    def leave():
        session.publish("contact_state", contact(ContactState.NONE))
        session.publish("servo_cf", wrench(0.0))

    session.wait_for(lambda: viewer.names() == {"probe"}, "what belonged to the contact is deleted", leave)
    session.wait_for(lambda: not viewer.shown, "the probe of a silent device is deleted")


def test_the_chains_are_drawn_as_the_model_stretches_them(start):
    session = start(CHAIN)
    viewer = Viewer(session)
    session.wait_for(lambda: "chains" in viewer.names(), "the chains", lambda: press(session))
    kinds = [{marker.type for (name, i), marker in viewer.shown.items() if name == "chains" and i % 3 == part} for part in range(3)]
    assert kinds == [{Marker.LINE_LIST}, {Marker.LINE_LIST}, {Marker.SPHERE_LIST}], "rods, springs, mass points"
    # Four rods for each unit, from the tip at the contact around to it again. One marker for each class of sizes.
    rods = [points(marker) for (name, i), marker in viewer.shown.items() if name == "chains" and i % 3 == 0]
    units = numpy.concatenate(rods).reshape(-1, 4, 2, 3)
    row = units[(abs(units[:, 1, 1, 1]) < 1e-12) & (units[:, 1, 1, 0] > 0)]
    row = row[numpy.argsort(row[:, 1, 1, 0])]
    assert 8 <= len(row) <= UNITS and len(units) == 4 * len(row), "four rows, one of them along x"
    assert row[0, 0, 0] == pytest.approx([0, 0, -DEPTH_M], abs=1e-15), "the contact point moves by the depth"
    lengths = numpy.linalg.norm(row[:, :, 1] - row[:, :, 0], axis=2)
    for unit, four in enumerate(lengths):
        assert four == pytest.approx(ROD_LENGTH_M * RATIO**unit, abs=1e-12)
    heights = -DEPTH_M - numpy.cumsum(GOLDEN_DL_1_M * RATIO ** numpy.arange(len(row)))
    assert row[:, 1, 1, 2] == pytest.approx(heights, abs=1e-12), "tips are as high as the model's units"
    angle = math.asin(math.sin(ANGLE_RAD) + GOLDEN_DL_1_M / (2 * ROD_LENGTH_M))
    diagonal = numpy.linalg.norm(row[0, 1, 1] - row[0, 0, 0])
    assert diagonal == pytest.approx(2 * ROD_LENGTH_M * math.cos(angle), abs=1e-12)

    assert session.set("visualization.show_chains", False).successful
    session.wait_for(lambda: "chains" not in viewer.names(), "no chains", lambda: press(session))


def test_nothing_is_drawn_while_nobody_reads_the_markers(start):
    session = start()
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    for _ in range(20):
        press(session)
        session.publish("surface_displacement", displacement([CENTRE], -0.004))
        session.spin(0.05)
    assert session.fresh_value("pictures") == 0
    viewer = Viewer(session)
    session.wait_for(lambda: "body" in viewer.names(), "a picture for the first reader")
    assert viewer.lowest() == pytest.approx(-0.004, abs=1e-9), "with what was heard before"
    viewer.close()
    session.fresh_value("pictures")
    before = session.fresh_value("pictures")
    assert session.fresh_value("pictures") == before > 0


def test_an_idle_body_is_repeated_once_a_second_and_shown_to_a_late_reader_at_once(start):
    session = start()
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    first = Viewer(session)
    session.wait_for(lambda: first.count("body") >= 1, "the body")
    session.spin(3.0)
    assert 2 <= first.count("body") <= 5, "once a second, not at the rate of the pictures"
    before = first.count("body")
    late = Viewer(session)
    session.wait_for(lambda: late.count("body") >= 1, "the body for the late reader")
    assert first.count("body") <= before + 2


def test_nan_and_displacements_of_another_mesh_are_counted_and_not_drawn(start):
    session = start()
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    viewer = Viewer(session)
    session.publish("surface_displacement", displacement([CENTRE], -0.004))
    session.wait_for(lambda: viewer.lowest() < 0, "the deformed body")
    good = points(viewer.shown["body", 0])

    session.publish("surface_displacement", displacement([CENTRE], -0.002, version=1))
    session.wait_for(lambda: session.value("other_mesh") == 1, "the other mesh is counted")
    session.publish("surface_displacement", displacement([CENTRE], math.nan))
    session.wait_for(lambda: session.value("not_drawable") == 1, "NaN in a displacement is counted")
    session.publish("surface_displacement", displacement([len(VERTICES)], -0.002))
    session.wait_for(lambda: session.value("not_drawable") == 2, "a vertex that is none is counted")
    bad_state = contact()
    bad_state.proxy.x = math.nan
    session.publish("contact_state", bad_state)
    session.wait_for(lambda: session.value("not_drawable") == 3, "NaN in a contact is counted")
    bad_pose = pose()
    bad_pose.pose.orientation.w = 0.5
    # Poses are only looked at, so best effort: one of them alone may be lost.
    session.wait_for(
        lambda: session.value("not_drawable") > 3,
        "a quaternion that is no rotation is counted",
        meanwhile=lambda: session.publish("measured_cp", bad_pose),
    )
    assert any(level == 1 for level, _, _ in session.reports()), "diagnostics warn"

    session.spin(1.5)
    assert viewer.names() == {"body"}
    assert numpy.array_equal(points(viewer.shown["body", 0]), good)
    log = session.program.log()
    assert "surface_displacement is not drawn" in log and "mesh 00000001" in log, log


def test_a_mesh_that_cannot_be_drawn_is_counted_and_the_next_one_is_drawn(start):
    session = start()
    viewer = Viewer(session)
    session.publish("body_mesh", mesh_message([(0, 0, 0), (math.nan, 0, 0), (0, 1, 0)], [(0, 1, 2)]), LATCHED)
    session.wait_for(lambda: session.value("not_drawable") == 1, "the mesh is counted")
    session.publish("body_mesh", mesh_message([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 3)]), LATCHED)
    session.wait_for(lambda: session.value("not_drawable") == 2, "the second one too")
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    session.wait_for(lambda: "body" in viewer.names(), "the good mesh")


def test_body_device_and_probe_have_their_transforms(start):
    session = start({"body.pose": shifted(x=0.1), "device.scene_from_device": shifted(z=0.3)})
    ns = session.namespace
    session.wait_for(lambda: len(session.static_transforms) >= 2, "static transforms")
    body, device = session.static_transforms[f"{ns}/body"], session.static_transforms[f"{ns}/device_base"]
    assert body.header.frame_id == device.header.frame_id == f"{ns}/scene"
    assert (body.transform.translation.x, device.transform.translation.z) == (0.1, 0.3)

    heard = []
    session.node.create_subscription(TFMessage, "/tf", lambda message: heard.extend(message.transforms), 10)
    session.wait_for(lambda: heard, "the probe", lambda: session.publish("measured_cp", pose(f"{ns}/device_base")))
    probe = heard[0]
    assert probe.child_frame_id == f"{ns}/probe"
    assert (probe.header.frame_id, probe.header.stamp.sec) == (f"{ns}/device_base", 12)
    assert probe.transform.translation.z == pytest.approx(0.005 - DEPTH_M, abs=1e-15)


def test_each_device_has_its_own_markers_and_frames(start):
    session = start({"devices": ["left", "right"], **CHAIN})
    viewer = Viewer(session)
    both = {(name, i) for name in ("probe", "force", "proxy") for i in (0, 1)} | {("chains", 0), ("chains", 12)}

    def press_both():
        press(session, "left")
        press(session, "right")

    session.wait_for(lambda: both <= viewer.shown.keys(), "two contacts", press_both)
    # Where several devices stand is for their drivers to say.
    session.wait_for(lambda: session.static_transforms, "a static transform")
    assert session.static_transforms.keys() == {f"{session.namespace}/body"}
    session.wait_for(lambda: ("probe", 1) not in viewer.shown, "right is silent", lambda: press(session, "left"))
    assert ("probe", 0) in viewer.shown


def test_looks_can_be_changed_while_the_node_runs(start):
    session = start()
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    session.publish("surface_displacement", displacement([CENTRE], -0.001))
    viewer = Viewer(session)
    session.wait_for(lambda: math.isclose(viewer.lowest(), -0.001, abs_tol=1e-9), "the deformed body")
    before = viewer.lightest()
    assert session.set("visualization.displacement_scale", 3.0).successful
    session.wait_for(lambda: math.isclose(viewer.lowest(), -0.003, abs_tol=1e-8), "it is drawn three times as deep")
    assert viewer.lightest() == before, "colours show the true displacement"
    assert session.set("visualization.full_scale", 0.001).successful
    session.wait_for(lambda: viewer.lightest() > before, "1 mm is now the end of the scale")
    refused = session.set("visualization.full_scale", 0.0)
    assert not refused.successful and "full_scale" in refused.reason
    assert session.set("visualization.rate", 0.0).successful
    session.spin(0.5)
    count = viewer.count("body")
    session.spin(1.5)
    assert viewer.count("body") == count, "rate 0 publishes none"


def test_a_viewer_hears_without_shared_memory_which_a_stopped_one_would_fill(tmp_path):
    # Where discovery is kept to this machine the middleware itself adds shared memory.
    environment = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}
    for choice, has_memory in [({}, False), ({"FASTDDS_BUILTIN_TRANSPORTS": "DEFAULT"}, True)]:
        folder = tmp_path / str(has_memory)
        program = peer.Program(folder, "visualization", CHAIN, environment={**environment, **choice})
        try:
            program.wait_ready()
            process = Path(f"/proc/{program.process.pid}")
            assert ("/dev/shm/fastrtps" in (process / "maps").read_text()) == has_memory
            assert (process / "comm").read_text().startswith("visualization")
        finally:
            program.kill()


def test_sigint_ends_the_node_with_a_report(start):
    session = start()
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)
    viewer = Viewer(session)
    session.wait_for(lambda: "body" in viewer.names(), "the body")
    code, _ = session.program.interrupt()
    report = session.program.closing_report()
    assert code == 0 and report["markers"] >= 1 and report["not_drawn"] == 0


def test_the_rviz_layout_names_only_what_a_session_publishes(tmp_path):
    layout = yaml.safe_load((REPOSITORY / "config" / "session.rviz").read_text())["Visualization Manager"]
    displays = {display["Class"].split("/")[1]: display for display in layout["Displays"]}
    markers, wrench = displays["MarkerArray"], displays["Wrench"]
    types = {"MarkerArray": "visualization_msgs/msg/MarkerArray", "Wrench": "geometry_msgs/msg/WrenchStamped"}

    scene = (REPOSITORY / "config" / "liver.yaml").read_text()
    programs = []
    rviz = peer.Peer()
    node = rviz.node
    heard = {"frames": {}, "names": set(), "frame_ids": set()}

    def hear_transforms(message):
        heard["frames"].update({each.child_frame_id: each.header.frame_id for each in message.transforms})

    def hear_markers(message):
        added = [marker for marker in message.markers if marker.action == Marker.ADD]
        heard["names"] |= {marker.ns for marker in added}
        heard["frame_ids"] |= {marker.header.frame_id for marker in added}

    def hear_wrench(message):
        heard["frame_ids"].add(message.header.frame_id)

    node.create_subscription(TFMessage, "/tf_static", hear_transforms, LATCHED)
    node.create_subscription(TFMessage, "/tf", hear_transforms, 100)
    node.create_subscription(MarkerArray, markers["Topic"]["Value"], hear_markers, qos_of(markers["Topic"]))
    node.create_subscription(WrenchStamped, wrench["Topic"]["Value"], hear_wrench, qos_of(wrench["Topic"]))
    try:
        for name in ("deformation", "visualization", "haptic_device"):
            programs.append(peer.Program(tmp_path, name, scene).wait_ready())
        seen = lambda: heard["names"] == set(markers["Namespaces"]) and "probe" in heard["frames"]
        rviz.wait_for(seen, "every namespace of the layout, and the probe's frame", 60)
        for kind, display in displays.items():
            if "Topic" in display:
                publishers = node.get_publishers_info_by_topic(node.resolve_topic_name(display["Topic"]["Value"]))
                assert [each.topic_type for each in publishers] == [types[kind]], kind
        for frame in heard["frame_ids"] | {"probe"}:
            while frame in heard["frames"]:
                frame = heard["frames"][frame]
            assert frame == layout["Global Options"]["Fixed Frame"]
    finally:
        for program in programs:
            program.kill()
        rviz.close()


def qos_of(topic):
    """What RViz asks for: a subscription that asks for more than is offered hears nothing."""
    return QoSProfile(
        depth=topic["Depth"],
        reliability=ReliabilityPolicy[topic["Reliability Policy"].upper().replace(" ", "_")],
        durability=DurabilityPolicy[topic["Durability Policy"].upper().replace(" ", "_")],
    )
