"""Programs and peers of the recording tests: the examples of the crate `recording`, nodes, and an rclpy node."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target"))
# The other end of nodes under test is the same for every test of a graph.
sys.path.insert(0, str(REPOSITORY / "tests" / "graph"))


@pytest.fixture(scope="session")
def example():
    """Builds the examples once; `example(name, *arguments)` runs one and returns what it printed."""
    subprocess.run(
        ["cargo", "build", "--locked", "--release", "--quiet", "-p", "recording", "--examples"],
        cwd=REPOSITORY,
        check=True,
    )

    def run(name, *arguments):
        command = [TARGET / "release" / "examples" / name, *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


@pytest.fixture(scope="session")
def printed(example):
    """What our reader finds in a recording: topics by name, and all messages as (topic, log time in ns, values)."""

    def read(path):
        topics, messages = {}, []
        for line in example("print_recording", path).splitlines():
            entry = json.loads(line)
            assert "damage" not in entry, entry
            if "topic" in entry:
                topics[entry["topic"]] = entry
            else:
                messages.append((entry["on"], entry["log_time_ns"], entry["value"]))
        return topics, messages

    return read


@pytest.fixture(scope="session")
def fixture_recording(example, tmp_path_factory):
    """A recording by our writer with every message type; see nodes/recording/examples/write_fixture.rs."""
    path = tmp_path_factory.mktemp("recordings") / "fixture"
    example("write_fixture", path, 1500)
    return path


@pytest.fixture(scope="module")
def ros():
    """rclpy in a domain of its own."""
    import peer
    import rclpy

    peer.isolate()
    peer.PROGRAMS = TARGET / "release"
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def programs(ros):
    """Ends every program given to it, whatever becomes of the test."""
    started = []

    def keep(program):
        started.append(program)
        return program

    yield keep
    for program in started:
        program.kill()


@pytest.fixture
def remote(ros):
    """The other end: an rclpy node with the helpers of `peer.Peer`."""
    import peer

    made = peer.Peer()
    yield made
    made.close()
