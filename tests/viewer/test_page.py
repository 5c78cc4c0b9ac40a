"""The page in a real browser, on the real nodes: a pointer device, the model, the viewer.

The browser's tests are JavaScript (`*.test.js`). Here the session around them is started, and what the page showed is
compared with what the model said on its topics.
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy
import pytest
import rclpy
import yaml
from rosbags.highlevel import AnyReader

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
sys.path.insert(0, str(REPOSITORY / "tests" / "graph"))
import peer  # noqa: E402
from rhombus_haptics_msgs.msg import SurfaceDisplacement  # noqa: E402

ARTEFACTS = HERE / "artefacts"
CHROMIUM = os.environ.get("RHOMBUS_CHROMIUM") or shutil.which("chromium")
LONGEST_S = 900


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """The liver with a pointer device, and its viewer's address."""
    folder = tmp_path_factory.mktemp("session")
    values = yaml.safe_load((REPOSITORY / "config" / "liver.yaml").read_text())["/**"]["ros__parameters"]
    flat = dict(flattened(values)) | {"device.backend": "pointer", "viewer.port": 0}
    programs = [peer.Program(folder, name, flat) for name in ("deformation", "visualization", "haptic_device")]
    for program in programs:
        program.wait_ready()
    address = re.search(r"viewer: (http://\S+)", programs[1].log())[1]
    yield address, programs[0].file
    for program in reversed(programs):
        program.interrupt()


def flattened(values, prefix=""):
    for key, value in values.items():
        if isinstance(value, dict):
            yield from flattened(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


class Browser:
    """One file of the browser's tests at work; what it says is in a file."""

    def __init__(self, folder, file, address=""):
        assert CHROMIUM, "no chromium on this machine: install it, or set RHOMBUS_CHROMIUM"
        environment = {**os.environ, "RHOMBUS_VIEWER_URL": address, "RHOMBUS_CHROMIUM": CHROMIUM}
        command = ["node", "--test", "--test-concurrency=1", f"--test-timeout={1000 * LONGEST_S}", file]
        self.log = folder / "browser.log"
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(command, cwd=HERE, env=environment, stdout=log, stderr=subprocess.STDOUT)

    def assert_passes(self):
        code, said = self.process.wait(LONGEST_S), self.log.read_text()
        assert code == 0, said
        assert int(re.search(r"# pass (\d+)", said)[1]) > 0 and "# skipped 0" in said, said


def test_the_page_draws_the_organ_and_is_fit_for_people(session, tmp_path):
    Browser(tmp_path, "page.test.js", session[0]).assert_passes()


def test_the_page_stands_a_node_that_sends_nonsense_hangs_and_dies(tmp_path):
    Browser(tmp_path, "hostile.test.js").assert_passes()


def test_the_page_says_that_there_is_no_room_for_it_and_asks_rarely(tmp_path):
    Browser(tmp_path, "refused.test.js").assert_passes()


def test_the_last_minute_is_whole_and_looking_back_moves_nothing(tmp_path):
    Browser(tmp_path, "looking_back.test.js").assert_passes()


def test_fingers_and_keys_press_and_pull_only_when_they_mean_it(tmp_path):
    Browser(tmp_path, "hand.test.js").assert_passes()


def test_a_saved_picture_says_what_it_shows(tmp_path):
    Browser(tmp_path, "figure.test.js").assert_passes()


def test_notices_and_panels_leave_the_body_to_be_seen(tmp_path):
    Browser(tmp_path, "layout.test.js").assert_passes()


def recorded(path, topics):
    """The messages of each topic."""
    found = {f"/{topic}": [] for topic in topics}
    with AnyReader([path]) as reader:
        for connection, _, data in reader.messages():
            found[connection.topic].append(reader.deserialize(data, connection.msgtype))
    return found.values()


def test_the_mouse_presses_the_organ_and_the_page_shows_what_the_model_says(session, tmp_path):
    address, parameters = session
    remote = peer.Peer()
    surfaces = remote.heard(SurfaceDisplacement, "surface_displacement", peer.reliable(1000))
    # A thousand of each a second, beside a browser that draws in software: the recorder loses none.
    topics = ["contact_state", "servo_cf", "measured_cf"]
    recording = {"recording.directory": str(tmp_path), "recording.name": "press", "recording.topics": topics}
    recorder = peer.Program(tmp_path, "bag_replay", recording).wait_ready()
    (ARTEFACTS / "pressed.json").unlink(missing_ok=True)
    browser = Browser(tmp_path, "node.test.js", address)
    while browser.process.poll() is None:
        remote.spin(0.1)
    browser.assert_passes()
    remote.spin(1.0)
    assert recorder.interrupt()[0] == 0, recorder.log()
    contacts, commanded, applied = recorded(tmp_path / "press", topics)
    shown = json.loads((ARTEFACTS / "pressed.json").read_text())
    remote.close()

    vertices = [one["vertex"] for one in shown["moved"]]
    displacements = numpy.array([one["displacement"] for one in shown["moved"]], dtype=numpy.float32)
    order = numpy.argsort(vertices)
    same = [
        surface
        for surface in surfaces
        if list(surface.vertex) == sorted(vertices)
        and numpy.array_equal(numpy.reshape(surface.displacement, (-1, 3)), displacements[order])
    ]
    assert same, "the page showed a surface that the model never published"
    state = shown["state"]
    close = lambda a, b: abs(a - b) <= 1e-6 * max(abs(a), abs(b), 1e-3)
    shows = lambda shown, forces: any(
        all(close(shown_part, part) for shown_part, part in zip(shown, peer.force_of(force))) for force in forces
    )
    assert shows(state["command"], commanded), "the page showed a command that the model never gave"
    assert state["forceApplied"] and shows(state["force"], applied), "the page showed a force that the motors never gave"
    contact = min(contacts, key=lambda contact: abs(contact.depth - state["depthM"]))
    assert close(contact.depth, state["depthM"])
    expected_n = peer.library_force_n(parameters, state["depthM"])
    assert abs(math.hypot(*state["force"]) - expected_n) <= 0.01 * expected_n
