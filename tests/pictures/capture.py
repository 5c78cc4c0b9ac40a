"""The moment worth a picture: the markers, the rest mesh and the contact when the probe is deepest (or pulls most).

From a live session (rclpy), which may be a replay, or from a recording that holds `body_mesh`, `contact_state`,
`/tf_static` and also `markers`, which a recorder leaves out unless `recording.topics` names them.
"""

import time
from collections import deque
from dataclasses import dataclass, field

import numpy


@dataclass
class Moment:
    """What the topics said at one time."""

    markers: dict = field(default_factory=dict)
    depth_m: float = 0.0
    force_n: float = 0.0


class Recorder:
    """Hears messages one by one and keeps the best moment."""

    def __init__(self, pull):
        self.sign = -1.0 if pull else 1.0
        self.markers = {}
        self.contacts = deque(maxlen=1000)
        self.mesh = None
        self.transforms = {}
        self.best = None

    def hear_markers(self, message):
        for marker in message.markers:
            key = (marker.ns, marker.id)
            if marker.action == 2:
                self.markers.pop(key, None)
            else:
                self.markers[key] = marker
        shown = {name for name, _ in self.markers}
        if not {"body", "chains", "force", "proxy"} <= shown:
            return
        # Markers arrive later than contacts; the contact that they show is the one that moves the contact point as far.
        proxy, displaced = self.markers["proxy", 0].pose.position, self.markers["chains", 2].points[0]
        moved = numpy.array([displaced.x - proxy.x, displaced.y - proxy.y, displaced.z - proxy.z])
        touching = [each for each in self.contacts if each.mode != 0]
        if not touching:
            return
        normal = touching[-1].normal
        depth_m = -moved @ [normal.x, normal.y, normal.z]
        contact = min(touching, key=lambda each: abs(each.depth - depth_m))
        if self.best is None or self.sign * depth_m > self.sign * self.best.depth_m:
            self.best = Moment(dict(self.markers), depth_m, contact.force)

    def hear_contact(self, message):
        self.contacts.append(message)

    def hear_mesh(self, message):
        self.mesh = message

    def hear_transforms(self, message):
        for each in message.transforms:
            parent_from_child = matrix(each.transform.translation, each.transform.rotation)
            self.transforms[each.child_frame_id] = (each.header.frame_id, parent_from_child)

    def root_from(self, frame):
        """4x4 transform from a frame to the root of its tree."""
        root_from_frame = numpy.eye(4)
        while frame in self.transforms:
            frame, parent_from_child = self.transforms[frame]
            root_from_frame = parent_from_child @ root_from_frame
        return root_from_frame


def matrix(translation, rotation):
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    result = numpy.eye(4)
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    result[:3, 3] = translation.x, translation.y, translation.z
    return result


def live(namespace, seconds, pull):
    """Listen to a running session."""
    import rclpy
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from rhombus_haptics_msgs.msg import ContactState
    from shape_msgs.msg import Mesh
    from tf2_msgs.msg import TFMessage
    from visualization_msgs.msg import MarkerArray

    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    recorder = Recorder(pull)
    rclpy.init(args=[])
    node = rclpy.create_node("picture", namespace=namespace)
    node.create_subscription(Mesh, "body_mesh", recorder.hear_mesh, latched)
    node.create_subscription(TFMessage, "/tf_static", recorder.hear_transforms, latched)
    node.create_subscription(ContactState, "contact_state", recorder.hear_contact, 100)
    node.create_subscription(MarkerArray, "markers", recorder.hear_markers, 10)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.1)
    rclpy.shutdown()
    return recorder


def recording(path, namespace, pull):
    """Read a rosbag2 recording."""
    from rosbags.highlevel import AnyReader

    recorder = Recorder(pull)
    prefix = f"/{namespace.strip('/')}" if namespace.strip("/") else ""
    hear = {
        f"{prefix}/body_mesh": recorder.hear_mesh,
        f"{prefix}/contact_state": recorder.hear_contact,
        f"{prefix}/markers": recorder.hear_markers,
        "/tf_static": recorder.hear_transforms,
    }
    with AnyReader([path]) as reader:
        connections = [each for each in reader.connections if each.topic in hear]
        for connection, _, data in reader.messages(connections):
            hear[connection.topic](reader.deserialize(data, connection.msgtype))
    return recorder
