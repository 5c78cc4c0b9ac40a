"""The other end of the nodes under test: starts real executables, plays devices, reads answers."""

import json
import math
import os
import signal
import subprocess
import time
from pathlib import Path

import rclpy
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rhombus_haptics_msgs.msg import ContactLaw, ContactState
from sensor_msgs.msg import JointState, Joy
from std_msgs.msg import Bool

PROGRAMS = Path(__file__).resolve().parents[2] / "target" / "release"
TIMEOUT_S = 20.0
MS = 1_000_000


def reliable(depth):
    return QoSProfile(depth=depth, reliability=ReliabilityPolicy.RELIABLE)


def latched(depth):
    return QoSProfile(
        depth=depth, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
    )


# One chain of MODEL golden values; a soft block of 0.10 x 0.08 x 0.05 m.
SCENE = {
    "body.mesh": "block",
    "chains.rod_length": [0.01],
    "chains.angle": [0.5235987755982988],
    "chains.ratio": [0.8],
    "chains.units": [12],
    "chains.normal_stiffness": [500.0],
    "chains.tangential_stiffness": [100.0],
    "chains.tangential_growth": [10.0],
}
# A hand that moves little, heavy and stiff, on a device that Python can follow: what the motors get is what is commanded, but
# for the ramp of the first half second. The passivity controller is off: a constant force gives a moving hand energy, which
# is just what that controller is there to keep from it.
CALM = {
    **SCENE,
    "device.rate": 200.0,
    "device.pose_rate": 100.0,
    "simulated.mass": 2.0,
    "simulated.stiffness": 4000.0,
    "simulated.damping": 60.0,
    "simulated.depth": 0.0005,
    "simulated.pull": 0.0005,
    "simulated.slide": 0.0005,
    "simulated.period": 60.0,
    "safety.engage_ramp": 0.5,
    "safety.passivity": False,
    "unsafe.parameters": ["safety.passivity"],
}
PROBE_RADIUS_M = 0.005
BLOCK_TOP_M = 0.05


def yaml_of(values):
    """A parameter file for every node."""
    lines = ["/**:", "  ros__parameters:"]
    lines += [f"    {name}: {json.dumps(value)}" for name, value in values.items()]
    return "\n".join(lines) + "\n"


def isolate():
    """A domain of its own: whatever else runs on this machine is not heard. Before rclpy.init.

    Of two groups of tests that run at once, the one that is named has the upper half of the domains."""
    first = 51 if "RHOMBUS_SECOND_GROUP" in os.environ else 1
    os.environ["ROS_DOMAIN_ID"] = str(first + os.getpid() % 50)
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"


class Program:
    """One node executable as a process, with its stderr in a file."""

    def __init__(self, folder, executable, values, namespace="", arguments=(), environment=None):
        folder.mkdir(parents=True, exist_ok=True)
        label = f"{namespace.strip('/').replace('/', '_') or 'root'}_{executable}"
        self.file = folder / f"{label}.yaml"
        self.file.write_text(yaml_of(values) if isinstance(values, dict) else values)
        self.log_path = folder / f"{label}.log"
        command = [str(PROGRAMS / executable), "--ros-args", "--params-file", str(self.file)]
        command += ["-r", f"__ns:=/{namespace.strip('/')}", *arguments]
        if executable == "visualization" and "viewer." not in self.file.read_text():
            # The default port may be somebody else's.
            command += ["-p", "viewer.port:=0"]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.DEVNULL,
            stderr=self.log_path.open("wb"),
            env={**os.environ, **(environment or {})},
        )

    def log(self):
        return self.log_path.read_text(errors="replace")

    def wait_ready(self):
        end = time.monotonic() + TIMEOUT_S
        while "ready:" not in self.log():
            assert self.process.poll() is None, self.log()
            assert time.monotonic() < end, f"not ready within {TIMEOUT_S:.0f} s\n{self.log()}"
            time.sleep(0.01)
        return self

    def interrupt(self, number=signal.SIGINT):
        """Send a signal; the exit code and the seconds until it came."""
        start = time.monotonic()
        self.process.send_signal(number)
        return self.process.wait(TIMEOUT_S), time.monotonic() - start

    def closing_report(self):
        marker = "closing report: "
        lines = [line for line in self.log().splitlines() if marker in line]
        assert len(lines) == 1, self.log()
        return json.loads(lines[0].split(marker, 1)[1])

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


class Peer:
    """One rclpy node that plays devices and viewers."""

    def __init__(self, namespace=""):
        self.node = rclpy.create_node("peer", namespace=namespace)
        self.publishers = {}
        self.statuses = {}
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self.hear_diagnostics, 100)

    def hear_diagnostics(self, message):
        for status in message.status:
            values = {entry.key: entry.value for entry in status.values}
            level = status.level[0] if isinstance(status.level, bytes) else status.level
            self.statuses.setdefault(status.name, []).append((level, status.message, values))

    def wait_for(self, condition, what, timeout_s=TIMEOUT_S):
        end = time.monotonic() + timeout_s
        while not condition():
            assert time.monotonic() < end, f"not within {timeout_s:.0f} s: {what}"
            rclpy.spin_once(self.node, timeout_sec=0.02)

    def spin(self, seconds):
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            rclpy.spin_once(self.node, timeout_sec=left)

    def new_status(self, name):
        """Level, summary and values of the second status from now: the first may have been under way."""
        before = len(self.statuses.get(name, []))
        self.wait_for(lambda: len(self.statuses.get(name, [])) >= before + 2, f"diagnostics of {name}")
        return self.statuses[name][-1]

    def publish(self, message, topic, qos):
        if topic not in self.publishers:
            publisher = self.node.create_publisher(type(message), topic, qos)
            self.publishers[topic] = publisher
            self.wait_for(lambda: publisher.get_subscription_count() > 0, f"a reader of {topic}")
        self.publishers[topic].publish(message)

    def call(self, service_type, name, request):
        client = self.node.create_client(service_type, name)
        self.wait_for(client.service_is_ready, f"service {name}")
        future = client.call_async(request)
        self.wait_for(future.done, f"answer of {name}")
        self.node.destroy_client(client)
        return future.result()

    def heard(self, message_type, topic, qos):
        """A list that grows with every message."""
        messages = []
        self.node.create_subscription(message_type, topic, messages.append, qos)
        return messages

    def nodes(self):
        return {
            f"{namespace.rstrip('/')}/{name}" for name, namespace in self.node.get_node_names_and_namespaces()
        }

    def close(self):
        self.node.destroy_node()


class Device:
    """A device of the deformation node: sends poses, hears what comes back."""

    def __init__(self, peer, prefix="", frame="device_base", start_ns=1_000_000_000_000):
        self.peer, self.prefix, self.frame = peer, prefix, frame
        self.now_ns = start_ns
        self.forces = peer.heard(WrenchStamped, f"{prefix}servo_cf", reliable(1000))
        self.laws = peer.heard(ContactLaw, f"{prefix}contact_law", reliable(1000))
        self.states = peer.heard(ContactState, f"{prefix}contact_state", reliable(1000))
        # The node's writers must know these readers before the first answer.
        for topic in ("servo_cf", "contact_law", "contact_state"):
            full = peer.node.resolve_topic_name(f"{prefix}{topic}")
            peer.wait_for(lambda full=full: peer.node.count_publishers(full) > 0, f"a publisher of {full}")
        peer.spin(0.3)

    def send(self, position, orientation=(0.0, 0.0, 0.0, 1.0), stamp_ns=None, frame=None):
        """Send one pose, 1 ms after the last one unless told otherwise; its stamp."""
        if stamp_ns is None:
            self.now_ns += MS
            stamp_ns = self.now_ns
        pose = PoseStamped()
        pose.header.stamp = Time(sec=stamp_ns // 1_000_000_000, nanosec=stamp_ns % 1_000_000_000)
        pose.header.frame_id = self.frame if frame is None else frame
        p, q = pose.pose.position, pose.pose.orientation
        p.x, p.y, p.z = (float(x) for x in position)
        q.x, q.y, q.z, q.w = (float(x) for x in orientation)
        self.peer.publish(pose, f"{self.prefix}measured_cp", reliable(1000))
        return stamp_ns

    def ask(self, position, **pose):
        """Send one pose and wait for its answer: force, contact law, contact state."""
        counts = [len(self.forces), len(self.laws), len(self.states)]
        stamp_ns = self.send(position, **pose)
        heard = (self.forces, self.laws, self.states)
        complete = lambda: all(len(now) > before for now, before in zip(heard, counts))
        self.peer.wait_for(complete, f"the answer to the pose of {stamp_ns} ns")
        for messages, before in zip(heard, counts):
            assert len(messages) == before + 1, "one message for each pose"
            assert stamp_of(messages[-1]) == stamp_ns, "the pose's stamp"
        return self.forces[-1], self.laws[-1], self.states[-1]

    def grasp(self, hold):
        self.peer.publish(Bool(data=hold), f"{self.prefix}grasp", reliable(10))

    def gripper(self, *positions):
        self.peer.publish(JointState(position=list(positions)), f"{self.prefix}gripper/measured_js", reliable(100))

    def clutch(self, *buttons):
        self.peer.publish(Joy(buttons=list(buttons)), f"{self.prefix}clutch", latched(10))

    def until(self, position, condition, what):
        """Send the same pose until an answer satisfies the condition; that answer."""
        end = time.monotonic() + TIMEOUT_S
        while True:
            answer = self.ask(position)
            if condition(*answer):
                return answer
            assert time.monotonic() < end, f"not within {TIMEOUT_S:.0f} s: {what}"
            time.sleep(0.005)


class Handle:
    """Where a device's handle is and what its motors give, as messages that were heard so far."""

    def __init__(self, peer, prefix=""):
        self.poses = peer.heard(PoseStamped, f"{prefix}measured_cp", reliable(1000))
        self.forces = peer.heard(WrenchStamped, f"{prefix}measured_cf", reliable(1000))


class Client:
    """A client that commands wrenches on one topic, 200 a second."""

    def __init__(self, peer, topic="servo_cf"):
        self.peer, self.topic = peer, topic
        self.last_ns = 0

    def send(self, force, frame="", torque=(0.0, 0.0, 0.0), stamp_ns=None):
        message = WrenchStamped()
        message.header.frame_id = frame
        if stamp_ns is None:
            message.header.stamp = self.peer.node.get_clock().now().to_msg()
        else:
            message.header.stamp = Time(sec=stamp_ns // 1_000_000_000, nanosec=stamp_ns % 1_000_000_000)
        self.last_ns = stamp_of(message)
        f, t = message.wrench.force, message.wrench.torque
        f.x, f.y, f.z = (float(x) for x in force)
        t.x, t.y, t.z = (float(x) for x in torque)
        self.peer.publish(message, self.topic, reliable(1000))

    def until(self, force, condition, what, frame="", timeout_s=TIMEOUT_S, **options):
        """Command the same force until a condition holds."""

        def tried():
            self.send(force, frame, **options)
            self.peer.spin(0.005)
            return condition()

        self.peer.wait_for(tried, what, timeout_s)

    def stream(self, force, seconds, frame="", **options):
        """Command the same force for a while."""
        end = time.monotonic() + seconds
        self.until(force, lambda: time.monotonic() >= end, "the end of the stream", frame, **options)

    def engage(self, handle):
        """Command nothing until the driver lets forces begin, then a small force until its ramp is over."""
        self.stream((0.0, 0.0, 0.0), 0.3)
        self.until((0.0, 0.0, 0.0), lambda: handle.forces, "a measured force")
        small = 0.15
        self.until((small, 0.0, 0.0), lambda: size(handle.forces[-1]) > 0.999 * small, "the end of the ramp")


def stamp_of(message):
    return message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec


def size(message):
    return math.hypot(*force_of(message))


def vector(v):
    return (v.x, v.y, v.z)


def force_of(message):
    return vector(message.wrench.force)


def pressed(depth_m, x=0.011, y=0.007):
    """Where the probe's centre is when it presses the block's top by `depth_m`."""
    return (x, y, BLOCK_TOP_M + PROBE_RADIUS_M - depth_m)


def library_force_n(parameters, depth_m):
    """What the command line says of the same parameters: force on the hand, pushing out."""
    command = [str(PROGRAMS / "rhombus"), "evaluate", str(parameters), f"--depth={depth_m!r}", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["force_n"]


def turned(q, v):
    """A vector rotated by a quaternion (x, y, z, w)."""
    u, w = q[:3], q[3]
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    t = [2 * c for c in cross(u, v)]
    return tuple(v[i] + w * t[i] + cross(u, t)[i] for i in range(3))


def about_z(angle_rad):
    return (0.0, 0.0, math.sin(angle_rad / 2), math.cos(angle_rad / 2))


def about_x(angle_rad):
    return (math.sin(angle_rad / 2), 0.0, 0.0, math.cos(angle_rad / 2))
