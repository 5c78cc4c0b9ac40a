"""SQLite recordings that `rosbags` wrote, plain and compressed, come out of our reader message for message."""

import numpy
import pytest
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from test_roundtrip import LATCHED, RELIABLE, START_NS, STEP_NS, pose

COUNT = 12_000


@pytest.mark.parametrize("version", [8, 9])
@pytest.mark.parametrize("mode", [CompressionMode.NONE, CompressionMode.MESSAGE, CompressionMode.FILE])
def test_our_reader_reads_a_database_that_rosbags_wrote(tmp_path, printed, version, mode):
    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    Time, Header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    Pose, Point = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/Point"]
    Quaternion, PoseStamped = types["geometry_msgs/msg/Quaternion"], types["geometry_msgs/msg/PoseStamped"]
    Joy = types["sensor_msgs/msg/Joy"]
    path = tmp_path / "by_rosbags"
    wrote = []
    writer = Writer(path, version=version, storage_plugin=StoragePlugin.SQLITE3)
    if mode != CompressionMode.NONE:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:

        def add(topic, kind, qos):
            return writer.add_connection(topic, kind, typestore=store, offered_qos_profiles=[qos])

        def put(connection, time, message, values):
            writer.write(connection, time, store.serialize_cdr(message, connection.msgtype))
            wrote.append((connection.topic, time, values))

        poses = add("/measured_cp", PoseStamped.__msgtype__, RELIABLE)
        buttons = add("/clutch", Joy.__msgtype__, LATCHED)
        for i in range(COUNT):
            time = START_NS + i * STEP_NS
            stamp = Header(stamp=Time(sec=1_700_000_000, nanosec=i), frame_id="device_base")
            position, orientation = Point(i * 1e-3, -1 / 3, 1e-300), Quaternion(0.0, 0.0, 0.0, 1.0)
            values = pose(i) | {"header": {"stamp": {"sec": 1_700_000_000, "nanosec": i}, "frame_id": "device_base"}}
            if i % 100 == 0:
                # Of equal time and stored in front, an order that no sorting by name or topic gives.
                joy = Joy(stamp, numpy.array([0.5], numpy.float32), numpy.array([i], numpy.int32))
                put(buttons, time, joy, {"header": values["header"], "axes": [0.5], "buttons": [i]})
            put(poses, time, PoseStamped(stamp, Pose(position, orientation)), values)
    files = sorted(file.name for file in path.iterdir())
    topics, messages = printed(path)
    assert messages == wrote
    assert {name: (topic["type"], topic["count"]) for name, topic in topics.items()} == {
        "/measured_cp": ("geometry_msgs/msg/PoseStamped", COUNT),
        "/clutch": ("sensor_msgs/msg/Joy", COUNT // 100),
    }
    assert topics["/clutch"]["qos"][0]["durability"] == "transient_local"
    assert topics["/measured_cp"]["qos"][0]["reliability"] == "reliable"
    assert topics["/measured_cp"]["hash"].startswith("RIHS01_")
    assert "geometry_msgs/Quaternion" in topics["/measured_cp"]["definition"]
    assert sorted(file.name for file in path.iterdir()) == files
