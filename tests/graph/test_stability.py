"""A session says at its start, in the words of `rhombus stability`, when its device cannot render the body."""

import json
import subprocess

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped

import peer as graph
from peer import PROGRAMS, SCENE, Peer, Program, reliable

SESSION = {**SCENE, "device.rate": 200.0, "device.wait_for_readers": 2, "simulated.period": 6.0}


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


@pytest.fixture
def session(tmp_path, peer):
    """Starts model and driver, and waits until the device has moved for a while; what the driver logged."""
    programs = []

    def session(**values):
        values = {**SESSION, **values}
        poses = peer.heard(PoseStamped, "measured_cp", reliable(1000))
        programs.append(Program(tmp_path, "deformation", values).wait_ready())
        programs.append(Program(tmp_path, "haptic_device", values))
        peer.wait_for(lambda: len(poses) > 100, "100 poses")
        return programs[-1]

    yield session
    for program in programs:
        program.kill()


def warnings(program):
    return [line for line in program.log().splitlines() if "stability: " in line]


def asked(file):
    """What the command line says of a scene and its simulated device."""
    command = [str(PROGRAMS / "rhombus"), "stability", str(file), "--device", "simulated", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def test_a_device_with_too_little_damping_is_warned_of_once_in_the_words_of_the_command_line(session, peer):
    program = session(**{"simulated.damping": 0.05})
    peer.wait_for(lambda: warnings(program), "a warning")
    said = asked(program.file)
    assert said["passive"] is False
    assert len(warnings(program)) == 1, program.log()
    assert f"stability: {said['verdict']}" in warnings(program)[0]
    assert "WARN" in warnings(program)[0]


def test_a_device_with_enough_damping_is_not_spoken_of(session, peer):
    program = session(**{"simulated.damping": 50.0})
    peer.spin(1.0)
    assert asked(program.file)["passive"] is True
    assert warnings(program) == []


def test_motors_that_follow_servo_cf_need_more_damping_than_motors_that_follow_the_law(session, peer, tmp_path):
    file = tmp_path / "needs.yaml"
    file.write_text(graph.yaml_of(SESSION))
    # Half a period without delay, one and a half with one period of it: three times as much.
    enough_for_the_law = 1.5 * asked(file)["needed_damping_n_s_per_m"]
    program = session(**{"simulated.damping": enough_for_the_law, "device.force_source": "servo_cf"})
    peer.wait_for(lambda: warnings(program), "a warning")
    assert "with 5 ms of delay" in warnings(program)[0]
