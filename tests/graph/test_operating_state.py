"""The operating state through topics, services and lifecycle tools: every transition, and what the motors do in each state."""

import pytest
import rclpy
from crtk_msgs.msg import OperatingState, StringStamped
from crtk_msgs.srv import TriggerOperatingState
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from pytest import approx
from std_msgs.msg import Bool

import peer as graph
from peer import CALM, Client, Handle, Peer, Program, force_of, latched, reliable, stamp_of

SERVO = {**CALM, "device.force_source": "servo_cf"}
# The table of the CRTK documentation; None: not accepted, and the state stays.
TABLE = {
    "DISABLED": {"enable": "ENABLED", "disable": "DISABLED", "pause": None, "resume": None, "home": None, "unhome": None},
    "ENABLED": {"enable": "ENABLED", "disable": "DISABLED", "pause": "PAUSED", "resume": None, "home": "ENABLED", "unhome": None},
    "PAUSED": {"enable": None, "disable": "DISABLED", "pause": "PAUSED", "resume": "ENABLED", "home": "PAUSED", "unhome": None},
    "FAULT": {"enable": "ENABLED", "disable": "DISABLED", "pause": None, "resume": None, "home": None, "unhome": None},
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


class Desk:
    """Gives state commands and hears what came of them."""

    def __init__(self, peer):
        self.peer = peer
        self.states = peer.heard(OperatingState, "operating_state", latched(10))
        peer.wait_for(lambda: self.states, "the operating state")

    def state(self):
        return self.states[-1].state

    def command(self, word):
        """The message that answers a command."""
        count = len(self.states)
        self.peer.publish(StringStamped(string=word), "state_command", reliable(10))
        self.peer.wait_for(lambda: len(self.states) > count, f"an answer to {word}")
        return self.states[-1]

    def emergency_stop(self, pressed):
        self.peer.publish(Bool(data=pressed), "emergency_stop", reliable(10))

    def go_to(self, state):
        """From anywhere."""
        if state == "FAULT":
            self.emergency_stop(True)
            self.peer.wait_for(lambda: self.state() == "FAULT", "a fault")
            # Released, so that it can be cleared: the fault stays latched.
            self.emergency_stop(False)
            self.peer.spin(0.1)
        else:
            self.command("disable")
            for word in {"DISABLED": [], "ENABLED": ["enable"], "PAUSED": ["enable", "pause"]}[state]:
                self.command(word)
        assert self.state() == state


def test_the_whole_table_by_topic_with_a_fresh_message_for_every_command(start, peer):
    driver = start().wait_ready()
    desk = Desk(peer)
    for state, row in TABLE.items():
        for word, expected in row.items():
            desk.go_to(state)
            warnings = driver.log().count("WARN")
            answer = desk.command(word)
            assert answer.state == (expected or state), f"{word} in {state}"
            assert (driver.log().count("WARN") > warnings) == (expected is None), f"{word} in {state}"
            reply = peer.call(TriggerOperatingState, "operating_state", TriggerOperatingState.Request())
            assert reply.operating_state.state == answer.state
            assert stamp_of(reply.operating_state) > stamp_of(answer)
    desk.go_to("ENABLED")
    for nonsense in ("fly", "ENABLE", ""):
        assert desk.command(nonsense).state == "ENABLED"
    stamps = [stamp_of(message) for message in desk.states]
    assert all(later > earlier for earlier, later in zip(stamps, stamps[1:])), "clients drop what is not newer"
    assert all(message.is_homed and not message.is_busy for message in desk.states)


def test_force_acts_in_enabled_only(start, peer):
    start().wait_ready()
    desk, handle, client = Desk(peer), Handle(peer), Client(peer)
    force = (1.0, 0.0, 0.0)
    acts = lambda: force_of(handle.forces[-1]) == approx(force, abs=1e-6)
    gone = lambda: force_of(handle.forces[-1]) == (0.0, 0.0, 0.0)
    peer.wait_for(lambda: handle.forces, "measured forces")
    for word, back in [("disable", "enable"), ("pause", "resume")]:
        client.engage(handle)
        client.until(force, acts, f"a force before {word}")
        desk.command(word)
        client.until(force, gone, f"no force after {word}, although it is still commanded")
        count = len(handle.forces)
        client.stream(force, 1.0)
        assert {force_of(message) for message in handle.forces[count:]} == {(0.0, 0.0, 0.0)}
        desk.command(back)
        client.stream(force, 1.0)
        # A force that was there before the command must not jump at the hand.
        assert {force_of(message) for message in handle.forces[count:]} == {(0.0, 0.0, 0.0)}


def test_the_emergency_stop_latches_a_fault_that_only_enable_clears_once_it_is_released(start, peer):
    driver = start().wait_ready()
    desk, handle, client = Desk(peer), Handle(peer), Client(peer)
    peer.wait_for(lambda: handle.forces, "measured forces")
    client.engage(handle)
    desk.emergency_stop(True)
    gone = lambda: force_of(handle.forces[-1]) == (0.0, 0.0, 0.0)
    client.until((1.0, 0.0, 0.0), lambda: gone() and desk.state() == "FAULT", "no force, and a fault")
    level, summary, values = peer.new_status("/haptic_device: operating state")
    assert level == 2 and values["state"] == "FAULT" and "emergency stop" in values["fault"]
    assert "emergency stop" in summary
    assert desk.command("enable").state == "FAULT", "still pressed"
    desk.emergency_stop(False)
    peer.spin(0.3)
    assert desk.state() == "FAULT", "released is not cleared"
    assert desk.command("enable").state == "ENABLED"
    assert driver.log().count("FAULT: emergency stop") == 1


def test_an_emergency_stop_that_is_released_at_once_is_a_fault_every_time(start, peer):
    start().wait_ready()
    desk = Desk(peer)
    for _ in range(20):
        count = len(desk.states)
        desk.emergency_stop(True)
        desk.emergency_stop(False)
        peer.wait_for(lambda: any(m.state == "FAULT" for m in desk.states[count:]), "a fault after a short press")
        peer.spin(0.1)
        assert desk.state() == "FAULT", "released is not cleared"
        assert desk.command("enable").state == "ENABLED"


def test_a_driver_that_shall_not_enable_at_the_start_waits_for_the_command(start, peer):
    start(values={**SERVO, "device.enable_at_start": False}).wait_ready()
    desk = Desk(peer)
    assert desk.state() == "DISABLED"
    handle, client = Handle(peer), Client(peer)
    client.stream((0.0, 0.0, 0.0), 0.3)
    client.stream((1.0, 0.0, 0.0), 1.0)
    assert {force_of(message) for message in handle.forces} == {(0.0, 0.0, 0.0)}
    assert desk.command("enable").state == "ENABLED"
    client.engage(handle)


def test_settings_that_are_not_safe_are_shouted_about_in_every_report(start, peer):
    driver = start().wait_ready()
    level, summary, values = peer.new_status("/haptic_device: operating state")
    assert level == 2 and "UNSAFE: safety.passivity" in summary
    assert "UNSAFE: safety.passivity" in driver.log()
    assert (values["state"], values["force_source"], values["model"]) == ("ENABLED", "nobody", "scripted hand on a delta")


def test_lifecycle_services_are_a_view_of_the_same_state(start, peer):
    start().wait_ready()
    desk = Desk(peer)
    events = peer.heard(TransitionEvent, "haptic_device/transition_event", reliable(10))
    peer.wait_for(lambda: peer.node.count_publishers("haptic_device/transition_event") == 1, "its publisher")
    peer.spin(0.3)

    def get_state():
        return peer.call(GetState, "haptic_device/get_state", GetState.Request()).current_state

    def change(label="", number=0):
        request = ChangeState.Request(transition=Transition(id=number, label=label))
        return peer.call(ChangeState, "haptic_device/change_state", request).success

    def labels(service="get_available_transitions"):
        reply = peer.call(GetAvailableTransitions, f"haptic_device/{service}", GetAvailableTransitions.Request())
        return [(d.transition.label, d.start_state.label, d.goal_state.label) for d in reply.available_transitions]

    assert (get_state().id, get_state().label) == (3, "active")
    assert labels() == [("deactivate", "active", "inactive"), ("shutdown", "active", "finalized")]
    states = peer.call(GetAvailableStates, "haptic_device/get_available_states", GetAvailableStates.Request())
    assert [state.label for state in states.available_states] == ["inactive", "active", "finalized"]
    assert len(labels("get_transition_graph")) == 4
    assert not change("activate"), "it is active"

    assert change("deactivate")
    assert get_state().label == "inactive"
    peer.wait_for(lambda: desk.state() == "DISABLED", "deactivate is disable")
    assert labels() == [("activate", "inactive", "active"), ("shutdown", "inactive", "finalized")]
    assert change(number=Transition.TRANSITION_ACTIVATE)
    peer.wait_for(lambda: desk.state() == "ENABLED", "activate is enable")

    desk.command("pause")
    assert get_state().label == "active", "motors on"
    desk.go_to("FAULT")
    assert get_state().label == "inactive", "motors off"
    assert change("activate") and desk.command("enable").state == "ENABLED"
    for nonsense in ("configure", "fly", ""):
        assert not change(nonsense)

    peer.wait_for(lambda: len(events) >= 4, "an event for each change")
    heard = [(e.transition.label, e.start_state.label, e.goal_state.label) for e in events]
    down, up = ("deactivate", "active", "inactive"), ("activate", "inactive", "active")
    assert heard == [down, up, down, up]


def test_the_lifecycles_shutdown_ends_the_node(start, peer):
    driver = start().wait_ready()
    request = ChangeState.Request(transition=Transition(label="shutdown"))
    assert peer.call(ChangeState, "haptic_device/change_state", request).success
    assert driver.process.wait(graph.TIMEOUT_S) == 0
    assert driver.closing_report()["poses"] > 0


def test_a_device_in_a_namespace_has_its_own_state(start, peer):
    for side in ("left", "right"):
        start(namespace=side).wait_ready()
    left = peer.heard(OperatingState, "/left/operating_state", latched(10))
    right = peer.heard(OperatingState, "/right/operating_state", latched(10))
    peer.publish(StringStamped(string="disable"), "/left/state_command", reliable(10))
    peer.wait_for(lambda: left and left[-1].state == "DISABLED" and right, "the left one disabled")
    peer.spin(0.3)
    assert right[-1].state == "ENABLED"
