"""The playing node over DDS: every message, its order, its spacing, its quality of service."""

import time

import peer
import pytest
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import Joy

# Of the fixture: 1500 poses and forces at 1 kHz, 15 clutch messages.
COUNT = 1500


def player(folder, path, **values):
    values = {"bag_replay.mode": "play", "replay.path": str(path)} | {
        name.replace("__", "."): value for name, value in values.items()
    }
    return peer.Program(folder, "bag_replay", values)


class Ear:
    """Keeps what arrives on some topics, all in one list."""

    def __init__(self, remote, topics):
        self.heard = []
        for topic, kind in topics.items():
            def keep(message, topic=topic):
                self.heard.append((topic, message))

            remote.node.create_subscription(kind, topic, keep, peer.latched(2000) if kind is Joy else peer.reliable(2000))

    def on(self, topic):
        return [message for heard_on, message in self.heard if heard_on == topic]


def test_every_message_is_played_once_in_order_and_the_first_latched_ones_before_all_others(
    tmp_path, programs, remote, fixture_recording
):
    ear = Ear(remote, {"measured_cp": PoseStamped, "servo_cf": WrenchStamped, "clutch": Joy})
    topics = ["measured_cp", "servo_cf", "clutch", "not_in_it"]
    start = time.monotonic()
    program = programs(
        player(tmp_path, fixture_recording, replay__topics=topics, replay__rate=2.0,
               replay__wait_for_subscribers=peer.TIMEOUT_S)
    )  # fmt: skip
    remote.wait_for(lambda: program.process.poll() is not None, "the end of the replay")
    elapsed_s = time.monotonic() - start
    remote.spin(0.2)
    assert program.process.returncode == 0, program.log()
    stamps = [message.header.stamp.nanosec for message in ear.on("measured_cp")]
    assert stamps == [number * 1_000_000 for number in range(COUNT)]
    assert [message.wrench.force.z for message in ear.on("servo_cf")] == [number * 0.01 for number in range(COUNT)]
    assert [list(message.buttons) for message in ear.on("clutch")] == [[1 - number % 2] for number in range(15)]
    # Half of the recorded time at least; how much longer is the machine's business.
    assert elapsed_s >= COUNT * 1e-3 / 2
    report = program.closing_report()
    assert report["topics"] == {"/measured_cp": COUNT, "/servo_cf": COUNT, "/clutch": 15}
    assert report["messages"] == 2 * COUNT + 15 and report["unreadable_places"] == 0


def test_the_replay_offers_the_recorded_quality_of_service_and_ends_at_a_signal(
    tmp_path, programs, remote, fixture_recording
):
    program = programs(player(tmp_path, fixture_recording, replay__rate=0.01).wait_ready())
    offers = {}

    def all_there():
        for topic in ["/clutch", "/measured_cp", "/contact_state"]:
            offers[topic] = remote.node.get_publishers_info_by_topic(topic)
        return all(offers.values())

    remote.wait_for(all_there, "the publishers of the replay")
    assert offers["/clutch"][0].qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert offers["/measured_cp"][0].qos_profile.durability == DurabilityPolicy.VOLATILE
    assert offers["/measured_cp"][0].qos_profile.reliability == ReliabilityPolicy.RELIABLE
    # Latched topics reach those who come late.
    ear = Ear(remote, {"clutch": Joy})
    remote.wait_for(lambda: ear.heard, "the latched message")
    code, _ = program.interrupt()
    assert code == 0, program.log()
    assert program.closing_report()["messages"] < COUNT


def test_the_first_pose_waits_for_as_many_readers_as_it_should(tmp_path, programs, remote, fixture_recording):
    first = Ear(remote, {"measured_cp": PoseStamped})
    program = programs(
        player(tmp_path, fixture_recording, replay__topics=["measured_cp"], replay__rate=2.0,
               replay__wait_for_subscribers=peer.TIMEOUT_S, replay__wait_for_readers=2).wait_ready()
    )  # fmt: skip
    remote.spin(1.0)
    assert not first.heard
    second = Ear(remote, {"measured_cp": PoseStamped})
    remote.wait_for(lambda: program.process.poll() is not None, "the end of the replay")
    remote.spin(0.2)
    assert len(first.heard) == len(second.heard) == COUNT, program.log()


def test_what_is_recorded_from_a_replay_is_the_recording(tmp_path, programs, fixture_recording, printed):
    topics = ["measured_cp", "servo_cf", "contact_state", "surface_displacement", "clutch", "gripper/measured_js", "grasp"]
    values = {"recording.directory": str(tmp_path), "recording.name": "again", "recording.topics": topics}
    recorder = programs(peer.Program(tmp_path / "recorder", "bag_replay", values).wait_ready())
    replay = programs(
        player(tmp_path / "player", fixture_recording, replay__wait_for_subscribers=peer.TIMEOUT_S)
    )
    assert replay.process.wait(4 * peer.TIMEOUT_S) == 0, replay.log()
    assert recorder.interrupt()[0] == 0, recorder.log()
    before, messages_before = printed(fixture_recording)
    after, messages_after = printed(tmp_path / "again")

    def contents(topics, messages):
        """Everything but the times of receipt, which are those of the replay."""
        kinds = {name: (topic["type"], topic["hash"], topic["definition"]) for name, topic in topics.items()}
        return kinds, {name: [values for on, _, values in messages if on == name] for name in kinds}

    assert contents(after, messages_after) == contents(before, messages_before)


def write_unknown_type(path):
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg("float64 x\n", "elsewhere_msgs/msg/Gadget"))
    kind = store.types["elsewhere_msgs/msg/Gadget"]
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/gadget", "elsewhere_msgs/msg/Gadget", typestore=store)
        writer.write(connection, 1, store.serialize_cdr(kind(x=1.0), "elsewhere_msgs/msg/Gadget"))


def break_in_the_middle(path, fixture_recording):
    """Half of the fixture, as a full disk leaves it."""
    bytes_of = (fixture_recording / "fixture_0.mcap").read_bytes()
    path.write_bytes(bytes_of[: len(bytes_of) // 2])


def test_a_cut_recording_plays_as_far_as_it_goes_and_says_so(tmp_path, programs, fixture_recording):
    break_in_the_middle(tmp_path / "cut.mcap", fixture_recording)
    program = programs(player(tmp_path, tmp_path / "cut.mcap", replay__rate=10.0))
    assert program.process.wait(peer.TIMEOUT_S) == 0, program.log()
    report = program.closing_report()
    assert report["unreadable_places"] >= 1 and 0 < report["topics"]["/measured_cp"] < COUNT
    assert "playing what can be read" in program.log()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"replay.path": ""}, ["replay.path", "metadata.yaml"]),
        ({"replay.path": "{folder}/missing"}, ["missing", "No such file"]),
        ({"replay.path": "{folder}/text.mcap"}, ["text.mcap", "magic bytes"]),
        ({"replay.path": "{folder}"}, ["metadata.yaml", ".mcap"]),
        ({"replay.path": "{folder}/unknown"}, ["/gadget", "elsewhere_msgs/msg/Gadget"]),
        ({"replay.path": "{folder}/unknown", "replay.topics": ["other"]}, ["nothing to play", "/gadget"]),
        ({"replay.path": "{folder}/unknown", "replay.topics": ["/a-b"]}, ["replay.topics", "/a-b", "letters"]),
        ({"replay.path": "{folder}/unknown", "replay.rate": 0.0}, ["replay.rate", "0.01"]),
    ],
)
def test_what_cannot_be_played_is_one_error(tmp_path, programs, values, words):
    folder = tmp_path / "empty"
    folder.mkdir()
    values = {name: value.format(folder=folder) if isinstance(value, str) else value for name, value in values.items()}
    if "text.mcap" in str(values):
        (folder / "text.mcap").write_text("this is no recording")
    if "unknown" in str(values):
        write_unknown_type(folder / "unknown")
    program = programs(peer.Program(tmp_path, "bag_replay", {"bag_replay.mode": "play"} | values))
    assert program.process.wait(peer.TIMEOUT_S) == 1
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1, program.log()
    for word in words:
        assert word in errors[0]
