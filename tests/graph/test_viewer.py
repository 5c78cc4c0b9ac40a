"""The viewer over real DDS and a real WebSocket: what pages are shown, and when."""

import math
import time

import numpy
import peer
import pytest
import rclpy
from crtk_msgs.msg import OperatingState
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, TransformStamped, WrenchStamped
from rhombus_haptics_msgs.msg import ContactState
from test_visualization import (
    CENTRE,
    CHAIN,
    DEPTH_M,
    TRIANGLES,
    VERTICES,
    contact,
    displacement,
    grid_mesh,
    mesh_message,
    pose,
    press,
    topology_version,
    wrench,
)
from tf2_msgs.msg import TFMessage
from viewer import LATCHED, body_is_scene, plate, start  # noqa: F401
from websocket import MESH, STATE, SURFACE


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


def test_a_page_is_greeted_then_shown_mesh_surface_and_state_as_the_topics_say(start):
    session = start({"body.pose": [0.1, 0.0, 0.0, 0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)], **CHAIN})
    plate(session)
    body_is_scene(session)
    heard = displacement([CENTRE, CENTRE + 1, 7], -0.004)
    heard.displacement[0] = 0.1234567
    heard.header.stamp.sec, heard.header.stamp.nanosec = 12, 500_000_000
    session.publish("surface_displacement", heard)
    first = session.page()
    session.wait_for(lambda: first.shown[SURFACE], "the node has heard of the surface", lambda: press(session))
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
    assert (state["flags"] & 32, list(state["commanded_force"])) == (0, list(state["force"])), "nobody says what motors apply"
    assert math.isnan(state["latency_s"]), "a stamp of 1970 is of another clock"
    chain = page.last("chains")["chains"][0]
    assert (chain["units"], chain["ratio"]) == (CHAIN["chains.units"][0], 0.8)


def test_the_force_on_the_hand_is_what_the_motors_apply_and_the_command_stands_beside_it(start):
    session = start()
    page = session.page()
    driver = rclpy.create_node("driver", namespace=session.namespace)
    applied = driver.create_publisher(WrenchStamped, "measured_cf", peer.reliable(1000))
    turned = TransformStamped(child_frame_id="device_base")
    turned.header.frame_id = f"{session.namespace}/scene"
    turned.transform.rotation.z, turned.transform.rotation.w = math.sqrt(0.5), math.sqrt(0.5)
    session.publish("/tf_static", TFMessage(transforms=[turned]), peer.latched(100))
    state = lambda: page.states()[0]

    def command():
        session.publish("contact_state", contact())
        session.publish("servo_cf", wrench(1.2))

    def give(x, y=0.0):
        message = wrench(0.0)
        message.wrench.force.x, message.wrench.force.y = x, y
        command()
        applied.publish(message)

    heard = lambda: page.shown[STATE] and state()["flags"] & (2 | 32 | 64) == 2 | 32 | 64
    session.wait_for(heard, "what is applied and what is commanded", lambda: give(0.3))
    assert state()["force"] == pytest.approx([0, 0.3, 0], abs=1e-6), "in the body's axes"
    assert state()["commanded_force"] == pytest.approx([0, 0, 1.2], abs=1e-6)
    # Disabled: the model still commands, the motors apply nothing.
    session.wait_for(lambda: not state()["force"].any(), "no force on the hand", lambda: give(0.0))
    assert state()["commanded_force"][2] == pytest.approx(1.2)
    not_drawn = lambda: page.last("status")["not_drawn"]["not_drawable"]
    assert not_drawn() == 0
    session.wait_for(lambda: not_drawn() > 0, "a force that is not finite is counted", lambda: give(math.nan))
    # A driver that hangs applies nobody knows what: the command is not shown in its place.
    session.wait_for(lambda: not state()["flags"] & (2 | 32), "the force is not known", command)
    assert state()["flags"] & 64 and not state()["force"].any()
    # Where nobody says what motors apply, as in a recording without it, the command stands for it, and is marked as one.
    driver.destroy_node()
    session.wait_for(lambda: state()["flags"] & (2 | 32 | 64) == 2 | 64, "the command in its place", command)
    assert state()["force"] == pytest.approx([0, 0, 1.2], abs=1e-6)


def test_without_a_page_nobody_hears_what_the_motors_apply(start):
    session = start()
    readers = lambda: session.node.count_subscribers(session.node.resolve_topic_name("measured_cf"))
    session.spin(0.5)
    assert readers() == 0
    session.page()
    session.wait_for(lambda: readers() == 1, "the page's node hears it")


def test_latency_is_the_age_of_the_pose_when_its_contact_is_heard(start):
    session = start()
    body_is_scene(session)
    page = session.page()

    def press_now():
        state = contact()
        state.header.stamp = session.node.get_clock().now().to_msg()
        session.publish("contact_state", state)

    # Of several one that nothing held up.
    heard = lambda: page.shown[STATE] and 0 < page.states()["latency_s"][0] < 0.2
    session.wait_for(heard, "a latency", press_now)


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


def test_nan_is_not_sent_and_counted(start):
    session = start()
    plate(session)
    body_is_scene(session)
    page = session.page()
    session.wait_for(lambda: page.shown[SURFACE] and page.said("status"), "the plate")
    not_drawn = lambda: page.last("status")["not_drawn"]
    bad = contact()
    bad.stiffness = math.inf
    wrong = pose()
    wrong.pose.position.x = math.nan
    # One after the other: of two displacements in one turn only the newest is looked at.
    for topic, message, not_drawable, other_mesh in [
        ("surface_displacement", displacement([CENTRE], math.nan), 1, 0),
        ("surface_displacement", displacement([CENTRE], -0.002, version=1), 1, 1),
        ("contact_state", bad, 2, 1),
        ("measured_cp", wrong, 3, 1),
    ]:
        before = not_drawn()
        # What a new publisher says before it is known to the reader may get lost.
        for _ in range(5):
            session.publish(topic, message)
            end = time.monotonic() + 3.0
            while not_drawn() == before and time.monotonic() < end:
                session.spin(0.05)
            if not_drawn() != before:
                break
        assert not_drawn() == {"not_drawable": not_drawable, "other_mesh": other_mesh}, topic
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


def test_a_model_that_is_asked_nothing_is_there_as_long_as_it_says_how_it_is(start):
    session = start()
    model = rclpy.create_node("model", namespace=session.namespace)
    model.create_publisher(ContactState, "contact_state", peer.reliable(1000))
    diagnostics = model.create_publisher(DiagnosticArray, "/diagnostics", 10)
    page = session.page()
    count = lambda: (page.last("status") or {"publishers": {}})["publishers"].get("contact_state")
    session.wait_for(lambda: count() == 1, "a model that has not said how it is yet")

    def say():
        status = DiagnosticStatus(name=f"/{session.namespace}/model: body", values=[KeyValue(key="surfaces", value="1")])
        diagnostics.publish(DiagnosticArray(status=[status]))

    named = lambda: [each["name"] for each in page.last("status")["nodes"]]
    session.wait_for(lambda: f"/{session.namespace}/model: body" in named(), "its diagnostics", say)
    assert count() == 1
    # It hangs, and is still in the graph.
    session.wait_for(lambda: count() == 0, "a model that says nothing any more")
    session.wait_for(lambda: count() == 1, "it speaks again", say)
    model.destroy_node()


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
