"""`./launch/demo`, as a person runs it: four processes, a summary, a recording, one clear error for what is wrong."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

REPOSITORY = Path(__file__).resolve().parents[2]
DEMO = REPOSITORY / "launch" / "demo"


@pytest.fixture
def name():
    """A name for recording and logs; both are removed afterwards."""
    name = f"test-{os.getpid()}-{time.monotonic_ns()}"
    yield name
    shutil.rmtree(REPOSITORY / "recordings" / name, ignore_errors=True)
    shutil.rmtree(REPOSITORY / "log" / name, ignore_errors=True)


def environment():
    return {**os.environ, "ROS_DOMAIN_ID": "83", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def run(*arguments):
    return subprocess.run(
        [DEMO, *arguments], capture_output=True, text=True, timeout=120, env=environment(), check=False
    )


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
        [DEMO, "--duration", "60", "--no-record", "--record", name],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
    )
    log = REPOSITORY / "log" / name / "haptic_device.log"
    deadline = time.monotonic() + 60
    while not (log.exists() and "ready:" in log.read_text()) and time.monotonic() < deadline:
        time.sleep(0.1)
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
        (["--device", "omega"], "accepted: simulated"),
        (["--record", "../up"], "--record '../up' is not a name"),
        (["--colour"], "unknown option '--colour'"),
        (["--duration"], "--duration needs a value"),
    ],
)
def test_a_wrong_option_is_one_line_and_starts_nothing(arguments, said):
    result = run(*arguments)
    assert result.returncode == 2
    assert said in result.stderr and len(result.stderr.splitlines()) == 1


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
    assert result.returncode == 0 and "--no-record" in result.stdout
