"""Two real drivers on one body: config/two_hands.yaml, each node a process as in a session."""

import math
import signal
from pathlib import Path

import pytest
import rclpy
from geometry_msgs.msg import WrenchStamped
from pytest import approx
from rhombus_haptics_msgs.msg import ContactState
from tf2_msgs.msg import TFMessage

import peer as graph
from peer import Handle, Peer, Program, force_of, latched, library_force_n, reliable, stamp_of, vector

CONFIG = Path(__file__).resolve().parents[2] / "config" / "two_hands.yaml"
SIDES = ("left", "right")
PERIOD_S = 6.0
# Python hears every message at this rate; the hands are quick so that the tests are.
SCENE = CONFIG.read_text().replace("period: 9.0", f"period: {PERIOD_S}").replace(
    "    devices: [left, right]\n", f"    devices: [left, right]\n    device.rate: 200.0\n    simulated.period: {PERIOD_S}\n"
)
# Where the scene puts the two bases.
SCENE_FROM = {
    "left": lambda p: (p[0] - 0.2, p[1], p[2]),
    "right": lambda p: (0.2 - p[0], -p[1], p[2]),
}


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def start(tmp_path):
    programs = []

    def start(executable, scene=SCENE, **options):
        programs.append(Program(tmp_path, executable, scene, **options))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


@pytest.fixture
def session(start, peer):
    """Model, drivers and what is heard of them; the first pose waits for all of it."""

    class Session:
        model = start("deformation").wait_ready()
        handles = {side: Handle(peer, f"{side}/") for side in SIDES}
        states = {side: peer.heard(ContactState, f"{side}/contact_state", reliable(1000)) for side in SIDES}
        answers = {side: peer.heard(WrenchStamped, f"{side}/servo_cf", reliable(1000)) for side in SIDES}
        drivers = {
            side: start("haptic_device", namespace=side, arguments=["-p", "haptic_device:device.wait_for_readers:=2"])
            for side in SIDES
        }

    for driver in Session.drivers.values():
        driver.wait_ready()
    return Session


def touching(states):
    return [state for state in states if state.mode == ContactState.CONTACT]


def test_each_driver_says_where_its_device_stands(start, peer):
    heard = {}
    peer.node.create_subscription(
        TFMessage,
        "/tf_static",
        lambda message: heard.update({each.child_frame_id: (each, message) for each in message.transforms}),
        latched(100),
    )
    start("visualization").wait_ready()
    peer.wait_for(lambda: "body" in heard, "the body")
    assert heard.keys() == {"body"}, "of several devices visualization knows no place"
    for side in SIDES:
        start("haptic_device", namespace=side).wait_ready()
        peer.wait_for(lambda side=side: f"{side}/device_base" in heard, f"the place of {side}")
    left, right = (heard[f"{side}/device_base"][0] for side in SIDES)
    assert left.header.frame_id == right.header.frame_id == "scene", "the session's frame and not left/scene"
    assert (left.transform.translation.x, right.transform.translation.x) == (-0.2, 0.2)
    assert (left.transform.rotation.w, right.transform.rotation.z) == (1.0, 1.0)


def test_both_hands_press_their_halves_are_answered_and_feel_nothing_of_each_other(session, peer):
    peer.spin(PERIOD_S + 1.0)
    for driver in session.drivers.values():
        assert driver.interrupt()[0] == 0, driver.log()
    peer.spin(0.5)
    assert session.model.interrupt()[0] == 0, session.model.log()
    of_model = session.model.closing_report()["devices"]
    for side in SIDES:
        report = session.drivers[side].closing_report()
        assert report["unanswered"] == 0 and report["forces"] == report["poses"] > 200 * PERIOD_S * 0.9, side
        assert of_model[side]["forces"] == report["poses"]
        # A pose may come before the place of its frame, and gets no force then.
        assert of_model[side]["rejected"] == of_model[side]["rejected_by_cause"]["unknown_frame"] < 40
        assert {answer.header.frame_id for answer in session.answers[side]} == {f"{side}/device_base"}
        sites = [SCENE_FROM[side](vector(state.proxy)) for state in touching(session.states[side])]
        assert len(sites) > 100
        inward = -1.0 if side == "left" else 1.0
        assert all(inward * x > 0.0 for x, _, _ in sites), f"{side} presses its half"
        assert max(math.dist(sites[0], site) for site in sites) > 0.02, "and slides there"

    # Each force is the law's for its own depth, also while the other hand presses.
    contact = {side: {stamp_of(s): s for s in touching(session.states[side])} for side in SIDES}
    for side, other in (SIDES, SIDES[::-1]):
        released = min((stamp_of(s) for s in session.states[side] if s.mode == ContactState.GRASP), default=math.inf)
        busy = sorted(contact[other])
        both = [
            state
            for stamp, state in contact[side].items()
            if stamp < released and any(abs(stamp - theirs) < 10 * graph.MS for theirs in busy)
        ]
        assert len(both) > 50, f"{side} presses while {other} does"
        for state in sorted(both, key=lambda state: state.depth)[:: max(1, len(both) // 8)]:
            assert state.force == approx(library_force_n(session.model.file, state.depth), rel=1e-6, abs=1e-9)


def test_killing_one_driver_leaves_the_other_at_work(session, peer):
    pressing = lambda side: session.states[side] and session.states[side][-1].mode == ContactState.CONTACT
    peer.wait_for(lambda: pressing("left"), "left presses")
    session.drivers["left"].process.send_signal(signal.SIGKILL)
    session.drivers["left"].process.wait()
    peer.spin(0.2)
    gone, count = len(session.states["left"]), len(session.states["right"])
    peer.spin(PERIOD_S)
    assert len(session.states["left"]) == gone
    after = session.states["right"][count:]
    assert len(after) > 200 * PERIOD_S * 0.9
    assert max(math.hypot(*force_of(f)) for f in session.handles["right"].forces[count:]) > 0.3
    assert session.model.process.poll() is None
    assert session.drivers["right"].interrupt()[0] == 0
    assert session.drivers["right"].closing_report()["unanswered"] == 0


def test_a_section_without_the_sessions_namespace_is_refused_by_the_driver_it_would_not_reach(start):
    driver = start("haptic_device", namespace="or1/left")
    assert driver.process.wait(graph.TIMEOUT_S) == 1
    errors = [line for line in driver.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1 and "section /left/haptic_device would be ignored by /or1/left/haptic_device" in errors[0]
