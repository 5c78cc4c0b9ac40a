"""What our writer writes, `rosbags` and `mcap-ros2-support` read back message for message, and the other way round.

Both were written by others from the specification, so that agreement here is not agreement with ourselves.
"""

from dataclasses import fields, is_dataclass

import numpy
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML

COUNT = 1500
START_NS = 1_700_000_000_000_000_000
STEP_NS = 1_000_000
# What rosbag2 writes into metadata.yaml of version 9, in its order.
METADATA_KEYS = """version storage_identifier duration starting_time message_count topics_with_message_count
compression_format compression_mode relative_file_paths files custom_data ros_distro""".split()


def header(i):
    return {"stamp": {"sec": 1_700_000_000, "nanosec": i * STEP_NS}, "frame_id": "device_base"}


def xyz(x, y, z):
    return {"x": x, "y": y, "z": z}


def pose(i):
    orientation = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
    return {"header": header(i), "pose": {"position": xyz(i * 1e-3, -1 / 3, 1e-300), "orientation": orientation}}


def force(i):
    return {"header": header(i), "wrench": {"force": xyz(0.0, 0.0, i * 0.01), "torque": xyz(0.0, 0.0, 0.0)}}


def state(i):
    return {
        "header": header(i),
        "mode": i % 3,
        "saturated": i % 2 == 0,
        "clutched": i % 5 == 0,
        "face": i,
        "barycentric": [0.25, 0.25, 0.5],
        "probe": xyz(1.0, 2.0, 3.0),
        "proxy": xyz(4.0, 5.0, 6.0),
        "normal": xyz(0.0, 0.0, 1.0),
        "depth": i * 1e-5,
        "force": i * 0.01,
        "stiffness": 250.0,
    }


def gripper(i):
    return {"header": header(i), "name": ["gripper"], "position": [i * 0.1], "velocity": [], "effort": [i * 0.1]}


def surface(i):
    vertex = list(range(i % 50))
    displacement = [number for v in vertex for number in (v * 0.5, -1.0, 0.25)]
    return {"header": header(i), "topology_version": 0xDEADBEEF, "vertex": vertex, "displacement": displacement}


def expected():
    """Every message in the order of storage: topic, log time, values."""
    for i in range(COUNT):
        time = START_NS + i * STEP_NS
        yield "/measured_cp", time, pose(i)
        yield "/servo_cf", time, force(i)
        yield "/contact_state", time, state(i)
        if i % 10 == 0:
            yield "/gripper/measured_js", time, gripper(i)
            yield "/grasp", time, {"data": i % 20 == 0}
            yield "/surface_displacement", time, surface(i)
        if i % 100 == 0:
            yield "/clutch", time, {"header": header(i), "axes": [0.5], "buttons": [1 if i % 200 == 0 else 0]}


def plain(value):
    """A message of either library as dictionaries, lists and numbers, so that == compares every field exactly."""
    if is_dataclass(value):
        # rosbags makes fields of constants, which ROS writes in capitals, and of the type's name.
        names = [field.name for field in fields(value) if not field.name.isupper() and field.name != "__msgtype__"]
        return {name: plain(getattr(value, name)) for name in names}
    if hasattr(value, "__slots__"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, numpy.generic):
        return value.item()
    return value


def by_time_and_topic(messages):
    """Sorted as both libraries can be compared: they keep the order of times, but not that of equal ones."""
    return sorted(messages, key=lambda message: (message[1], message[0]))


def load_yaml(text):
    return YAML(typ="safe").load(text)


def test_rosbags_reads_every_message_with_the_same_values(fixture_recording):
    with AnyReader([fixture_recording]) as reader:
        read = [
            (connection.topic, time, plain(reader.deserialize(data, connection.msgtype)))
            for connection, time, data in reader.messages()
        ]
    assert by_time_and_topic(read) == by_time_and_topic(expected())


def test_rosbags_finds_types_hashes_counts_and_qos(fixture_recording):
    # AnyReader itself compares each type's hash with the one it computes from the definition in the file.
    with AnyReader([fixture_recording]) as reader:
        assert reader.message_count == sum(1 for _ in expected())
        assert (reader.start_time, reader.duration) == (START_NS, (COUNT - 1) * STEP_NS + 1)
        connections = {connection.topic: connection for connection in reader.connections}
        for connection in connections.values():
            assert connection.digest.startswith("RIHS01_"), connection
            assert connection.msgcount == sum(1 for topic, _, _ in expected() if topic == connection.topic)
            [qos] = connection.ext.offered_qos_profiles
            assert qos.reliability == QosReliability.RELIABLE
        [clutch] = connections["/clutch"].ext.offered_qos_profiles
        assert clutch.durability == QosDurability.TRANSIENT_LOCAL


def test_mcap_ros2_support_reads_every_message_with_the_same_values(fixture_recording):
    with open(fixture_recording / "fixture_0.mcap", "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        read = [
            (channel.topic, message.log_time, plain(decoded))
            for _, channel, message, decoded in reader.iter_decoded_messages()
        ]
    assert by_time_and_topic(read) == by_time_and_topic(expected())


def test_the_file_says_what_rosbag2_says(fixture_recording):
    with open(fixture_recording / "fixture_0.mcap", "rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros2"
        [metadata] = list(reader.iter_metadata())
        summary = reader.get_summary()
    in_file = load_yaml(metadata.metadata["serialized_metadata"])
    beside_it = load_yaml((fixture_recording / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert metadata.name == "rosbag2"
    assert in_file == beside_it
    assert list(beside_it) == METADATA_KEYS
    assert beside_it["version"] == 9 and beside_it["storage_identifier"] == "mcap"
    for channel in summary.channels.values():
        assert channel.message_encoding == "cdr"
        assert set(channel.metadata) == {"offered_qos_profiles", "topic_type_hash"}
        [qos] = load_yaml(channel.metadata["offered_qos_profiles"])
        assert qos["reliability"] == "reliable" and qos["deadline"] == {"sec": 9223372036, "nsec": 854775807}
    for schema in summary.schemas.values():
        assert schema.encoding == "ros2msg"
    pose_text = next(s.data for s in summary.schemas.values() if s.name == "geometry_msgs/msg/PoseStamped").decode()
    parts = pose_text.split("=" * 80)
    assert sorted(part.split()[1] for part in parts[1:]) == [
        "builtin_interfaces/Time",
        "geometry_msgs/Point",
        "geometry_msgs/Pose",
        "geometry_msgs/Quaternion",
        "std_msgs/Header",
    ]


def test_our_reader_reads_what_our_writer_wrote(fixture_recording, printed):
    topics, messages = printed(fixture_recording)
    # Ours also keeps the order of equal times.
    assert messages == list(expected())
    assert topics["/clutch"]["qos"][0]["durability"] == "transient_local"


FOREVER = QosTime(9223372036, 854775807)
RELIABLE = Qos(
    QosHistory.KEEP_LAST, 10, QosReliability.RELIABLE, QosDurability.VOLATILE, FOREVER, FOREVER,
    QosLiveliness.AUTOMATIC, FOREVER, False,
)  # fmt: skip
LATCHED = RELIABLE._replace(durability=QosDurability.TRANSIENT_LOCAL)


@pytest.mark.parametrize("version", [8, 9])
def test_our_reader_reads_what_rosbags_wrote(tmp_path, printed, version):
    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    Time, Header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    Pose, Point = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/Point"]
    Quaternion, PoseStamped = types["geometry_msgs/msg/Quaternion"], types["geometry_msgs/msg/PoseStamped"]
    Joy, String = types["sensor_msgs/msg/Joy"], types["std_msgs/msg/String"]
    path = tmp_path / "by_rosbags"
    wrote = []
    with Writer(path, version=version, storage_plugin=StoragePlugin.MCAP) as writer:
        def add(topic, kind, qos):
            return writer.add_connection(topic, kind, typestore=store, offered_qos_profiles=[qos])

        def put(connection, time, message, values):
            writer.write(connection, time, store.serialize_cdr(message, connection.msgtype))
            wrote.append((connection.topic, time, values))

        poses = add("/measured_cp", PoseStamped.__msgtype__, RELIABLE)
        buttons = add("/clutch", Joy.__msgtype__, LATCHED)
        unknown = add("/words", String.__msgtype__, RELIABLE)
        # More than one chunk of 1 MiB; two messages of equal time, stored in an order that no sorting by name gives.
        for i in range(12_000):
            time = START_NS + i * STEP_NS
            stamp = Header(stamp=Time(sec=1_700_000_000, nanosec=i), frame_id="device_base")
            position, orientation = Point(i * 1e-3, -1 / 3, 1e-300), Quaternion(0.0, 0.0, 0.0, 1.0)
            values = pose(i) | {"header": {"stamp": {"sec": 1_700_000_000, "nanosec": i}, "frame_id": "device_base"}}
            put(poses, time, PoseStamped(stamp, Pose(position, orientation)), values)
            if i % 100 == 0:
                joy = Joy(stamp, numpy.array([0.5], numpy.float32), numpy.array([i], numpy.int32))
                put(buttons, time, joy, {"header": values["header"], "axes": [0.5], "buttons": [i]})
                put(unknown, time, String(data=f"word {i}"), None)
    topics, messages = printed(path)
    assert messages == wrote
    assert {name: (topic["type"], topic["count"]) for name, topic in topics.items()} == {
        "/measured_cp": ("geometry_msgs/msg/PoseStamped", 12_000),
        "/clutch": ("sensor_msgs/msg/Joy", 120),
        "/words": ("std_msgs/msg/String", 120),
    }
    assert topics["/clutch"]["qos"][0]["durability"] == "transient_local"
    assert topics["/measured_cp"]["qos"][0]["reliability"] == "reliable"
    assert topics["/measured_cp"]["hash"].startswith("RIHS01_")
    assert "geometry_msgs/Quaternion" in topics["/measured_cp"]["definition"]
