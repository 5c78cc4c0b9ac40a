"""Publishes numbered messages at 1 kHz on the topics of a session, and surfaces at 60 Hz: `COUNT [TOPIC ...]`.

Waits for a reader of each topic, so that every message counts. The number stands in `header.stamp.nanosec`. Messages are
serialized once and their number is written into the bytes: Python would not keep up otherwise.
"""

import json
import struct
import sys
import time

import numpy
import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped, WrenchStamped
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from rhombus_haptics_msgs.msg import ContactState, SurfaceDisplacement

PERIOD_S = 1e-3
TOPICS = {
    "measured_cp": PoseStamped,
    "measured_cv": TwistStamped,
    "measured_cf": WrenchStamped,
    "servo_cf": WrenchStamped,
    "contact_state": ContactState,
    "contact_law_copy": PoseStamped,
    "surface_displacement": SurfaceDisplacement,
}
# Behind the four bytes of the CDR header and the seconds.
NUMBER_AT = 8


def example(kind):
    message = kind()
    message.header.frame_id = "device_base"
    if kind is SurfaceDisplacement:
        message.vertex = numpy.arange(3000, dtype=numpy.uint32)
        message.displacement = numpy.zeros(9000, dtype=numpy.float32)
    return bytearray(serialize_message(message))


def main():
    count = int(sys.argv[1])
    names = sys.argv[2:] or list(TOPICS)
    rclpy.init(args=[])
    node = rclpy.create_node("numbered_publisher")
    publishers = {name: node.create_publisher(TOPICS[name], name, QoSProfile(depth=1000)) for name in names}
    while not all(publisher.get_subscription_count() for publisher in publishers.values()):
        rclpy.spin_once(node, timeout_sec=0.02)
    examples = {name: example(TOPICS[name]) for name in names}
    sent = dict.fromkeys(names, 0)
    start = time.monotonic()
    for number in range(count):
        while (left := start + number * PERIOD_S - time.monotonic()) > 0:
            time.sleep(left)
        for name, publisher in publishers.items():
            # 60 Hz: where a sixtieth of a second begins.
            if name == "surface_displacement" and number * 60 // 1000 == (number - 1) * 60 // 1000:
                continue
            struct.pack_into("<I", examples[name], NUMBER_AT, sent[name])
            publisher.publish(bytes(examples[name]))
            sent[name] += 1
    print(json.dumps({"sent": sent, "seconds": time.monotonic() - start}), flush=True)
    # Reliable publishers send again what a reader missed, for as long as they live.
    sys.stdin.readline()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
