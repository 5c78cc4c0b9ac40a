"""Lockstep over DDS: the next pose is sent when the force for the last one is back, whatever the load and the model."""

import hashlib
import json
import math
import os
import random
import subprocess
import sys
import threading
import time
from pathlib import Path

import bags
import peer
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, TransformStamped, WrenchStamped
from rosgraph_msgs.msg import Clock
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosbags.highlevel import AnyReader
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, UInt64
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

CLOCK_QOS = QoSProfile(depth=10_000, reliability=ReliabilityPolicy.BEST_EFFORT)
COUNT = 1500
REPOSITORY = Path(__file__).resolve().parents[2]
# Recording, parameters, digest of the model's answers.
COMMITTED = [
    line.split() for line in (REPOSITORY / "tests/bags/sha256.txt").read_text().splitlines() if not line.startswith("#")
]


def pose(at_ms, position, frame="device_base"):
    message = bags.stamp(PoseStamped(), at_ms)
    message.header.frame_id = frame
    p = message.pose.position
    p.x, p.y, p.z = position
    message.pose.orientation.w = 1.0
    return message


def gripper(at_ms, angle):
    return bags.stamp(JointState(name=["gripper"], position=[angle], velocity=[0.0], effort=[0.0]), at_ms)


def pull(devices=("",), count=COUNT):
    """Presses, grasps and pulls with each device at 1 kHz; buttons and transforms between poses, some at the same time."""
    for i in range(count):
        for number, device in enumerate(devices):
            at = 0.01 + 0.012 * number
            position = peer.pressed(0.003 * math.sin(i / 150.0), at + 0.004 * math.sin(i / 90.0), 0.007)
            if i % 50 == 0:
                yield f"/{device}gripper/measured_js", i, gripper(i, 0.1 if (i // 250) % 2 else 0.8)
            if i % 200 == 100:
                yield f"/{device}grasp", i, Bool(data=(i // 200) % 2 == 0)
            yield f"/{device}measured_cp", i, pose(i, position, f"{device}device_base")
        if i % 100 == 50:
            move = bags.stamp(TransformStamped(), i)
            move.header.frame_id, move.child_frame_id = "scene", "body"
            move.transform.translation.z = 1e-4 * math.sin(i / 100.0)
            move.transform.rotation.w = 1.0
            yield "/tf", i, TFMessage(transforms=[move])


def replay(folder, path, arguments=(), **values):
    values = {"bag_replay.mode": "play", "replay.path": str(path), "replay.lockstep": True} | {
        name.replace("__", "."): value for name, value in values.items()
    }
    return peer.Program(folder, "bag_replay", values, arguments=arguments)


def model(folder, **values):
    values = {**peer.SCENE, "replay.lockstep": True} | {name.replace("__", "."): value for name, value in values.items()}
    return peer.Program(folder, "deformation", values).wait_ready()


def record_answers(folder, devices=("",)):
    """A recorder of what the model says, which writes to folder / "answers"."""
    topics = [f"{device}{name}" for device in devices for name in ("servo_cf", "contact_state", "contact_law")]
    values = {"recording.directory": str(folder), "recording.name": "answers"}
    values["recording.topics"] = [*topics, "surface_displacement"]
    return peer.Program(folder / "recorder", "bag_replay", values).wait_ready()


def wait_for_publishers(remote):
    """Until the recorder has found who publishes what it records; what is sent before nobody gets."""

    remote.statuses.pop("/bag_replay: recording", None)

    def found():
        said = remote.statuses.get("/bag_replay: recording")
        return said and said[-1][2]["topics_without_publisher"] == "0"

    remote.wait_for(found, "the recorder's publishers")
    remote.spin(0.5)


def forces_in(path, topic="/servo_cf"):
    with AnyReader([path]) as reader:
        connections = [connection for connection in reader.connections if connection.topic == topic]
        return [reader.deserialize(data, one.msgtype) for one, _, data in reader.messages(connections=connections)]


# Fast DDS repairs what was lost on the way with the writer's next heartbeat, every 3 s, and keeps what came after it back.
HEARTBEAT_S = 3.5


def ended(remote, program):
    remote.wait_for(lambda: program.process.poll() is not None, "the end of the replay", 3 * peer.TIMEOUT_S)
    remote.spin(HEARTBEAT_S if program.process.returncode == 0 else 0.3)
    return program.process.returncode


def digest(messages):
    """Of stamps and forces, bit for bit."""
    found = hashlib.sha256()
    for message in messages:
        force = [component.hex() for component in peer.force_of(message)]
        found.update(f"{peer.stamp_of(message)} {message.header.frame_id} {force}".encode())
    return found.hexdigest()


def assert_same_without_ros(poses, parameters, answers):
    """What the model said over DDS is, bit for bit, what the command line computes from the same recording; its report."""
    command = [peer.PROGRAMS / "rhombus", "replay", poses, "--params", parameters, "--expect", answers, "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)


class Busy:
    """Keeps every core busy twice over."""

    def __enter__(self):
        spin = [sys.executable, "-c", "while True: pass"]
        self.programs = [subprocess.Popen(spin) for _ in range(2 * os.cpu_count())]

    def __exit__(self, *_):
        for program in self.programs:
            program.kill()
            program.wait()


@pytest.mark.parametrize("devices", [("",), ("left/", "right/")])
def test_every_pose_is_answered_with_the_bits_of_the_replay_without_ros_idle_and_under_load(
    tmp_path, programs, remote, devices
):
    count = COUNT // len(devices)
    path = bags.write(tmp_path / "bag", pull(devices, count))
    names = {"devices": [device.rstrip("/") for device in devices], "device__scene_from_device": [0.0] * 6 + [1.0]}

    def run(folder):
        deformation = programs(model(folder, **names))
        recorder = programs(record_answers(folder, devices))
        wait_for_publishers(remote)
        program = programs(replay(folder, path, **names))
        assert ended(remote, program) == 0, program.log()
        assert recorder.interrupt()[0] == 0, recorder.log()
        assert deformation.interrupt()[0] == 0, deformation.log()
        report = program.closing_report()["lockstep"]
        assert report["poses"] == deformation.closing_report()["poses"] == count * len(devices)
        forces = {f"/{device}servo_cf": forces_in(folder / "answers", f"/{device}servo_cf") for device in devices}
        for heard in forces.values():
            stamps = [message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec for message in heard]
            assert stamps == [bags.START_NS + i * bags.MS for i in range(count)]
        assert max(peer.size(message) for heard in forces.values() for message in heard) > 0.05
        assert_same_without_ros(path, folder / "root_deformation.yaml", folder / "answers")
        return {topic: digest(heard) for topic, heard in forces.items()}

    idle = run(tmp_path / "idle")
    with Busy():
        loaded = run(tmp_path / "loaded")
    assert idle == loaded


@pytest.mark.parametrize(
    ("name", "parameters", "digest"), [row for row in COMMITTED if row[0] not in ("slide", "sensor_noise")]
)
def test_the_committed_recordings_are_answered_over_dds_with_the_committed_digest(
    tmp_path, programs, remote, name, parameters, digest
):
    path, parameters = REPOSITORY / "tests/bags" / name, REPOSITORY / parameters
    devices = ("left/", "right/") if name == "two_devices" else ("",)
    scene = ["--params-file", str(parameters)]
    deformation = programs(
        peer.Program(tmp_path, "deformation", {"replay.lockstep": True}, arguments=scene).wait_ready()
    )
    recorder = programs(record_answers(tmp_path, devices))
    wait_for_publishers(remote)
    program = programs(replay(tmp_path, path, scene))
    assert ended(remote, program) == 0, program.log()
    assert recorder.interrupt()[0] == 0, recorder.log()
    assert deformation.interrupt()[0] == 0, deformation.log()
    report = assert_same_without_ros(path, parameters, tmp_path / "answers")
    assert report["sha256"] == digest
    answered = sum(len(forces_in(tmp_path / "answers", f"/{device}servo_cf")) for device in devices)
    assert answered == report["poses"] == program.closing_report()["lockstep"]["poses"]


@pytest.mark.parametrize(("name", "parameters", "digest"), COMMITTED)
def test_fully_optimized_the_committed_recordings_are_replayed_to_the_committed_digest(name, parameters, digest):
    command = [peer.PROGRAMS / "rhombus", "replay", REPOSITORY / "tests/bags" / name]
    command += ["--params", REPOSITORY / parameters, "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert json.loads(done.stdout)["sha256"] == digest


def broken_poses():
    """A press in which poses are none, and stamps repeat, jump back and are zero."""
    for i in range(400):
        message = pose(i, peer.pressed(0.002 + 0.001 * math.sin(i / 40.0)))
        if i in (100, 101):
            message.pose.position.x = math.nan
        if i == 110:
            message.pose.orientation.w = 0.0
        if i == 120:
            message.pose.orientation.w = math.nan
        if i in (150, 151):
            bags.stamp(message, 149)
        if i == 200:
            bags.stamp(message, 100)
        if i in (0, 250, 251):
            message.header.stamp.sec = message.header.stamp.nanosec = 0
        yield "/measured_cp", i, message


def test_poses_that_are_none_and_stamps_that_do_not_grow_are_each_answered_as_without_ros(tmp_path, programs, remote):
    path = bags.write(tmp_path / "bag", broken_poses())
    deformation = programs(model(tmp_path))
    recorder = programs(record_answers(tmp_path))
    wait_for_publishers(remote)
    program = programs(replay(tmp_path, path))
    assert ended(remote, program) == 0, program.log()
    assert recorder.interrupt()[0] == 0, recorder.log()
    assert deformation.interrupt()[0] == 0, deformation.log()
    assert program.closing_report()["lockstep"]["poses"] == 400
    forces = forces_in(tmp_path / "answers")
    assert [peer.stamp_of(force) for force in forces] == [peer.stamp_of(sent) for _, _, sent in broken_poses()]
    for i in (100, 101, 110, 120, 200, 250):
        assert peer.force_of(forces[i]) == (0.0, 0.0, 0.0), i
    for i in (99, 130, 150, 151, 220, 300):
        assert peer.size(forces[i]) > 0.0, i
    report = assert_same_without_ros(path, tmp_path / "root_deformation.yaml", tmp_path / "answers")
    # Not finite, no rotation, stamps that go back.
    assert (report["poses"], report["rejected"]) == (400, [3, 1, 0, 2, 0])


def test_a_model_on_simulated_time_follows_the_clock_of_a_replay(tmp_path, programs, remote):
    path = bags.write(tmp_path / "bag", pull(count=1500))
    deformation = programs(model(tmp_path, use_sim_time=True))
    diagnostics = remote.heard(DiagnosticArray, "/diagnostics", peer.reliable(100))
    recorder = programs(record_answers(tmp_path))
    wait_for_publishers(remote)
    program = programs(replay(tmp_path, path, replay__clock=1000.0))
    assert ended(remote, program) == 0, program.log()
    # The node says once a second what it does, in the time of the recording.
    last_ns = bags.START_NS + 1499 * bags.MS
    said_ns = lambda: [
        peer.stamp_of(message) for message in diagnostics if message.status[0].name.startswith("/deformation")
    ]
    # /clock is best effort: its very last message may be lost.
    close_ns = last_ns - 100 * bags.MS
    remote.wait_for(lambda: any(stamp_ns > close_ns for stamp_ns in said_ns()), "diagnostics at the end of the recording")
    assert all(stamp_ns == 0 or bags.START_NS <= stamp_ns <= last_ns for stamp_ns in said_ns()), said_ns()
    assert recorder.interrupt()[0] == 0, recorder.log()
    assert deformation.interrupt()[0] == 0, deformation.log()
    assert_same_without_ros(path, tmp_path / "root_deformation.yaml", tmp_path / "answers")


class SlowModel:
    """Answers poses of a device late, from a thread of its own, and keeps the order of everything it heard."""

    def __init__(self, answers=lambda number: True, counts=True, delay=lambda: 0.0):
        self.node = rclpy.create_node("slow_model")
        self.events = []
        self.totals = {"buttons_heard": 0, "transforms_heard": 0}
        self.answers, self.counts, self.delay = answers, counts, delay
        self.force = self.node.create_publisher(WrenchStamped, "servo_cf", peer.reliable(1000))
        self.heard = {name: self.node.create_publisher(UInt64, name, peer.latched(1)) for name in self.totals}
        self.node.create_subscription(PoseStamped, "measured_cp", self.hear_pose, peer.reliable(1000))
        self.node.create_subscription(Bool, "grasp", lambda _: self.hear("buttons_heard"), peer.reliable(10))
        self.node.create_subscription(JointState, "gripper/measured_js", lambda _: self.hear("buttons_heard"), peer.reliable(1000))
        self.node.create_subscription(TFMessage, "/tf", lambda _: self.hear("transforms_heard"), peer.reliable(100))
        for name, publisher in self.heard.items():
            publisher.publish(UInt64(data=self.totals[name]))
        self.executor = rclpy.executors.SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.running = True
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while self.running:
            self.executor.spin_once(timeout_sec=0.05)

    def hear(self, name):
        time.sleep(self.delay())
        self.events.append(name)
        if self.counts:
            self.totals[name] += 1
            self.heard[name].publish(UInt64(data=self.totals[name]))

    def hear_pose(self, pose):
        number = (peer.stamp_of(pose) - bags.START_NS) // bags.MS
        self.events.append(number)
        time.sleep(self.delay())
        if self.answers(number):
            self.force.publish(WrenchStamped(header=pose.header))

    def close(self):
        self.running = False
        self.thread.join()
        self.executor.shutdown()
        self.node.destroy_node()


@pytest.fixture
def slow(ros):
    made = []

    def make(**options):
        made.append(SlowModel(**options))
        return made[-1]

    yield make
    for one in made:
        one.close()


def test_a_pose_waits_for_the_buttons_and_transforms_before_it_and_for_the_force_of_the_last_one(
    tmp_path, programs, remote, slow
):
    path = bags.write(tmp_path / "bag", pull(count=300))
    random.seed(7)
    one = slow(delay=lambda: random.choice((0.0, 0.0, 0.003)))
    clock = remote.heard(Clock, "/clock", CLOCK_QOS)
    program = programs(replay(tmp_path, path, replay__clock=1.0))
    assert ended(remote, program) == 0, program.log()
    words = {"/gripper/measured_js": "buttons_heard", "/grasp": "buttons_heard", "/tf": "transforms_heard"}
    recorded = [words.get(topic, at_ms) for topic, at_ms, _ in pull(count=300)]

    def between_poses(events):
        """What stands between two poses; topics are not in order with each other there."""
        groups = [[]]
        for event in events:
            if isinstance(event, int):
                groups += [[event], []]
            else:
                groups[-1].append(event)
        return [sorted(group, key=str) for group in groups]

    assert between_poses(one.events) == between_poses(recorded)
    # One before the first message and one with each pose.
    times = [message.clock.sec * 1_000_000_000 + message.clock.nanosec - bags.START_NS for message in clock]
    assert times == sorted(times) and len(times) >= 300 and set(times) == {i * bags.MS for i in range(300)}


def test_recorded_answers_are_left_to_the_model(tmp_path, programs, remote, slow):
    rows = []
    for i in range(20):
        rows += [("/measured_cp", i, pose(i, (0.0, 0.0, 1.0)))]
        rows += [("/servo_cf", i, bags.stamp(WrenchStamped(), i))]
    path = bags.write(tmp_path / "bag", rows)
    slow()
    forces = remote.heard(WrenchStamped, "servo_cf", peer.reliable(1000))
    program = programs(replay(tmp_path, path))
    assert ended(remote, program) == 0, program.log()
    assert program.closing_report()["topics"] == {"/measured_cp": 20}
    assert "/servo_cf is not played: in lockstep it comes from the model" in program.log()
    assert len(forces) == 20
    program = programs(replay(tmp_path / "asked", path, replay__topics=["measured_cp", "servo_cf"]))
    assert ended(remote, program) == 1
    [error] = [line for line in program.log().splitlines() if "ERROR" in line]
    assert "replay.topics" in error and "/servo_cf" in error


def test_pause_and_step_work_in_lockstep_too(tmp_path, programs, remote, slow):
    path = bags.write(tmp_path / "bag", pull(count=60))
    one = slow()
    program = programs(replay(tmp_path, path, replay__paused=True).wait_ready())
    for count in (1, 2):
        answer = remote.call(Trigger, "/bag_replay/step", Trigger.Request())
        assert answer.success, answer.message
        remote.wait_for(lambda count=count: [e for e in one.events if isinstance(e, int)] == list(range(count)), "a step")
    remote.spin(0.2)
    assert [event for event in one.events if isinstance(event, int)] == [0, 1]
    assert remote.call(Trigger, "/bag_replay/resume", Trigger.Request()).success
    assert ended(remote, program) == 0, program.log()
    assert program.closing_report()["lockstep"]["poses"] == 60


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"answers": lambda number: number != 7}, ["/servo_cf", "stamp 1700000000.007000000", "/measured_cp"]),
        ({"counts": False}, ["/buttons_heard is 0 and not 1", "replay.lockstep"]),
        (None, ["has no subscriber within 1 s", "replay.lockstep: true"]),
    ],
)
def test_a_model_that_does_not_answer_is_one_error_in_time(tmp_path, programs, remote, slow, options, words):
    path = bags.write(tmp_path / "bag", pull(count=20))
    if options is not None:
        slow(**options)
    program = programs(replay(tmp_path, path, replay__lockstep_timeout=1.0))
    assert ended(remote, program) == 1
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1, program.log()
    for word in words:
        assert word in errors[0]
    # What was sent is said all the same.
    assert program.closing_report()["lockstep"]["poses"] == (7 if options and "answers" in options else 0)
