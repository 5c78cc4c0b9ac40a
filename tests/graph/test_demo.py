"""`./launch/demo`, as a person runs it: its processes, a summary, a recording, one clear error for what is wrong."""

import os
import re
import shutil
import signal
import socket
import subprocess
import time
import urllib.request
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

REPOSITORY = Path(__file__).resolve().parents[2]
# The default port of the viewer may be somebody else's.
DEMO = [REPOSITORY / "launch" / "demo", "--set", "viewer.port=0"]


@pytest.fixture
def name():
    """A name for recording and logs; both are removed afterwards."""
    name = f"test-{os.getpid()}-{time.monotonic_ns()}"
    yield name
    shutil.rmtree(REPOSITORY / "recordings" / name, ignore_errors=True)
    shutil.rmtree(REPOSITORY / "log" / name, ignore_errors=True)


def environment():
    return {**os.environ, "ROS_DOMAIN_ID": "101", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def run(*arguments):
    return subprocess.run(
        [*DEMO, *arguments], capture_output=True, text=True, timeout=120, env=environment(), check=False
    )


def wait_ready(log, demo):
    """Until the node of this log is ready; the demo may have to compile first."""
    deadline = time.monotonic() + 120
    while not (log.exists() and "ready:" in log.read_text()):
        assert demo.poll() is None and time.monotonic() < deadline, demo.communicate(timeout=30)
        time.sleep(0.1)


def test_a_session_ends_with_a_summary_and_a_whole_recording(name):
    result = run("--duration", "8", "--record", name)
    assert result.returncode == 0, result.stderr
    assert result.stdout.splitlines()[-1] == f"recording: recordings/{name}"
    sent = int(re.search(r"poses sent\s+(\d+)", result.stdout)[1])
    assert sent > 6000
    assert re.search(r"poses unanswered\s+0\b", result.stdout), result.stdout
    assert float(re.search(r"peak depth\s+([\d.]+) mm", result.stdout)[1]) > 2.0
    with AnyReader([REPOSITORY / "recordings" / name]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
    assert counts["/measured_cp"] == counts["/servo_cf"] == counts["/contact_state"] == sent
    assert counts["/body_mesh"] == 1
    assert counts["/surface_displacement"] > 300


def test_a_node_that_dies_ends_the_session_with_its_log(name):
    demo = subprocess.Popen(
        [*DEMO, "--duration", "60", "--no-record", "--record", name],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
    )
    wait_ready(REPOSITORY / "log" / name / "haptic_device.log", demo)
    # The session started this deformation node: its parent is the session's process.
    children = subprocess.run(["pgrep", "-P", str(demo.pid), "-f", "deformation"], capture_output=True, text=True)
    os.kill(int(children.stdout.split()[0]), signal.SIGKILL)
    _, errors = demo.communicate(timeout=30)
    assert demo.returncode == 1
    assert "deformation ended by itself with exit code -9" in errors


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--duration", "-1"], "--duration '-1'"),
        (["--mesh", "/no/such.obj"], "--mesh '/no/such.obj': no such file"),
        (["--scene", "/no/such.yaml"], "--scene '/no/such.yaml': no such file"),
        (["--record", "../up"], "--record '../up' is not a name"),
        (["--colour"], "unknown option '--colour'"),
        (["--duration"], "--duration needs a value"),
    ],
)
def test_a_wrong_option_is_one_line_and_starts_nothing(arguments, said):
    result = run(*arguments)
    assert result.returncode == 2
    assert said in result.stderr and len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--device", "omega"], "\"omega\" is not accepted; accepted: string, \"simulated\" or \"force_dimension\" or"),
        (["--device", "="], "--device '='; accepted: [NAME=]BACKEND[:SERIAL]"),
        (["--device", "simulated", "--device", "right=haply"], "several devices need names"),
        (["--device", "a=simulated", "--device", "a=haply"], "the name 'a' is given twice"),
        (["--set", "device.max_forse=3"], "device.max_forse: unknown parameter; did you mean device.max_force?"),
        (["--set", "device.max_force=-3"], "device.max_force: -3.0 is not accepted; accepted: number, 0 to 100 [N]"),
        (["--set", "device.backend=haply"], "device.backend is what --device says"),
        (["--set", "serial.port"], "--set 'serial.port'; accepted: [NAME/]KEY=VALUE"),
        (["--set", "right/device.rate=500"], "no device is called 'right'"),
        (["--device", "left=simulated", "--set", "left/device.rate=5"], "device.rate: 5.0 is not accepted"),
    ],
)
def test_a_wrong_device_or_setting_is_one_line_and_starts_nothing(arguments, said, name):
    result = run(*arguments, "--record", name)
    assert result.returncode == 2, result.stderr
    last = result.stderr.splitlines()[-1]
    assert last.startswith("demo: ") and said in last, result.stderr
    assert not (REPOSITORY / "recordings" / name).exists()
    assert not (REPOSITORY / "log" / name / "deformation.log").exists()


@pytest.fixture
def scene(tmp_path):
    """A copy of a scene: whoever has it on the command line belongs to the test."""
    return shutil.copy(REPOSITORY / "config" / "liver.yaml", tmp_path / "scene.yaml")


def processes_with(text):
    found = subprocess.run(["pgrep", "-f", "--", f"params-file {text}"], capture_output=True, text=True, check=False)
    return found.stdout.split()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--device", "serial:R7", "--set", "serial.port=/dev/none"], "haptic_device: no serial device: "),
        (["--device", "left=simulated", "--device", "right=haply", "--set", "haply.url=ws://localhost:9"], "right: no haply"),
    ],
)
def test_a_device_that_is_not_there_is_the_drivers_sentence_and_nothing_is_left(arguments, said, name, scene):
    result = run("--scene", scene, *arguments, "--record", name)
    assert result.returncode == 1
    ours = [line for line in result.stderr.splitlines() if not line.lstrip().startswith(("building", "Compiling", "Finished"))]
    assert len(ours) == 1 and ours[0].startswith(f"demo: {said}"), result.stderr
    assert processes_with(scene) == []
    assert not (REPOSITORY / "recordings" / name).exists(), "nothing was recorded"


def test_a_scene_whose_sections_are_of_another_namespace_is_the_drivers_sentence(name):
    scene = REPOSITORY / "config" / "two_hands.yaml"
    result = run("--scene", scene, "--namespace", "or1", "--record", name)
    assert result.returncode == 1
    said = [line for line in result.stderr.splitlines() if line.startswith("demo: ")]
    # Of two drivers that refuse at the same time the demo may hear one only.
    sides = [line.split(": ")[1] for line in said]
    assert sides and set(sides) <= {"left", "right"}, result.stderr
    for side in sides:
        assert f"section /{side}/haptic_device would be ignored by /or1/{side}/haptic_device" in result.stderr


def test_two_hands_are_in_the_summary_and_in_the_recording(name):
    scene = REPOSITORY / "config" / "two_hands.yaml"
    result = run("--scene", scene, "--set", "device.rate=200", "--duration", "8", "--record", name)
    assert result.returncode == 0, result.stderr
    parts = re.split(r"^(left|right|all)\b.*$", result.stdout, flags=re.MULTILINE)
    assert parts[1::2] == ["left", "right", "all"], result.stdout
    sent = {}
    for side, text in zip(parts[1:4:2], parts[2:5:2]):
        sent[side] = int(re.search(r"poses sent\s+(\d+)", text)[1])
        assert sent[side] > 1400 and re.search(r"poses unanswered\s+0\b", text), text
        assert float(re.search(r"peak depth\s+([\d.]+) mm", text)[1]) > 2.0, text
    with AnyReader([REPOSITORY / "recordings" / name]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
    for side in ("left", "right"):
        for topic in ("measured_cp", "servo_cf", "contact_state"):
            assert counts[f"/{side}/{topic}"] == sent[side], topic
    assert 400 < counts["/surface_displacement"] < 700, "60 Hz, not 60 for each hand"


def test_a_real_device_runs_until_ctrl_c_and_its_motors_go_off(name, scene, tmp_path):
    port, record = tmp_path / "tty", tmp_path / "record.csv"
    double = subprocess.Popen(
        [REPOSITORY / "target" / "release" / "serial_double", "--link", port, "--record", record, "--serial", "D1"],
        stdout=subprocess.PIPE,
        text=True,
    )
    demo = None
    try:
        assert double.stdout.readline().startswith("ready: ")
        demo = subprocess.Popen(
            [*DEMO, "--scene", scene, "--device", "arm=serial:D1", "--set", f"arm/serial.port={port}", "--record", name],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment(),
        )
        wait_ready(REPOSITORY / "log" / name / "arm_haptic_device.log", demo)
        time.sleep(2.0)
        assert demo.poll() is None, "no end by itself"
        events = lambda: [line.split(",")[1] for line in record.read_text().splitlines()[1:]]
        assert "command" in events()
        demo.send_signal(signal.SIGINT)
        output, errors = demo.communicate(timeout=30)
        assert demo.returncode == 0, errors
        assert "arm (serial D1)" in output
        assert output.splitlines()[-1] == f"recording: recordings/{name}"
        assert events()[-1] == "off", "by command and not by the device's own watchdog"
        assert processes_with(scene) == []
    finally:
        double.kill()
        double.wait()
        if demo and demo.poll() is None:
            demo.terminate()


def test_a_session_led_by_the_mouse_says_where_its_page_is_and_runs_until_ctrl_c(name, scene):
    with socket.socket() as any_free:
        any_free.bind(("127.0.0.1", 0))
        port = any_free.getsockname()[1]
    demo = subprocess.Popen(
        [
            *(REPOSITORY / "launch" / "demo", "--scene", scene, "--device", "pointer"),
            *("--set", f"viewer.port={port}", "--no-record", "--record", name),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
    )
    try:
        assert demo.stdout.readline() == f"viewer: http://127.0.0.1:{port}/\n"
        assert "drag presses" in demo.stdout.readline()
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=10) as page:
            assert "text/html" in page.headers["content-type"]
        time.sleep(2.0)
        assert demo.poll() is None, "no end by itself"
        demo.send_signal(signal.SIGINT)
        output, errors = demo.communicate(timeout=30)
        assert demo.returncode == 0, errors
        assert output.splitlines()[-1] == "recording: none (--no-record)"
        assert processes_with(scene) == []
    finally:
        if demo.poll() is None:
            demo.terminate()


def test_a_wrong_scene_is_refused_before_any_node_starts(tmp_path, name):
    scene = tmp_path / "scene.yaml"
    scene.write_text("/**:\n  ros__parameters:\n    surface.cutof: 0.1\n")
    result = run("--scene", str(scene), "--record", name)
    assert result.returncode == 2
    assert f"{scene}:3" in result.stderr and "surface.cutoff" in result.stderr
    assert not (REPOSITORY / "recordings" / name).exists()
    assert not list((REPOSITORY / "log" / name).glob("*.log.*")) and not (
        REPOSITORY / "log" / name / "deformation.log"
    ).exists()


def test_help_is_help():
    result = run("--help")
    assert result.returncode == 0 and "--no-record" in result.stdout and "--device left=BACKEND" in result.stdout
