"""The recording node over DDS: it loses nothing, adapts to its publishers, and leaves a readable file however it ends."""

import json
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import peer
import pytest
from crtk_msgs.msg import OperatingState, StringStamped
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability, QosReliability
from ruamel.yaml import YAML
from sensor_msgs.msg import JointState, Joy
from shape_msgs.msg import Mesh
from std_msgs.msg import Bool, Empty, String

# A publisher that knows a reader is not yet known to it: what it sends meanwhile comes late, or never if it is best effort.
SETTLE_S = 0.5
BEST_EFFORT = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


def recorder(folder, namespace="", **values):
    values = {"recording.directory": str(folder), "recording.name": "session"} | {
        name.replace("__", "."): value for name, value in values.items()
    }
    return peer.Program(folder, "bag_replay", values, namespace).wait_ready()


def pose(number):
    message = PoseStamped()
    message.header.stamp.nanosec = number
    return message


def read(path):
    """Messages of each topic, decoded, in their order."""
    found = {}
    with AnyReader([path]) as reader:
        for connection, _, data in reader.messages():
            found.setdefault(connection.topic, []).append(reader.deserialize(data, connection.msgtype))
    return found


def numbers(messages):
    return [message.header.stamp.nanosec for message in messages]


def test_no_message_is_lost_at_1_khz_on_six_topics_and_surfaces(tmp_path, programs):
    topics = ["measured_cp", "measured_cv", "measured_cf", "servo_cf", "contact_state", "contact_law_copy",
              "surface_displacement"]  # fmt: skip
    program = programs(recorder(tmp_path, recording__topics=topics))
    publisher = subprocess.Popen(
        [sys.executable, Path(__file__).with_name("numbered_publisher.py"), "10000", *topics],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        sent = json.loads(publisher.stdout.readline())["sent"]
        assert program.interrupt()[0] == 0, program.log()
    finally:
        publisher.communicate("end\n")
    assert sent["measured_cp"] == 10_000 and sent["surface_displacement"] == 600
    report = program.closing_report()
    assert report["topics"] == {f"/{topic}": count for topic, count in sent.items()}
    found = read(tmp_path / "session")
    for topic, count in sent.items():
        assert numbers(found[f"/{topic}"]) == list(range(count)), topic


def test_publishers_of_any_quality_of_service_are_recorded_with_it(tmp_path, programs, remote):
    latched = remote.node.create_publisher(Mesh, "body_mesh", peer.latched(1))
    latched.publish(Mesh())
    words_topic = "a/topic/of/nobody_we_know"
    program = programs(recorder(tmp_path, recording__topics=["measured_cp", "clutch", "body_mesh", words_topic]))
    # Reliable and latched is what the recorder asks for on these two, until it sees that less is offered.
    weak_pose = remote.node.create_publisher(PoseStamped, "measured_cp", BEST_EFFORT)
    weak_clutch = remote.node.create_publisher(Joy, "clutch", peer.reliable(10))
    words = remote.node.create_publisher(String, words_topic, peer.reliable(10))
    publishers = [weak_pose, weak_clutch, words, latched]
    remote.wait_for(lambda: all(publisher.get_subscription_count() for publisher in publishers), "the recorder")
    remote.spin(SETTLE_S)
    for number in range(10):
        weak_pose.publish(pose(number))
        weak_clutch.publish(Joy(buttons=[number]))
        words.publish(String(data=str(number)))
        time.sleep(0.01)
    remote.spin(0.3)
    assert program.interrupt()[0] == 0, program.log()
    found = read(tmp_path / "session")
    assert len(found["/body_mesh"]) == 1
    assert numbers(found["/measured_cp"]) == list(range(10))
    assert [list(joy.buttons) for joy in found["/clutch"]] == [[number] for number in range(10)]
    assert [word.data for word in found[f"/{words_topic}"]] == [str(number) for number in range(10)]
    with AnyReader([tmp_path / "session"]) as reader:
        qos = {connection.topic: connection.ext.offered_qos_profiles for connection in reader.connections}
    assert qos["/measured_cp"][0].reliability == QosReliability.BEST_EFFORT
    assert qos["/clutch"][0].durability == QosDurability.VOLATILE
    assert qos["/body_mesh"][0].durability == QosDurability.TRANSIENT_LOCAL


def test_by_default_the_topics_of_the_namespace_and_its_devices_are_recorded(tmp_path, programs, remote):
    program = programs(recorder(tmp_path, namespace="or", devices=["left", "right"]))
    named = ["/or/left/measured_cp", "/or/right/measured_cp"]
    publishers = [remote.node.create_publisher(PoseStamped, topic, peer.reliable(10)) for topic in [*named, "/measured_cp"]]
    remote.wait_for(lambda: all(publisher.get_subscription_count() for publisher in publishers[:2]), "the recorder")
    for publisher in publishers:
        publisher.publish(pose(1))
    # Health is said once a second.
    remote.spin(1.2)
    assert program.interrupt()[0] == 0, program.log()
    topics = program.closing_report()["topics"]
    assert {topic: topics.get(topic) for topic in named} == dict.fromkeys(named, 1)
    assert "/measured_cp" not in topics
    # The recorder's own health is part of the session.
    assert topics["/diagnostics"] >= 1


def test_everything_a_session_says_is_recorded_with_buttons_of_any_name(tmp_path, programs, remote):
    program = programs(recorder(tmp_path))
    kinds = {
        "operating_state": (OperatingState, peer.latched(10)),
        "state_command": (StringStamped, peer.reliable(10)),
        "emergency_stop": (Bool, peer.reliable(10)),
        "hold": (Empty, peer.reliable(10)),
        "free": (Empty, peer.reliable(10)),
        "body/measured_cf": (WrenchStamped, peer.reliable(10)),
        "body/servo_cf": (WrenchStamped, peer.reliable(10)),
        "spatial/measured_cf": (WrenchStamped, peer.reliable(10)),
        "measured_js": (JointState, peer.reliable(10)),
        "gripper/servo_jf": (JointState, peer.reliable(10)),
        "coag": (Joy, peer.latched(10)),
    }
    publishers = {name: remote.node.create_publisher(kind, name, qos) for name, (kind, qos) in kinds.items()}
    for name, (kind, _) in kinds.items():
        # A latched one is kept for whoever comes, the others wait for the recorder.
        if name != "coag":
            remote.wait_for(publishers[name].get_subscription_count, f"the recorder on {name}")
        publishers[name].publish(kind())
    remote.wait_for(publishers["coag"].get_subscription_count, "the recorder on a button")
    remote.spin(SETTLE_S)
    assert program.interrupt()[0] == 0, program.log()
    counts = program.closing_report()["topics"]
    assert {name: counts.get(f"/{name}") for name in kinds} == dict.fromkeys(kinds, 1)
    assert set(read(tmp_path / "session")) >= {f"/{name}" for name in kinds}


def test_log_times_are_those_of_receipt_and_not_of_fetching(tmp_path, programs, remote):
    program = programs(recorder(tmp_path, recording__topics=["measured_cp", "grasp"]))
    poses = remote.node.create_publisher(PoseStamped, "measured_cp", peer.reliable(100))
    grasps = remote.node.create_publisher(Bool, "grasp", peer.reliable(100))
    remote.wait_for(lambda: poses.get_subscription_count() and grasps.get_subscription_count(), "the recorder")
    remote.spin(SETTLE_S)
    sent = []
    for number in range(100):
        sent.append(time.time_ns())
        (grasps.publish(Bool(data=True)) if number % 10 == 5 else poses.publish(pose(number)))
        time.sleep(0.002)
    assert program.interrupt()[0] == 0, program.log()
    with AnyReader([tmp_path / "session"]) as reader:
        found = [(connection.topic, at) for connection, at, _ in reader.messages()]
    # Across topics too, although each is fetched on its own and only every 10 ms.
    assert [topic for topic, _ in found] == ["/grasp" if number % 10 == 5 else "/measured_cp" for number in range(100)]
    delays_ms = sorted((at - sent_at) * 1e-6 for (_, at), sent_at in zip(found, sent))
    assert delays_ms[0] > -0.5 and delays_ms[50] < 5.0, delays_ms


@pytest.mark.parametrize("version", [5, 9])
def test_the_metadata_has_the_version_that_is_asked_for(tmp_path, programs, remote, version):
    program = programs(recorder(tmp_path, recording__topics=["measured_cp"], recording__metadata_version=version))
    remote.publish(pose(1), "measured_cp", peer.reliable(10))
    remote.spin(SETTLE_S)
    assert program.interrupt()[0] == 0, program.log()
    text = (tmp_path / "session" / "metadata.yaml").read_text()
    assert YAML(typ="safe").load(text)["rosbag2_bagfile_information"]["version"] == version
    assert numbers(read(tmp_path / "session")["/measured_cp"]) == [1]


def test_a_recorder_killed_while_it_writes_leaves_all_but_the_last_second(tmp_path, programs, example):
    topics = ["measured_cp", "servo_cf", "surface_displacement"]
    program = programs(recorder(tmp_path, recording__topics=topics))
    publisher = subprocess.Popen(
        [sys.executable, Path(__file__).with_name("numbered_publisher.py"), "60000", *topics],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    try:
        file = tmp_path / "session" / "session_0.mcap"
        end = time.monotonic() + peer.TIMEOUT_S
        while file.stat().st_size < 3_000_000:
            assert time.monotonic() < end
            time.sleep(0.01)
        killed_ns = time.time_ns()
        program.process.send_signal(signal.SIGKILL)
        program.process.wait()
    finally:
        publisher.kill()
        publisher.communicate()
    lines = [json.loads(line) for line in example("print_recording", tmp_path / "session").splitlines()]
    assert any("damage" in line for line in lines)
    for topic in topics:
        found = [line for line in lines if line.get("on") == f"/{topic}"]
        stamps = [line["value"]["header"]["stamp"]["nanosec"] for line in found]
        assert stamps == list(range(len(stamps))), topic
        assert killed_ns - found[-1]["log_time_ns"] < 1_000_000_000, topic


@pytest.fixture
def small_disk(tmp_path):
    """A disk of 4 MB."""
    path = tmp_path / "disk"
    path.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "small_disk", path], capture_output=True, text=True)
    if mounted.returncode != 0:
        pytest.skip(f"mounting is not permitted here: {mounted.stderr.strip()}")
    yield path
    subprocess.run(["umount", path], check=True)


@pytest.mark.parametrize("full", ["limit", "disk"])
def test_a_full_disk_is_one_error_and_what_was_written_stays_readable(tmp_path, programs, example, request, full):
    topics = ["measured_cp", "surface_displacement"]
    folder = request.getfixturevalue("small_disk") if full == "disk" else tmp_path
    program = programs(recorder(tmp_path, recording__topics=topics, recording__directory=str(folder)))
    if full == "limit":
        # A file that must not grow further fails to be written as one on a full disk does.
        limit = 4_000_000
        resource.prlimit(program.process.pid, resource.RLIMIT_FSIZE, (limit, limit))
    publisher = subprocess.Popen(
        [sys.executable, Path(__file__).with_name("numbered_publisher.py"), "60000", *topics],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    try:
        assert program.process.wait(2 * peer.TIMEOUT_S) == 1, program.log()
    finally:
        publisher.kill()
        publisher.communicate()
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1, program.log()
    reason = {"limit": "File too large", "disk": "No space left on device"}[full]
    for word in ("session_0.mcap", "cannot write", "stays readable"):
        assert word in errors[0]
    assert errors[0].count(reason) == 1, errors[0]
    assert "panicked" not in program.log()
    lines = [json.loads(line) for line in example("print_recording", folder / "session").splitlines()]
    for topic in topics:
        found = [line["value"]["header"]["stamp"]["nanosec"] for line in lines if line.get("on") == f"/{topic}"]
        assert found == list(range(len(found))) and len(found) > 20, topic


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"recording.name": "../elsewhere"}, ["recording.name", "../elsewhere", "letters"]),
        ({"recording.name": "there_already"}, ["there_already", "exists", "not overwritten"]),
        ({"recording.directory": "/proc/nothing"}, ["/proc/nothing"]),
        ({"recording.topics": ["measured_cp", "white space"]}, ["recording.topics", "/white space"]),
        ({"bag_replay.mode": "rewind"}, ["bag_replay.mode", "rewind", "record", "play"]),
    ],
)
def test_what_cannot_be_recorded_is_one_error_and_leaves_nothing_behind(tmp_path, programs, values, words):
    (tmp_path / "there_already").mkdir()
    values = {"recording.directory": str(tmp_path)} | values
    program = programs(peer.Program(tmp_path / "logs", "bag_replay", values))
    assert program.process.wait(peer.TIMEOUT_S) == 1
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1, program.log()
    for word in words:
        assert word in errors[0]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["logs", "there_already"]
