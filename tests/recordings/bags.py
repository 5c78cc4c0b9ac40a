"""Recordings for tests, written by `rosbags` from messages of rclpy."""

from rclpy.serialization import serialize_message
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

START_NS = 1_700_000_000_000_000_000
MS = 1_000_000
FOREVER = QosTime(9223372036, 854775807)
RELIABLE = Qos(
    QosHistory.KEEP_LAST, 1000, QosReliability.RELIABLE, QosDurability.VOLATILE, FOREVER, FOREVER,
    QosLiveliness.AUTOMATIC, FOREVER, False,
)  # fmt: skip
LATCHED = RELIABLE._replace(durability=QosDurability.TRANSIENT_LOCAL)


def type_name(kind):
    """`geometry_msgs/msg/PoseStamped` of rclpy's class."""
    return f"{kind.__module__.split('.')[0]}/msg/{kind.__name__}"


def write(path, rows, latched=(), store=None, storage=StoragePlugin.MCAP):
    """Rows of topic, milliseconds since the start, and a message, or the bytes of one and its type."""
    store = store or get_typestore(Stores.ROS2_JAZZY)
    connections = {}
    with Writer(path, version=9, storage_plugin=storage) as writer:
        for topic, at_ms, message in rows:
            kind, data = message if isinstance(message, tuple) else (type_name(type(message)), serialize_message(message))
            if topic not in connections:
                qos = LATCHED if topic in latched else RELIABLE
                connections[topic] = writer.add_connection(
                    topic, kind, typestore=store, serialization_format="cdr", offered_qos_profiles=[qos]
                )
            writer.write(connections[topic], START_NS + round(at_ms * MS), bytes(data))
    return path


def stamp(message, at_ms):
    """Sets the stamp to that of the log time; the message."""
    ns = START_NS + round(at_ms * MS)
    message.header.stamp.sec, message.header.stamp.nanosec = ns // 1_000_000_000, ns % 1_000_000_000
    return message
