"""The emergency stop: who can press it, whenever and however, and who cannot."""

import signal
import time

import pytest
import rclpy
from crtk_msgs.msg import OperatingState, StringStamped
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool

import peer as graph
from peer import CALM, Handle, Peer, Program, force_of, latched, reliable

SERVO = {**CALM, "device.force_source": "servo_cf"}
PRESSED, RELEASED = Bool(data=True), Bool(data=False)


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def start(tmp_path):
    programs = []

    def start(values=SERVO, **options):
        programs.append(Program(tmp_path, "haptic_device", values, **options))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


def states_of(peer, prefix=""):
    states = peer.heard(OperatingState, f"{prefix}operating_state", latched(10))
    peer.wait_for(lambda: states, "the operating state")
    return states


def test_one_press_among_many_messages_counts_while_the_node_is_away(start, peer):
    driver = start().wait_ready()
    states = states_of(peer)
    peer.publish(RELEASED, "emergency_stop", reliable(1000))
    peer.wait_for(lambda: states[-1].state == "ENABLED", "an enabled device")
    driver.process.send_signal(signal.SIGSTOP)
    try:
        for i in range(200):
            peer.publish(PRESSED if i == 10 else RELEASED, "emergency_stop", reliable(1000))
        time.sleep(0.2)
    finally:
        driver.process.send_signal(signal.SIGCONT)
    peer.wait_for(lambda: states[-1].state == "FAULT", "a fault")
    assert "emergency stop" in peer.new_status("/haptic_device: operating state")[2]["fault"]
    log = driver.log()
    assert log.count("emergency stop pressed") == log.count("emergency stop released") == 1, "changes, not messages"


def test_a_stop_that_was_pressed_before_the_driver_came_keeps_its_motors_off(start, peer):
    stop = peer.node.create_publisher(Bool, "emergency_stop", latched(1))
    stop.publish(PRESSED)
    handle = Handle(peer)
    # It waits for a reader of its poses, and hears meanwhile.
    driver = start({**SERVO, "device.wait_for_readers": 1}).wait_ready()
    states = states_of(peer)
    peer.wait_for(lambda: states[-1].state == "FAULT", "a fault")
    assert {state.state for state in states} == {"FAULT"}, driver.log()
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    peer.wait_for(lambda: "enable: not now: emergency stop" in driver.log(), "a refusal")
    stop.publish(RELEASED)
    peer.wait_for(lambda: "emergency stop released" in driver.log(), "the release")
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    peer.wait_for(lambda: states[-1].state == "ENABLED", "the device enabled")
    assert all(force_of(force) == (0.0, 0.0, 0.0) for force in handle.forces)


def test_the_sessions_stop_stops_each_of_its_devices(start, peer):
    for side in ("left", "right"):
        start({**SERVO, "devices": ["left", "right"]}, namespace=side)
    states = {side: states_of(peer, f"{side}/") for side in ("left", "right")}
    states_are = lambda *wanted: tuple(states[side][-1].state for side in ("left", "right")) == wanted
    peer.wait_for(lambda: states_are("ENABLED", "ENABLED"), "both enabled")
    # Both have to be found, and one of them is found first.
    stop = peer.node.create_publisher(Bool, "/emergency_stop", reliable(10))
    peer.wait_for(lambda: stop.get_subscription_count() == 2, "both drivers")
    stop.publish(PRESSED)
    peer.wait_for(lambda: states_are("FAULT", "FAULT"), "both stopped")
    # Its own stop releases no other.
    peer.publish(RELEASED, "left/emergency_stop", reliable(10))
    peer.publish(StringStamped(string="enable"), "left/state_command", reliable(10))
    peer.spin(0.5)
    assert states_are("FAULT", "FAULT")
    stop.publish(RELEASED)
    peer.spin(0.2)
    for side in ("left", "right"):
        peer.publish(StringStamped(string="enable"), f"{side}/state_command", reliable(10))
    peer.wait_for(lambda: states_are("ENABLED", "ENABLED"), "both enabled again")


def test_a_stop_that_cannot_be_heard_is_told_as_an_error(start, peer):
    driver = start().wait_ready()
    level, summary, _ = peer.new_status("/haptic_device: emergency stop")
    assert (level, summary) == (0, "not pressed")
    peer.node.create_publisher(Bool, "emergency_stop", QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))
    peer.wait_for(lambda: "publishes it best effort" in driver.log(), "an error")
    level, summary, values = peer.new_status("/haptic_device: emergency stop")
    assert level == 2 and "/peer publishes it best effort" in summary and values["emergency_stop"] == "/peer"


def test_what_keeps_the_motors_off_is_told_although_no_fault_is_latched(start, peer):
    driver = start().wait_ready()
    states = states_of(peer)
    peer.publish(PRESSED, "emergency_stop", reliable(10))
    peer.wait_for(lambda: states[-1].state == "FAULT", "a fault")
    peer.publish(StringStamped(string="disable"), "state_command", reliable(10))
    peer.wait_for(lambda: states[-1].state == "DISABLED", "a device that is disabled")
    _, summary, values = peer.new_status("/haptic_device: operating state")
    assert summary.startswith("DISABLED: emergency stop") and values["fault"] == ""
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    peer.wait_for(lambda: "enable: not now: emergency stop" in driver.log(), "the reason")
    assert states[-1].state == "DISABLED"
