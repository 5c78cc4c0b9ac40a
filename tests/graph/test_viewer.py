"""The viewer over real DDS and a real WebSocket: what pages are shown and told, what they may do, what is refused.

The real executable stands between a peer that speaks as device, model and driver do and pages that may misbehave.
"""

import math
import re
import signal
import socket
import time

import numpy
import peer
import pytest
import rclpy
from crtk_msgs.msg import OperatingState
from geometry_msgs.msg import PoseStamped, TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import GetParameters
from rhombus_haptics_msgs.msg import ContactState
from std_msgs.msg import Bool
from test_visualization import (
    CENTRE,
    CHAIN,
    DEPTH_M,
    TRIANGLES,
    VERTICES,
    Session,
    contact,
    displacement,
    grid_mesh,
    mesh_message,
    pose,
    press,
    topology_version,
)
from tf2_msgs.msg import TFMessage
from websocket import BINARY, MESH, STATE, SURFACE, TEXT, Page, frame, request

LATCHED = peer.latched(10)


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


class Viewed(Session):
    """The node, the peers around it, and its pages."""

    def __init__(self, folder, namespace, values):
        self.pages = []
        super().__init__(folder, namespace, {"viewer.port": 0, **values})
        self.port = int(re.search(r"viewer: http://127\.0\.0\.1:(\d+)/", self.program.log())[1])

    def page(self, **options):
        page = Page(self.port, **options)
        assert page.status == 101
        self.pages.append(page)
        return page

    def wait_for(self, condition, what, meanwhile=lambda: None):
        def polled():
            meanwhile()
            for page in self.pages:
                page.poll()

        super().wait_for(condition, what, polled)

    def spin(self, seconds, meanwhile=lambda: None):
        end = time.monotonic() + seconds
        self.wait_for(lambda: time.monotonic() >= end, "the end of a pause", meanwhile)

    def viewer_value(self, key):
        """A number from diagnostics made after this call."""
        return float(self.new_status(f"/{self.namespace}/visualization: viewer")[2][key])

    def close(self):
        for page in self.pages:
            page.close()
        super().close()


@pytest.fixture
def start(tmp_path, request):
    sessions = []

    def started(values=None):
        namespace = f"{request.node.name[-40:]}_{len(sessions)}"
        sessions.append(Viewed(tmp_path / str(len(sessions)), namespace, values or {}))
        return sessions[-1]

    yield started
    for session in sessions:
        session.close()


def plate(session):
    """The plate of the neighbours' tests as the body."""
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)


def body_is_scene(session):
    """A device whose base stands in the scene, under the name that the messages have."""
    transform = TransformStamped(child_frame_id="device_base")
    transform.header.frame_id = f"{session.namespace}/scene"
    transform.transform.rotation.w = 1.0
    session.publish("/tf_static", TFMessage(transforms=[transform]), peer.latched(100))


def test_a_page_is_greeted_then_shown_mesh_surface_and_state_as_the_topics_say(start):
    session = start({"body.pose": [0.1, 0.0, 0.0, 0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)], **CHAIN})
    plate(session)
    body_is_scene(session)
    heard = displacement([CENTRE, CENTRE + 1, 7], -0.004)
    heard.displacement[0] = 0.1234567
    heard.header.stamp.sec, heard.header.stamp.nanosec = 12, 500_000_000
    session.publish("surface_displacement", heard)
    page = session.page()
    session.wait_for(lambda: page.shown[SURFACE] and len(page.surface()[2]) == 3, "the surface", lambda: press(session))
    assert page.order[0] == "hello"
    assert page.order.index(MESH) < page.order.index(SURFACE) < page.order.index(STATE)
    hello = page.last("hello")
    assert (hello["protocol"], hello["devices"], hello["body_frame"]) == (1, [""], f"{session.namespace}/body")

    version, positions, corners, factors = page.mesh()
    assert version == topology_version(VERTICES, TRIANGLES)
    assert numpy.array_equal(positions, numpy.array(VERTICES, "f4"))
    assert numpy.array_equal(corners, numpy.array(TRIANGLES)) and factors is None
    surface_version, stamp_s, vertices, moved = page.surface()
    assert (surface_version, stamp_s) == (version, 12.5)
    assert list(vertices) == list(heard.vertex), "the bits that were heard"
    assert moved.tobytes() == numpy.array(heard.displacement, "f4").tobytes()

    all_heard = lambda: page.states()["flags"][0] & 7 == 7
    session.wait_for(all_heard, "contact, force and pose", lambda: press(session))
    state = page.states()[0]
    # The body stands 0.1 m along x of the scene and is turned by a quarter: the probe over the scene's origin is at y = 0.1.
    assert state["mode"] == 1
    assert state["probe"] == pytest.approx([0, 0.1, 0.005 - DEPTH_M], abs=1e-7)
    assert state["proxy"] == pytest.approx([0, 0.1, 0], abs=1e-7)
    assert state["quaternion"] == pytest.approx([0, 0, -math.sqrt(0.5), math.sqrt(0.5)], abs=1e-6)
    assert (state["depth_m"], state["normal_force_n"]) == pytest.approx((DEPTH_M, 0.4))
    assert state["force"] == pytest.approx([0, 0, 0.4], abs=1e-7)
    assert math.isnan(state["latency_s"]), "a stamp of 1970 is of another clock"
    chain = page.last("chains")["chains"][0]
    assert (chain["units"], chain["ratio"]) == (CHAIN["chains.units"][0], 0.8)


def test_latency_is_the_age_of_the_pose_when_its_contact_is_heard(start):
    session = start()
    body_is_scene(session)
    page = session.page()

    def press_now():
        state = contact()
        state.header.stamp = session.node.get_clock().now().to_msg()
        session.publish("contact_state", state)

    heard = lambda: page.shown[STATE] and math.isfinite(page.states()["latency_s"][0])
    session.wait_for(heard, "a latency", press_now)
    assert 0 < page.states()["latency_s"][0] < 0.2


def test_updates_come_at_the_rate_and_rest_when_nothing_changes(start):
    session = start()
    plate(session)
    body_is_scene(session)
    page = session.page()
    depth = iter(range(1, 1_000_000))

    def move():
        n = next(depth)
        session.publish("surface_displacement", displacement([CENTRE], -1e-6 * n))
        state = contact()
        state.depth = 1e-6 * n
        session.publish("contact_state", state)

    session.wait_for(lambda: len(page.shown[SURFACE]) > 5, "surfaces", move)
    before = len(page.shown[SURFACE])
    session.spin(3.0, move)
    rate_hz = (len(page.shown[SURFACE]) - before) / 3.0
    # The peer itself publishes at some 50 Hz.
    assert 20 < rate_hz < 61, rate_hz
    session.spin(1.5)
    surfaces, states = len(page.shown[SURFACE]), len(page.shown[STATE])
    session.spin(2.0)
    assert len(page.shown[SURFACE]) == surfaces, "a surface that rests is not sent again"
    assert 7 <= len(page.shown[STATE]) - states <= 10, "four states a second"


def test_without_a_page_nothing_is_encoded_and_a_late_page_gets_everything(start):
    session = start()
    plate(session)
    for _ in range(20):
        press(session)
        session.publish("surface_displacement", displacement([CENTRE], -0.004))
        session.spin(0.02)
    assert session.viewer_value("sent_messages") == 0
    page = session.page()
    session.wait_for(lambda: page.shown[SURFACE], "the surface for the first page")
    assert list(page.surface()[2]) == [CENTRE], "with what was heard before"
    first = page.last("hello")["boot_id"]
    page.close()
    session.pages.clear()
    session.wait_for(lambda: session.viewer_value("pages") == 0, "the page is gone")
    again = session.page()
    session.wait_for(lambda: again.shown[SURFACE] and again.shown[MESH], "everything for the next page")
    assert again.last("hello")["boot_id"] == first
    code, _ = session.program.interrupt()
    report = session.program.closing_report()
    assert code == 0 and report["viewer"]["sent_messages"] > 5
    session.wait_for(lambda: again.closed, "the page sees the end") if session.program.process.poll() is None else None


def test_a_node_that_starts_again_is_another_one(start):
    boots = []
    for session in (start(), start()):
        page = session.page()
        session.wait_for(lambda page=page: page.said("hello"), "hello")
        boots.append(page.last("hello")["boot_id"])
    assert boots[0] != boots[1] and all(len(boot) == 16 for boot in boots)


def test_files_are_served_with_headers_that_bind_the_page_to_itself(start):
    session = start()
    status, headers, body = request(session.port)
    assert status == 200 and b"<!doctype html>" in body.lower()
    assert headers["content-type"] == "text/html; charset=utf-8"
    assert f"connect-src 'self' ws://127.0.0.1:{session.port};" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff" and headers["cache-control"] == "no-cache"
    assert request(session.port, headers={"If-None-Match": headers["etag"]})[0] == 304
    for path in ("/viewer.js", "/viewer.css", "/icon.svg", "/LICENCES.txt", "/index.html"):
        assert request(session.port, path)[0] == 200, path
    for path in ("/..%2f..%2fetc/passwd", "/dist/", "/nothing", "//"):
        assert request(session.port, path)[0] == 404, path


def test_a_foreign_origin_and_a_foreign_host_are_forbidden(start):
    session = start()
    port = session.port
    foreign = [
        {"Origin": "http://evil.example"},
        {"Origin": f"http://127.0.0.1:{port + 1}"},
        {"Origin": "null"},
        {"Host": f"evil.example:{port}", "Origin": f"http://evil.example:{port}"},
        {"Host": "127.0.0.1"},
        {"Host": None},
    ]
    for headers in foreign:
        status, _, body = request(port, headers=headers) if headers.get("Host", "") is not None else (403, {}, b"accepted")
        assert status == 403 and b"accepted" in body, (headers, body)
        page = Page(port, headers=headers)
        assert page.status in (400, 403), headers
        page.close()
    assert request(port, headers={"Host": f"localhost:{port}"})[0] == 200
    assert session.page(headers={"Origin": None}).status == 101, "what is no browser has no origin"
    assert session.page(headers={"Host": f"localhost:{port}", "Origin": f"http://localhost:{port}"}).status == 101


def test_a_thousand_connections_are_bounded_told_why_and_do_not_stop_the_node(start):
    session = start()
    page = session.page()
    session.wait_for(lambda: page.said("status"), "a page that was there before")
    connections, told = [], 0
    for _ in range(1000):
        connection = socket.create_connection(("127.0.0.1", session.port), 5.0)
        connections.append(connection)
    end = time.monotonic() + 10.0
    for connection in connections[::-1]:
        connection.settimeout(max(0.01, min(0.05, end - time.monotonic())))
        try:
            answer = connection.recv(4096)
        except (TimeoutError, ConnectionError):
            continue
        told += answer.startswith(b"HTTP/1.1 503") and b"connections at once" in answer
    assert told >= 800, told
    before = len(page.said("status"))
    session.wait_for(lambda: len(page.said("status")) >= before + 4, "the node still speaks to its page")
    assert session.set("viewer.rate", 30.0).successful, "and answers on ROS"
    for connection in connections:
        connection.close()
    session.wait_for(lambda: request(session.port)[0] == 200, "and serves again")


def test_idle_connections_do_not_pile_up(start):
    session = start()
    idle = [socket.create_connection(("127.0.0.1", session.port), 5.0) for _ in range(64)]
    idle[0].sendall(b"GET / HTTP/1.1\r\n")
    started = time.monotonic()
    for connection in idle:
        connection.settimeout(15.0)
        while connection.recv(4096):
            pass
    assert time.monotonic() - started < 14.0
    assert request(session.port)[0] == 200


def test_a_page_too_many_is_told_why(start):
    session = start({"viewer.max_pages": 2})
    pages = [session.page() for _ in range(3)]
    session.wait_for(lambda: pages[2].closed, "the third page is closed")
    assert pages[2].closed[0] == 1013
    assert "viewer.max_pages" in pages[2].last("refused")["reason"] and not pages[2].said("hello")
    pages[0].close()
    session.pages.remove(pages[0])

    def comes_in():
        late = session.page()
        session.wait_for(lambda: late.order, "an answer")
        return late.order[0] == "hello"

    session.wait_for(comes_in, "a place that is free again")


def test_garbage_is_refused_and_too_much_of_it_closes_the_page(start):
    session = start()
    page, other = session.page(), session.page()
    garbage = [b"", b"{", b"[]", b'{"type":"format_disk"}', b'{"type":"ping"}', b"\xf0\x9f\x92\xa9", b"[" * 60_000]
    for payload in garbage:
        page.send_frame(TEXT, payload)
    page.send_frame(BINARY, bytes(range(256)))
    page.send(type="pointer_target", device="", sequence=1, position=[0, 0, 0], grasp=False)
    page.send(type="pointer_target", device="nobody", sequence=1, position=[0, 0, 0], grasp=False)
    page.send(type="pointer_release", device="")
    page.send(type="set_parameter", id=3, name="no.such", value=1)
    page.send(type="ping", t=1.5)
    session.wait_for(lambda: page.last("pong") == {"type": "pong", "t": 1.5}, "a page that said nonsense is still heard")
    session.wait_for(lambda: len(page.said("refused")) == len(garbage) + 4, "one refusal for each")
    assert all("accepted" in refused["reason"] or "pointer_take" in refused["reason"] for refused in page.said("refused"))
    session.wait_for(lambda: page.said("parameter_result"), "an answer about the parameter")
    assert not page.last("parameter_result")["ok"] and "no.such" in page.last("parameter_result")["reason"]

    for _ in range(100):
        page.send_frame(TEXT, b"nonsense")
    session.wait_for(lambda: page.closed, "the end of patience")
    assert page.closed[0] == 1008
    other.send(type="ping", t=2)
    session.wait_for(lambda: other.last("pong"), "the other page does not notice")


def test_an_oversize_message_is_refused_with_the_limit(start):
    session = start()
    page = session.page()
    page.send_frame(TEXT, b'{"type":"ping","t":' + b" " * 70_000 + b"1}")
    session.wait_for(lambda: page.closed, "the end")
    assert page.closed[0] == 1009 and "65536" in page.last("refused")["reason"]
    broken = session.page()
    broken.socket.sendall(b"\xff\xff\xff\xff garbage in place of frames")
    session.wait_for(lambda: broken.closed, "the end of a broken stream")
    assert request(session.port)[0] == 200


def test_a_flood_of_messages_is_limited(start):
    session = start()
    page = session.page()
    page.socket.sendall(b"".join(frame(TEXT, b'{"type":"ping","t":1}') for _ in range(3000)))
    session.wait_for(lambda: page.closed, "the end of a flood")
    assert page.closed[0] == 1008 and "second" in page.said("refused")[0]["reason"]
    assert len(page.said("pong")) == 1000


def test_a_stalled_page_is_dropped_for_alone(start):
    session = start()
    vertices, triangles = grid_mesh(cells=60)
    session.publish("body_mesh", mesh_message(vertices, triangles), LATCHED)
    version = topology_version(vertices, triangles)
    stalled, reading = session.page(receive_bytes=4096), session.page()
    session.pages.remove(stalled)
    numbers = iter(range(1, 1_000_000))

    published = []

    def move():
        z_m = -1e-6 * next(numbers)
        session.publish("surface_displacement", displacement(range(len(vertices)), z_m, version))
        published.append(time.monotonic())

    session.wait_for(lambda: len(reading.shown[SURFACE]) > 10, "surfaces", move)
    before = len(reading.shown[SURFACE])
    published.clear()
    session.spin(8.0, move)
    published_hz, shown_hz = len(published) / 8.0, (len(reading.shown[SURFACE]) - before) / 8.0
    assert shown_hz > 0.8 * min(published_hz, 60), (shown_hz, published_hz)
    times = [when for when, _ in reading.shown[SURFACE][before:]]
    longest_s = max(numpy.diff(times)) - max(numpy.diff(published))
    assert longest_s < 0.3, "the page that reads never waits for the one that does not"
    # It reads again: it is up to date with the next update, knows what it missed, and nobody kept more than a little for it.
    session.pages.append(stalled)
    session.wait_for(lambda: stalled.shown[STATE] and stalled.dropped() > 50, "the count of what was dropped", move)
    assert session.viewer_value("dropped_updates") > 50
    newest = reading.sequences(SURFACE)[-1]
    session.wait_for(lambda: stalled.sequences(SURFACE)[-1] >= newest, "the newest surface", move)
    assert len(stalled.shown[SURFACE]) < 0.7 * len(reading.shown[SURFACE])


def test_nan_is_not_sent_and_counted(start):
    session = start()
    plate(session)
    body_is_scene(session)
    page = session.page()
    session.wait_for(lambda: page.shown[SURFACE], "the plate")
    session.publish("surface_displacement", displacement([CENTRE], math.nan))
    session.publish("surface_displacement", displacement([CENTRE], -0.002, version=1))
    bad = contact()
    bad.stiffness = math.inf
    wrong = pose()
    wrong.pose.position.x = math.nan
    counted = lambda: (page.last("status") or {"not_drawn": {}})["not_drawn"] == {"not_drawable": 3, "other_mesh": 1}
    session.publish("contact_state", bad)
    session.publish("measured_cp", wrong)
    session.spin(0.5)
    if page.last("status")["not_drawn"]["other_mesh"] == 0:
        # Of two displacements in one turn only the newest is looked at.
        session.publish("surface_displacement", displacement([CENTRE], -0.002, version=1))
    if page.last("status")["not_drawn"]["not_drawable"] == 2:
        session.publish("surface_displacement", displacement([CENTRE], math.nan))
    session.wait_for(counted, "what is not drawn is counted")
    assert page.states()["flags"][0] == 0, "nothing of it is shown"
    assert all(len(page.surface(index)[2]) == 0 for index in range(len(page.shown[SURFACE])))
    for _, payload in page.shown[STATE]:
        positions = numpy.frombuffer(payload, "<f4", 16, 40)
        assert numpy.isfinite(positions).all()


def test_a_publisher_that_is_gone_is_said_within_a_second(start):
    session = start()
    plate(session)
    model = rclpy.create_node("model", namespace=session.namespace)
    publishers = [
        model.create_publisher(ContactState, "contact_state", peer.reliable(1000)),
        model.create_publisher(PoseStamped, "measured_cp", peer.reliable(1000)),
    ]
    model.create_publisher(OperatingState, "operating_state", LATCHED).publish(
        OperatingState(state="ENABLED", is_homed=True)
    )
    page = session.page()

    def speak():
        publishers[0].publish(contact())
        publishers[1].publish(pose())

    said = lambda: (page.last("status") or {"publishers": {}, "devices": [{}]})
    there = lambda: said()["publishers"].get("contact_state") == 1 and said()["devices"][0].get("alive")
    session.wait_for(there, "publishers", speak)
    session.wait_for(lambda: said()["devices"][0]["operating_state"] == "ENABLED", "the operating state", speak)
    assert said()["publishers"]["body_mesh"] == 1 and said()["devices"][0]["homed"]
    assert said()["devices"][0]["unplaced_frame"] == "device_base", "nothing says where the device stands"

    # It hangs: poses come, and no contact.
    begun = time.monotonic()
    session.wait_for(
        lambda: said()["publishers"]["contact_state"] == 0, "a model that is silent", lambda: publishers[1].publish(pose())
    )
    assert time.monotonic() - begun < 1.0
    session.wait_for(lambda: said()["publishers"]["contact_state"] == 1, "it speaks again", speak)
    begun = time.monotonic()
    model.destroy_node()
    session.wait_for(lambda: not said()["devices"][0]["alive"] and said()["publishers"]["contact_state"] == 0, "it is gone")
    assert time.monotonic() - begun < 1.0


def test_a_parameter_is_set_on_every_node_that_has_it_or_on_none(start, tmp_path):
    scene = {**peer.SCENE, "viewer.port": 0}
    session = start(scene)
    model = peer.Program(tmp_path, "deformation", scene, session.namespace).wait_ready()
    try:
        page = session.page()
        both = [f"/{session.namespace}/deformation", f"/{session.namespace}/visualization"]
        shown = lambda: {each["name"]: each for each in (page.last("parameters") or {"parameters": []})["parameters"]}
        stiffness = "chains.normal_stiffness"
        session.wait_for(lambda: shown().get(stiffness, {}).get("nodes") == both, "the parameters of both nodes")
        described = shown()[stiffness]
        assert (described["value"], described["type"], described["unit"]) == ([500.0], "double_array", "N/m")
        assert described["exclusive_min"] and described["min"] == 0.0 and "> 0" in described["accepted"]
        assert not any(name.startswith(("safety.", "device.", "unsafe.")) for name in shown())
        assert "body.mesh" not in shown(), "not live"

        def value_of(node):
            answer = session.call(GetParameters, f"{node}/get_parameters", GetParameters.Request(names=[stiffness]))
            return list(answer.values[0].double_array_value)

        def set_it(value):
            number = len(page.said("parameter_result")) + 1
            page.send(type="set_parameter", id=number, name=stiffness, value=value)
            session.wait_for(lambda: len(page.said("parameter_result")) == number, "the result")
            assert page.last("parameter_result")["id"] == number
            return page.last("parameter_result")

        assert set_it([650.0])["ok"]
        assert [value_of(node) for node in both] == [[650.0], [650.0]]
        session.wait_for(lambda: shown()[stiffness]["value"] == [650.0], "the new value on the page")
        session.wait_for(
            lambda: page.last("chains")["chains"][0]["normal_stiffness_n_per_m"] == 650.0, "the new chains"
        )
        for wrong, reason in [([-1.0], "> 0"), ([1e-9], "k"), ("stiff", "accepted"), ([1.0, 2.0], "chains")]:
            refused = set_it(wrong)
            assert not refused["ok"] and reason in refused["reason"], refused
        assert [value_of(node) for node in both] == [[650.0], [650.0]], "all or none"

        page.send(type="set_parameter", id=99, name="safety.max_speed", value=1.0)
        session.wait_for(lambda: page.last("parameter_result")["id"] == 99, "no protection is a page's to change")
        assert not page.last("parameter_result")["ok"]

        model.process.send_signal(signal.SIGSTOP)
        hung = set_it([700.0])
        model.process.send_signal(signal.SIGCONT)
        assert not hung["ok"] and "has not answered" in hung["reason"]
        session.spin(0.5)
        assert [value_of(node) for node in both] == [[650.0], [650.0]], "one that hung changes nothing when it goes on"
    finally:
        model.kill()


def test_a_node_that_refuses_what_others_accepted_has_it_taken_back(start):
    session = start()
    stubborn = rclpy.create_node("zz_stubborn", namespace=session.namespace)
    stubborn.declare_parameter("visualization.full_scale", 0.005)
    refuse = lambda parameters: SetParametersResult(successful=False, reason="not while I live")
    stubborn.add_on_set_parameters_callback(refuse)
    stubborn.create_publisher(ContactState, "contact_state", 10)
    page = session.page()
    answer = lambda: rclpy.spin_once(stubborn, timeout_sec=0)
    nodes = lambda: next(
        (each["nodes"] for each in (page.last("parameters") or {"parameters": []})["parameters"] if "full_scale" in each["name"]),
        [],
    )
    session.wait_for(lambda: len(nodes()) == 2, "the parameter of both nodes", answer)
    page.send(type="set_parameter", id=1, name="visualization.full_scale", value=0.009)
    session.wait_for(lambda: page.said("parameter_result"), "the result", answer)
    result = page.last("parameter_result")
    assert not result["ok"] and result["reason"] == f"/{session.namespace}/zz_stubborn: not while I live"
    request = GetParameters.Request(names=["visualization.full_scale"])
    values = session.call(GetParameters, f"/{session.namespace}/visualization/get_parameters", request).values
    assert values[0].double_value == 0.005
    stubborn.destroy_node()


def test_a_taken_port_is_an_error_that_names_a_free_one(start, tmp_path):
    session = start()
    second = peer.Program(tmp_path, "visualization", {"viewer.port": session.port}, "second")
    assert second.process.wait(20) != 0
    line = [line for line in second.log().splitlines() if "viewer.port" in line]
    assert len(line) == 1 and f"{session.port} at 127.0.0.1 is taken" in line[0], second.log()
    free = int(re.search(r"(\d+) is free", line[0])[1])
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", free))
    unknown = peer.Program(tmp_path, "visualization", {"viewer.address": "no.such.host.invalid"}, "third")
    assert unknown.process.wait(20) != 0 and "viewer.address" in unknown.log()
    without = peer.Program(tmp_path, "visualization", {"viewer.enabled": False, "viewer.port": session.port}, "fourth")
    without.wait_ready()
    assert "viewer:" not in without.log()
    without.kill()


def test_a_large_mesh_passes(start):
    session = start()
    cells = 450
    vertices, triangles = grid_mesh(cells)
    assert len(vertices) > 200_000
    page = session.page()
    session.publish("body_mesh", mesh_message(vertices, triangles), LATCHED)
    session.wait_for(lambda: page.shown[MESH], "the mesh")
    _, positions, corners, _ = page.mesh()
    assert (len(positions), len(corners)) == (len(vertices), len(triangles))
    assert numpy.array_equal(positions[-1], numpy.array(vertices[-1], "f4"))
    late = session.page()
    session.wait_for(lambda: late.shown[MESH], "the mesh for a late page")


def test_a_stiffness_map_comes_with_the_mesh_it_fits(start, tmp_path):
    (tmp_path / "map.csv").write_text("factor\n" + "\n".join(str(1 + n / 1000) for n in range(len(VERTICES))))
    session = start({"body.stiffness_map": str(tmp_path / "map.csv")})
    page = session.page()
    plate(session)
    session.wait_for(lambda: page.shown[MESH], "the mesh")
    assert page.mesh()[3] == pytest.approx([1 + n / 1000 for n in range(len(VERTICES))])
    small = grid_mesh(cells=2)
    session.publish("body_mesh", mesh_message(*small), LATCHED)
    session.wait_for(lambda: len(page.shown[MESH]) == 2, "another mesh")
    assert page.mesh()[3] is None and page.mesh()[0] == topology_version(*small)
    assert page.surface()[0] == topology_version(*small) and len(page.surface()[2]) == 0
    assert "no stiffness map" in session.program.log()


def test_a_page_takes_the_pointer_moves_it_and_lets_go_by_silence(start):
    session = start()
    page, other = session.page(), session.page()
    target = lambda n, **more: {
        "type": "pointer_target",
        "device": "",
        "sequence": n,
        "position": [0.01, 0.02, 0.003 * n],
        "grasp": False,
        **more,
    }
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.said("pointer"), "an answer")
    assert not page.last("pointer")["granted"] and "device.backend" in page.last("pointer")["reason"]
    assert session.node.count_publishers(session.node.resolve_topic_name("pointer_target")) == 0

    targets = session.heard(PoseStamped, "pointer_target", peer.reliable(10))
    grasps = session.heard(Bool, "grasp", peer.reliable(10))
    free = lambda: (page.last("status") or {"devices": [{}]})["devices"][0].get("pointer")
    session.wait_for(free, "the device listens")
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.last("pointer")["granted"], "the pointer")
    numbers = iter(range(1, 1_000_000))
    session.wait_for(lambda: targets, "a target", lambda: page.send(**target(next(numbers))))
    now = time.time()
    heard = targets[-1]
    assert heard.header.frame_id == f"{session.namespace}/body"
    assert abs(heard.header.stamp.sec + heard.header.stamp.nanosec * 1e-9 - now) < 1.0
    assert (heard.pose.position.x, heard.pose.orientation.w) == (0.01, 1.0)

    other.send(type="pointer_take", device="")
    page.send(**target(next(numbers)))
    session.wait_for(lambda: other.said("pointer"), "an answer", lambda: page.send(**target(next(numbers))))
    assert not other.last("pointer")["granted"], "one page at a time"
    other.send(**target(10_000_000))
    session.wait_for(lambda: other.said("refused"), "a page that does not hold it moves nothing")

    session.spin(0.1)
    before = len(targets)
    page.send(**target(1))
    session.wait_for(lambda: page.said("refused"), "a target that was overtaken")
    session.spin(0.1)
    assert len(targets) == before

    session.wait_for(lambda: grasps and grasps[-1].data, "the grasp", lambda: page.send(**target(next(numbers), grasp=True)))
    begun, count = time.monotonic(), len(grasps)
    session.wait_for(lambda: not grasps[-1].data, "silence lets go")
    assert 0.2 < time.monotonic() - begun < 0.6 and len(grasps) == count + 1
    count = len(targets)
    session.spin(0.5)
    assert len(targets) == count, "and targets end"

    other.send(type="pointer_take", device="")
    session.wait_for(lambda: other.last("pointer")["granted"] and not page.last("pointer")["granted"], "a silent page loses it")
    session.wait_for(lambda: grasps[-1].data, "the other page grasps", lambda: other.send(**target(next(numbers), grasp=True)))
    other.close()
    session.pages.remove(other)
    session.wait_for(lambda: not grasps[-1].data, "a page that is gone holds nothing")
    topic = session.node.resolve_topic_name("pointer_target")
    session.wait_for(lambda: session.node.count_publishers(topic) == 0, "nobody publishes targets any more")


def test_targets_arrive_within_milliseconds(start):
    session = start()
    page = session.page()
    arrivals = []
    session.node.create_subscription(
        PoseStamped, "pointer_target", lambda message: arrivals.append(time.monotonic()), peer.reliable(10)
    )
    free = lambda: (page.last("status") or {"devices": [{}]})["devices"][0].get("pointer")
    session.wait_for(free, "the device listens")
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.said("pointer"), "the pointer")
    number, waits = 0, []
    deadline = time.monotonic() + 10
    while len(waits) < 100 and time.monotonic() < deadline:
        before, number, begun = len(arrivals), number + 1, time.monotonic()
        page.send(type="pointer_target", device="", sequence=number, position=[0, 0, 0], grasp=False)
        while len(arrivals) == before and time.monotonic() - begun < 0.2:
            rclpy.spin_once(session.node, timeout_sec=0.05)
        page.poll()
        if len(arrivals) > before:
            waits.append(arrivals[before] - begun)
        time.sleep(0.003)
    assert len(waits) == 100
    assert sorted(waits)[50] < 0.005, f"median {1000 * sorted(waits)[50]:.1f} ms"
