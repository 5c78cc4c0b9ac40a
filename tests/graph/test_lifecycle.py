"""How nodes start, refuse to start, and end."""

import signal
import subprocess

import pytest
import rclpy
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import Log
from rosgraph_msgs.msg import Clock

import peer as graph
from peer import SCENE, Device, Peer, Program, latched, pressed, yaml_of


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
def start(tmp_path):
    programs = []

    def start(values=SCENE, **options):
        programs.append(Program(tmp_path, "deformation", values, **options))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_node_cleanly_within_a_second(start, peer, number):
    program = start().wait_ready()
    peer.wait_for(lambda: "/deformation" in peer.nodes(), "the node in the graph")
    Device(peer).ask(pressed(0.002))
    code, seconds = program.interrupt(number)
    assert code == 0, program.log()
    assert seconds < 1.0
    assert program.closing_report()["poses"] == 1
    peer.wait_for(lambda: "/deformation" not in peer.nodes(), "the node leaves the graph", 2.0)


def refused(program, peer, *words):
    """The program ends by itself with an error line that has these words and leaves nothing behind."""
    assert program.process.wait(graph.TIMEOUT_S) != 0
    errors = [line for line in program.log().splitlines() if "[deformation]" in line and "ERROR" in line]
    assert len(errors) == 1, program.log()
    for word in words:
        assert word in errors[0], errors[0]
    assert "ready:" not in program.log()
    peer.wait_for(lambda: "/deformation" not in peer.nodes(), "nothing in the graph", 2.0)


BAD_FILES = {
    "unknown key": (yaml_of({**SCENE, "surface.rat": 3.0}), ["surface.rat", "surface.rate"]),
    "wrong type": (yaml_of({**SCENE, "probe.radius": "thick"}), ["probe.radius", "thick"]),
    "out of range": (yaml_of({**SCENE, "surface.cutoff": 1.5}), ["surface.cutoff", "1.5"]),
    "unequal arrays": (yaml_of({**SCENE, "chains.ratio": [0.8, 0.9]}), ["chains."]),
    "mixed array": (yaml_of({**SCENE, "chains.ratio": [0.8]}).replace("[0.8]", "[0.8, 1]"), ["chains.ratio"]),
    "not accepted by the model": (yaml_of({**SCENE, "chains.tangential_stiffness": [1e6]}), ["chains."]),
    "no chains": (yaml_of({"body.mesh": "block"}), ["chains"]),
    "not YAML": ("/**: [\n", []),
    "empty": ("", []),
}


@pytest.mark.parametrize("case", BAD_FILES)
def test_a_bad_parameter_file_is_refused_with_one_line_that_names_it(start, peer, case):
    text, words = BAD_FILES[case]
    program = start(text)
    refused(program, peer, str(program.file), *words)


def test_a_missing_mesh_is_refused_by_key_and_path(start, peer):
    program = start({**SCENE, "body.mesh": "nowhere.obj"})
    refused(program, peer, "body.mesh", str(program.file.with_name("nowhere.obj")))


def test_a_missing_parameter_file_is_refused_by_name(start, peer):
    program = start(arguments=["--params-file", "/nowhere/scene.yaml"])
    refused(program, peer, "/nowhere/scene.yaml")


def test_a_bad_override_on_the_command_line_is_refused(start, peer):
    refused(start(arguments=["-p", "surface.rate:=-5.0"]), peer, "surface.rate", "-5.0")
    refused(start(arguments=["-p", "surface.rates:=5.0"]), peer, "surface.rates", "surface.rate")


def test_an_unclear_wish_for_security_is_refused(start, peer):
    refused(start(environment={"ROS_SECURITY_ENABLE": "1"}), peer, "ROS_SECURITY_ENABLE", '"1"')


def test_log_lines_reach_rosout_from_the_level_on_and_late_readers_too(start, peer):
    start(namespace="quiet", arguments=["--log-level", "error"]).wait_ready()
    start(namespace="chatty", values={**SCENE, "body.scale": 1000.0}).wait_ready()
    lines = peer.heard(Log, "/rosout", latched(1000))
    texts = lambda name: [line.msg for line in lines if line.name == name]
    peer.wait_for(lambda: any("ready:" in text for text in texts("chatty.deformation")), "a line in /rosout")
    assert any("not authenticated" in text for text in texts("chatty.deformation"))
    warnings = [line for line in lines if line.level == 30]
    assert any("body.scale" in line.msg for line in warnings)
    peer.spin(0.5)
    assert texts("quiet.deformation") == []


def test_simulated_time_stamps_diagnostics_and_not_forces(start, peer):
    start(values={**SCENE, "use_sim_time": True}).wait_ready()
    arrays = peer.heard(DiagnosticArray, "/diagnostics", 10)
    device = Device(peer)
    # Like a simulator, /clock ticks: the node reads it best effort, so that a single message may be lost to discovery.
    tick = Clock(clock=Time(sec=42, nanosec=7))

    def simulated_stamp_seen():
        peer.publish(tick, "/clock", 10)
        return any(array.header.stamp == tick.clock for array in arrays)

    peer.wait_for(simulated_stamp_seen, "the simulated stamp")
    device.ask(pressed(0.002))


# The smallest closed surface.
TETRAHEDRON = """
v 0 0 0
v 0.1 0 0
v 0 0.1 0
v 0 0 0.1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""


def test_a_mesh_is_found_beside_its_parameter_file_from_any_working_directory(tmp_path):
    (tmp_path / "body.obj").write_text(TETRAHEDRON)
    scene = tmp_path / "scene.yaml"
    scene.write_text(yaml_of({**SCENE, "body.mesh": "body.obj"}))
    command = [graph.PROGRAMS / "deformation", "--ros-args", "--params-file", scene]
    with subprocess.Popen(command, cwd="/", stderr=subprocess.PIPE, text=True) as process:
        line = next(line for line in process.stderr if "ready:" in line or "ERROR" in line)
        process.send_signal(signal.SIGINT)
    assert "ready: 4 vertices" in line
