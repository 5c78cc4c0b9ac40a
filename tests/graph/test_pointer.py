"""A hand that is led by a pointer over DDS: the driver with targets as the viewer's page sends them, and the model that it presses."""

import math
import re
import time

import pytest
import rclpy
from builtin_interfaces.msg import Time
from crtk_msgs.msg import OperatingState, StringStamped
from geometry_msgs.msg import PoseStamped, WrenchStamped
from pytest import approx
from rhombus_haptics_msgs.msg import ContactState
from std_msgs.msg import Bool

import peer as graph
from peer import BLOCK_TOP_M, PROBE_RADIUS_M, SCENE, Handle, Peer, Program, about_z, force_of, pressed, reliable, stamp_of, turned, vector

# Python hears every message at this rate.
POINTER = {**SCENE, "device.backend": "pointer", "device.rate": 200.0, "safety.engage_ramp": 0.5}
HAND_N_PER_M, HAND_N_S_PER_M = 500.0, 20.0
TIMEOUT_S = 0.3
CLEAR = pressed(-0.01)


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def start(tmp_path):
    programs = []

    def start(executable="haptic_device", values=POINTER, **options):
        programs.append(Program(tmp_path, executable, values, **options))
        return programs[-1].wait_ready()

    yield start
    for program in programs:
        program.kill()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


class Pointer(Handle):
    """The one who points, at the rate of a screen, and what becomes of it."""

    def __init__(self, peer, prefix=""):
        super().__init__(peer, prefix)
        self.peer, self.topic = peer, f"{prefix}pointer_target"
        self.answers = peer.heard(WrenchStamped, f"{prefix}servo_cf", reliable(1000))
        self.states = peer.heard(ContactState, f"{prefix}contact_state", reliable(1000))

    def send(self, position, frame="body", stamp_ns=None):
        """One target; its stamp."""
        message = PoseStamped()
        message.header.frame_id = frame
        message.header.stamp = self.peer.node.get_clock().now().to_msg()
        if stamp_ns is not None:
            message.header.stamp = Time(sec=stamp_ns // 1_000_000_000, nanosec=stamp_ns % 1_000_000_000)
        message.pose.orientation.w = 1.0
        p = message.pose.position
        p.x, p.y, p.z = (float(x) for x in position)
        self.peer.publish(message, self.topic, reliable(10))
        return stamp_of(message)

    def until(self, position, condition, what, **options):
        """Point there until a condition holds."""

        def tried():
            self.send(position, **options)
            self.peer.spin(0.016)
            return condition()

        self.peer.wait_for(tried, what)

    def lead(self, position, seconds, **options):
        """Point there for a while; the stamp of the last target."""
        end = time.monotonic() + seconds
        self.until(position, lambda: time.monotonic() >= end, "the end of the way", **options)
        return self.send(position, **options)

    def now_ns(self):
        return self.peer.node.get_clock().now().nanoseconds

    def handle(self):
        return vector(self.poses[-1].pose.position)

    def is_at(self, position, within_m=1e-4):
        return bool(self.poses) and math.dist(self.handle(), position) < within_m


@pytest.fixture
def session(start, peer):
    """Model and driver, and a pointer that waits clear of the block."""

    def session(**values):
        start("deformation", {**POINTER, **values})
        driver = start("haptic_device", {**POINTER, **values})
        pointer = Pointer(peer)
        pointer.until(CLEAR, lambda: pointer.is_at(CLEAR) and pointer.states, "the hand follows")
        # The force begins when the commanded one was small for a while, and grows for as long as the ramp.
        pointer.lead(CLEAR, 0.7)
        return driver, pointer

    return session


def settled(pointer):
    """The last force that the model commanded, what the motors gave for that pose, and the contact."""
    given = {stamp_of(each): force_of(each) for each in pointer.forces[-50:]}
    answer = next(each for each in reversed(pointer.answers) if stamp_of(each) in given)
    return force_of(answer), given[stamp_of(answer)], pointer.states[-1]


def test_a_hand_that_nobody_points_to_waits_clear_of_the_body(start, peer):
    start()
    pointer = Pointer(peer)
    peer.wait_for(lambda: len(pointer.poses) > 100, "poses")
    first, last = (vector(pose.pose.position) for pose in (pointer.poses[0], pointer.poses[-1]))
    assert first == last and first[2] > BLOCK_TOP_M + PROBE_RADIUS_M
    level, summary, values = peer.new_status("/haptic_device: pointer")
    assert (level, summary, values["is_led"]) == (0, "no pointer: the hand has let go", "false")


def test_pressing_at_a_place_touches_there_and_the_tissue_pushes_back(session, peer):
    driver, pointer = session()
    wish_m = 0.006
    pointer.lead(pressed(wish_m), 2.0)
    commanded, given, state = settled(pointer)
    assert state.mode == ContactState.CONTACT
    x, y, _ = pressed(wish_m)
    assert vector(state.proxy) == approx((x, y, BLOCK_TOP_M), abs=2e-4)
    assert 0.001 < state.depth < wish_m - 1e-4, "the force keeps the hand from where it wants to be"
    assert commanded[2] == approx(HAND_N_PER_M * (wish_m - state.depth), rel=0.03), "hand and tissue balance"
    assert given == approx(commanded, abs=0.02 * commanded[2])
    _, summary, values = peer.new_status("/haptic_device: pointer")
    assert int(values["targets"]) > 60 and values["rejected"] == "0"
    # A machine that stands still for longer than pointer.timeout makes a target old; nothing else may be wrong with one.
    reasons = [line.split("not followed: ")[1] for line in driver.log().splitlines() if "not followed: " in line]
    assert all(" old" in reason for reason in reasons) and (reasons or values["untimely"] == "0"), reasons
    assert values["publisher"] == "/peer"


def test_without_targets_the_hand_lets_go_and_the_tissue_pushes_it_out(session, peer):
    _, pointer = session()
    last_ns = pointer.lead(pressed(0.006), 1.5)
    before = pointer.forces[-1].wrench.force.z
    stiffness_n_per_m = pointer.states[-1].stiffness
    assert before > 0.1
    peer.wait_for(lambda: pointer.forces[-1].wrench.force.z < 0.1 * before, "the force is gone")
    after_s = {0.9: None, 0.1: None}
    for share in after_s:
        fallen = next(f for f in pointer.forces if stamp_of(f) > last_ns and f.wrench.force.z < share * before)
        after_s[share] = 1e-9 * (stamp_of(fallen) - last_ns)
    # The push of the tissue against the hand's damper: to a tenth in 2.3 of these.
    time_constant_s = HAND_N_S_PER_M / stiffness_n_per_m
    assert 0.9 * TIMEOUT_S < after_s[0.9] < TIMEOUT_S + time_constant_s + 0.2
    assert after_s[0.1] < TIMEOUT_S + 4.0 * time_constant_s + 0.2
    peer.spin(0.3)
    _, summary, _ = peer.new_status("/haptic_device: pointer")
    assert summary == "no pointer: the hand has let go"


def test_targets_that_cannot_be_followed_move_nothing_and_are_counted(start, peer):
    start()
    pointer = Pointer(peer)
    peer.wait_for(lambda: pointer.poses, "a pose")
    where = pointer.handle()
    pointer.send(CLEAR, frame="map")
    pointer.send((0.0, float("nan"), 0.1))
    pointer.send((0.0, 0.0, float("inf")))
    pointer.send(CLEAR, stamp_ns=pointer.now_ns() - 1_000_000_000)
    pointer.send(CLEAR, stamp_ns=pointer.now_ns() + 1_000_000_000)
    peer.spin(0.3)
    assert pointer.handle() == where
    level, summary, values = peer.new_status("/haptic_device: pointer")
    assert {key: values[key] for key in ("targets", "rejected", "untimely")} == {"targets": "0", "rejected": "3", "untimely": "2"}

    # Back in time: the first one is followed, the others are not.
    stamp_ns = pointer.now_ns()
    for earlier_ns in (0, 0, 10_000_000):
        pointer.send(CLEAR, stamp_ns=stamp_ns - earlier_ns)
    _, _, values = peer.new_status("/haptic_device: pointer")
    assert (values["targets"], values["untimely"]) == ("1", "4")
    assert pointer.handle() != where


def test_a_target_out_of_reach_is_not_followed_to_a_place_beside_it_and_named(session, peer):
    _, pointer = session()
    pointer.lead(pressed(0.006), 1.5)
    force_n = pointer.forces[-1].wrench.force.z
    assert force_n > 0.1
    # Deep beside the block, and farther than the device reaches.
    beside = (0.3, 0.007, 0.02)
    x = pointer.handle()[0]
    pointer.lead(beside, 1.5)
    assert abs(pointer.handle()[0] - x) < 1e-3, "the hand stays where it was"
    assert pointer.forces[-1].wrench.force.z < 0.1 * force_n, "and has let go: the tissue has pushed it out"
    told = lambda: peer.statuses["/haptic_device: pointer"][-1]
    pointer.until(beside, lambda: int(told()[2]["out_of_reach"]) > 50, "they are counted")
    level, summary, values = told()
    assert (level, values["is_out_of_reach"], values["is_led"]) == (1, "true", "false")
    assert re.fullmatch(r"[1-9]\d* targets out of reach of the device", summary)
    pointer.until(CLEAR, lambda: pointer.is_at(CLEAR, 1e-3), "what is in reach is followed")
    assert peer.new_status("/haptic_device: pointer")[2]["is_out_of_reach"] == "false"


def test_of_two_who_point_neither_is_followed_and_both_are_named(session, peer):
    driver, pointer = session()
    other = rclpy.create_node("other_page")
    second = other.create_publisher(PoseStamped, "pointer_target", reliable(10))
    status = lambda: peer.statuses["/haptic_device: pointer"][-1]
    pointer.until(CLEAR, lambda: status()[0] == 2, "the conflict")
    assert "pointer_target has 2 publishers (" in status()[1] and "/peer" in status()[1] and "/other_page" in status()[1]
    peer.spin(TIMEOUT_S + 0.1)
    where = pointer.handle()
    pointer.lead(pressed(0.004), 0.5)
    assert math.dist(pointer.handle(), where) < 1e-4, "nobody leads the hand"
    assert "no target from it until there is one" in driver.log()
    other.destroy_publisher(second)
    pointer.until(pressed(0.004), lambda: pointer.states[-1].mode == ContactState.CONTACT, "the one who is left leads")
    other.destroy_node()


def test_holding_the_surface_and_pulling_pulls_back(session, peer):
    _, pointer = session()
    pointer.lead(pressed(0.001), 0.7)
    peer.publish(Bool(data=True), "grasp", reliable(10))
    pointer.until(pressed(0.001), lambda: pointer.states[-1].mode == ContactState.GRASP, "the grasp")
    wish = pressed(-0.006)
    pointer.lead(wish, 1.0)
    commanded, given, state = settled(pointer)
    assert state.mode == ContactState.GRASP and state.depth < 0.0 and commanded[2] < -0.1, "pulled"
    assert commanded[2] == approx(-HAND_N_PER_M * (wish[2] - pointer.handle()[2]), rel=0.03), "hand and tissue balance"
    assert given == approx(commanded, abs=0.02 * abs(commanded[2]))
    peer.publish(Bool(data=False), "grasp", reliable(10))
    pointer.until(CLEAR, lambda: pointer.states[-1].mode == ContactState.NONE, "the surface is let go of")


def test_disabled_it_feels_nothing_and_enabled_again_the_force_begins_outside(session, peer):
    _, pointer = session()
    operating = peer.heard(OperatingState, "operating_state", graph.latched(10))
    wish_m = 0.004
    pointer.lead(pressed(wish_m), 1.0)
    assert pointer.forces[-1].wrench.force.z > 0.1
    peer.publish(StringStamped(string="disable"), "state_command", reliable(10))
    pointer.until(pressed(wish_m), lambda: operating and operating[-1].state == "DISABLED", "disabled")
    pointer.lead(pressed(wish_m), 0.7)
    assert force_of(pointer.forces[-1]) == (0.0, 0.0, 0.0)
    assert pointer.is_at(pressed(wish_m)), "nothing keeps the hand out"
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    pointer.until(pressed(wish_m), lambda: operating[-1].state == "ENABLED", "enabled")
    pointer.lead(pressed(wish_m), 0.7)
    assert force_of(pointer.forces[-1]) == (0.0, 0.0, 0.0), "not while the model wants more than a little"
    pointer.lead(CLEAR, 1.0)
    pointer.lead(pressed(wish_m), 1.0)
    assert pointer.forces[-1].wrench.force.z > 0.1


def test_the_safety_layer_stands_between_the_tissue_and_this_hand_too(session):
    largest_n = 0.2
    _, pointer = session(**{"device.max_force": largest_n})
    pointer.lead(pressed(0.008), 1.5)
    commanded, given, _ = settled(pointer)
    assert commanded[2] > 1.5 * largest_n
    assert given[2] == approx(largest_n, rel=1e-6)
    assert max(force.wrench.force.z for force in pointer.forces) <= largest_n * (1 + 1e-9)


def test_targets_come_in_the_frame_of_the_device_the_scene_or_the_body(start, peer):
    """Of a device of several, turned and scaled: where the handle has to go for the probe to be there."""
    quarter = about_z(math.pi / 2)
    values = {
        **POINTER,
        "devices": ["left", "right"],
        "device.scene_from_device": [0.02, 0.0, 0.01, *quarter],
        "body.pose": [0.0, 0.03, 0.0, 0.0, 0.0, 0.0, 1.0],
        "device.motion_scale": 2.0,
    }
    start(values=values, namespace="left")
    pointer = Pointer(peer, "left/")
    in_scene = (0.04, 0.06, 0.11)
    in_body = (0.04, 0.03, 0.11)
    from_base = tuple(a - b for a, b in zip(in_scene, (0.02, 0.0, 0.01)))
    handle = tuple(x / 2.0 for x in turned((*(-c for c in quarter[:3]), quarter[3]), from_base))
    elsewhere = (0.0, 0.0, 0.1)
    for frame, position in (("body", in_body), ("scene", in_scene), ("left/device_base", handle), ("", handle)):
        pointer.until(elsewhere, lambda: pointer.is_at(elsewhere), "another place", frame="left/device_base")
        pointer.until(position, lambda: pointer.is_at(handle, 1e-5), f"the place given in {frame}", frame=frame)


def test_only_a_device_that_is_led_by_a_pointer_listens_to_one(start, peer):
    start(values={**POINTER, "device.backend": "simulated"})
    handle = Handle(peer)
    peer.wait_for(lambda: handle.poses, "poses")
    assert peer.node.count_subscribers("/pointer_target") == 0
    peer.new_status("/haptic_device: motor loop")
    assert "/haptic_device: pointer" not in peer.statuses


def test_a_hand_that_would_be_faster_than_is_safe_is_refused_by_name(tmp_path):
    program = Program(tmp_path, "haptic_device", {**POINTER, "pointer.max_speed": 0.9, "safety.max_speed": 0.8})
    assert program.process.wait(20) == 1
    assert "pointer.max_speed = 0.9: accepted is less than safety.max_speed, 0.8 m/s" in program.log()
