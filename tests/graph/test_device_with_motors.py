"""The driver with a device at a serial port, played by a double that records what reaches its motors."""

import signal
import subprocess
import time

import pytest
import rclpy
from crtk_msgs.msg import OperatingState, StringStamped
from geometry_msgs.msg import PoseStamped
from pytest import approx
from sensor_msgs.msg import JointState

import peer as graph
from peer import CALM, PROGRAMS, Client, Handle, Peer, Program, latched, reliable


class Double:
    """A self-built device with a hand that stays where it is."""

    def __init__(self, folder):
        self.port, self.file = folder / "tty", folder / "record.csv"
        command = [PROGRAMS / "serial_double", "--link", self.port, "--record", self.file]
        command += ["--from", "0,0,0", "--to", "0,0,0", "--stiffness", "5000", "--damping", "100", "--mass", "1"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline().startswith("ready: ")

    def events(self):
        """Event, force on the hand and gripper force of every line."""
        rows = [line.split(",") for line in self.file.read_text().splitlines()[1:]]
        return [(row[1], tuple(map(float, row[2:5])), float(row[8])) for row in rows if len(row) == 10]

    def pull(self):
        self.process.send_signal(signal.SIGUSR1)

    def plug(self):
        self.process.send_signal(signal.SIGUSR2)

    def close(self):
        self.process.kill()
        self.process.wait()


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def double(tmp_path):
    double = Double(tmp_path)
    yield double
    double.close()


@pytest.fixture
def start(tmp_path, double):
    programs = []

    def start(**values):
        device = {"device.backend": "serial", "serial.port": str(double.port), "device.force_source": "servo_cf"}
        programs.append(Program(tmp_path, "haptic_device", {**CALM, **device, **values}))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


def test_disable_takes_the_force_from_the_motors_and_then_switches_them_off(start, double, peer):
    # The slowest slew limit that is safe with 12 N.
    start(**{"device.rate": 1000.0, "safety.slew": 400.0, "device.max_force": 12.0}).wait_ready()
    handle, client = Handle(peer), Client(peer)
    peer.wait_for(lambda: handle.forces, "measured forces")
    client.engage(handle)
    last = lambda: double.events()[-1]
    client.until((1.0, 0.0, 0.0), lambda: last()[1] == approx((1.0, 0.0, 0.0), abs=1e-3), "1 N at the motors")
    peer.publish(StringStamped(string="disable"), "state_command", reliable(10))
    client.until((1.0, 0.0, 0.0), lambda: last()[0] == "off", "motors off")
    client.stream((1.0, 0.0, 0.0), 0.5)
    events = double.events()
    off = max(i for i, (event, *_) in enumerate(events) if event == "off")
    assert not [force for event, force, _ in events[off:] if event == "command" and any(force)]
    falling = [force[0] for event, force, _ in events[:off] if event == "command"][-40:]
    steps = [before - after for before, after in zip(falling, falling[1:])]
    assert falling[-1] == 0.0 and max(steps) <= 0.4 + 1e-6, "400 N/s, a period of 1 ms"
    assert sum(step > 1e-3 for step in steps) >= 3, "not at once"


def test_the_force_of_a_gripper_with_a_motor_goes_along_with_the_wrench(start, double, peer):
    driver = start().wait_ready()
    handle, client = Handle(peer), Client(peer)
    peer.wait_for(lambda: handle.forces, "measured forces")
    client.engage(handle)

    def grip(*effort):
        message = JointState(effort=[float(e) for e in effort])
        message.header.stamp = peer.node.get_clock().now().to_msg()
        peer.publish(message, "gripper/servo_jf", reliable(10))

    def gripping():
        grip(0.8)
        return double.events()[-1][2] == approx(0.8, abs=1e-3)

    client.until((0.0, 0.0, 0.0), gripping, "the gripper's force at the motor")
    client.until((0.0, 0.0, 0.0), lambda: double.events()[-1][2] == 0.0, "none when nobody commands it any more")
    grip(0.1, 0.2)
    grip(float("nan"))
    peer.wait_for(lambda: "the effort is not finite" in driver.log() or "2 entries" in driver.log(), "a refusal")


def test_a_device_that_is_unplugged_is_a_fault_and_comes_back_disabled_from_force(start, double, peer):
    driver = start().wait_ready()
    states = peer.heard(OperatingState, "operating_state", latched(10))
    poses = peer.heard(PoseStamped, "measured_cp", reliable(1000))
    state = lambda: states[-1].state if states else ""
    peer.wait_for(lambda: state() == "ENABLED" and poses, "an enabled device")
    double.pull()
    peer.wait_for(lambda: state() == "FAULT", "a fault")
    level, summary, values = peer.new_status("/haptic_device: operating state")
    assert level == 2 and "stopped answering" in summary
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    peer.spin(0.5)
    assert state() == "FAULT" and driver.process.poll() is None, "nothing to enable, and the node lives"

    told = lambda: driver.log().count("the lost device is looked for: ")
    peer.wait_for(lambda: told() == 1, "why it is not opened again")
    count = len(poses)
    double.plug()
    peer.wait_for(lambda: len(poses) > count + 10, "poses again")
    assert state() == "FAULT", "until somebody says so"
    peer.publish(StringStamped(string="enable"), "state_command", reliable(10))
    peer.wait_for(lambda: state() == "ENABLED", "the device enabled again")
    double.pull()
    peer.wait_for(lambda: told() == 2, "the reason, told for this loss as well")
    assert driver.interrupt()[0] == 0
    assert driver.closing_report()["losses"] == 2


def test_no_device_at_the_start_is_one_clear_error(start, double, tmp_path):
    driver = start(**{"serial.port": str(tmp_path / "nothing")})
    assert driver.process.wait(graph.TIMEOUT_S) == 1
    errors = [line for line in driver.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1 and str(tmp_path / "nothing") in errors[0], driver.log()


def test_a_driver_that_is_ended_while_it_waits_for_readers_never_switches_the_motors_on(start, double):
    driver = start(**{"device.wait_for_readers": 3})
    deadline = time.monotonic() + 20.0
    while "readers of measured_cp are there" not in driver.log():
        assert time.monotonic() < deadline, driver.log()
        time.sleep(0.05)
    assert driver.interrupt()[0] == 0, driver.log()
    assert "ready:" not in driver.log()
    assert "enable" not in {event for event, *_ in double.events()}
