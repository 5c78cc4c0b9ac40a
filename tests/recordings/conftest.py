"""Runs the examples of the crate `recording`, which write and print recordings."""

import json
import os
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def example():
    """Builds the examples once; `example(name, *arguments)` runs one and returns what it printed."""
    subprocess.run(
        ["cargo", "build", "--locked", "--quiet", "-p", "recording", "--examples"], cwd=REPOSITORY, check=True
    )
    target = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target"))

    def run(name, *arguments):
        command = [target / "debug" / "examples" / name, *map(str, arguments)]
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
