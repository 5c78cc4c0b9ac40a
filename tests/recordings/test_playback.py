"""What a replay can be told: where it begins and ends, how often, under which names, how it pauses, what time it is."""

import bags
import peer
import pytest
from bags import MS, START_NS
from geometry_msgs.msg import PoseStamped, TransformStamped
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import Joy
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger

SECONDS_NS = 1_000_000_000
CLOCK_QOS = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)


def player(folder, path, **values):
    values = {"bag_replay.mode": "play", "replay.path": str(path), "replay.wait_for_subscribers": peer.TIMEOUT_S} | {
        name.replace("__", "."): value for name, value in values.items()
    }
    return peer.Program(folder, "bag_replay", values)


def pose(at_ms):
    return bags.stamp(PoseStamped(), at_ms)


@pytest.fixture(scope="module")
def recording(ros, tmp_path_factory):
    """1 s of poses at 100 Hz, a latched button at 0, 300 and 700 ms, and one that is latched but first said at 800 ms."""
    rows = [("/measured_cp", at_ms, pose(at_ms)) for at_ms in range(0, 1000, 10)]
    rows += [("/clutch", at_ms + 0.5, Joy(buttons=[at_ms])) for at_ms in (0, 300, 700)]
    rows += [("/late", 800.5, Bool(data=True))]
    rows.sort(key=lambda row: row[1])
    return bags.write(tmp_path_factory.mktemp("bags") / "second", rows, latched=("/clutch", "/late"))


class Ear:
    """What was heard on some topics, all in one list."""

    def __init__(self, remote, kinds, latched=()):
        self.heard = []
        for topic, kind in kinds.items():
            def keep(message, topic=topic):
                self.heard.append((topic, message))

            qos = peer.latched(1000) if topic in latched else peer.reliable(1000)
            remote.node.create_subscription(kind, topic, keep, qos)

    def on(self, topic):
        return [message for heard_on, message in self.heard if heard_on == topic]

    def poses_ms(self, topic="/measured_cp"):
        return [(peer.stamp_of(message) - START_NS) // MS for message in self.on(topic)]


def end(remote, program, code=0):
    remote.wait_for(lambda: program.process.poll() is not None, "the end of the replay")
    remote.spin(0.1)
    assert program.process.returncode == code, program.log()
    return program.closing_report()


def test_a_start_and_a_duration_cut_the_recording_and_latched_topics_say_first_what_they_had_said(
    tmp_path, programs, remote, recording
):
    latched = ("/clutch", "/late")
    ear = Ear(remote, {"/measured_cp": PoseStamped, "/clutch": Joy, "/late": Bool}, latched)
    program = programs(player(tmp_path, recording, replay__start=0.5, replay__duration=0.25, replay__rate=5.0))
    report = end(remote, program)
    assert ear.poses_ms() == list(range(500, 751, 10))
    assert [list(joy.buttons) for joy in ear.on("/clutch")] == [[0], [300], [700]]
    # Logged behind the end, and known all the same.
    assert len(ear.on("/late")) == 1
    assert report["topics"] == {"/measured_cp": 26, "/clutch": 3, "/late": 1}


def test_a_loop_begins_again_with_the_recorded_stamps_until_it_is_told_to_end(tmp_path, programs, remote, recording):
    ear = Ear(remote, {"/measured_cp": PoseStamped})
    clock = remote.heard(Clock, "/clock", CLOCK_QOS)
    program = programs(
        player(tmp_path, recording, replay__loop=True, replay__rate=10.0, replay__clock=1000.0,
               replay__topics=["measured_cp"])
    )  # fmt: skip
    remote.wait_for(lambda: len(ear.heard) >= 250, "two rounds and a half")
    assert program.interrupt()[0] == 0, program.log()
    assert program.closing_report()["rounds"] >= 3
    stamps = ear.poses_ms()
    assert stamps[:250] == [*range(0, 1000, 10), *range(0, 1000, 10), *range(0, 500, 10)]
    times = [message.clock.sec * SECONDS_NS + message.clock.nanosec for message in clock]
    assert sum(after < before for before, after in zip(times, times[1:])) >= 2, "the time goes back"
    assert "round 2 begins: the time goes back by" in program.log()


def test_the_clock_says_the_time_of_the_recording_from_before_the_first_message_on(
    tmp_path, programs, remote, recording
):
    heard = []
    remote.node.create_subscription(Clock, "/clock", lambda message: heard.append(("clock", message.clock)), CLOCK_QOS)
    remote.node.create_subscription(
        PoseStamped, "/measured_cp", lambda message: heard.append(("pose", message.header.stamp)), peer.reliable(1000)
    )
    program = programs(player(tmp_path, recording, replay__clock=200.0, replay__topics=["measured_cp"]))
    end(remote, program)
    ns = [(kind, stamp.sec * SECONDS_NS + stamp.nanosec - START_NS) for kind, stamp in heard]
    times = [at for kind, at in ns if kind == "clock"]
    assert times[0] == 0 and times == sorted(times)
    # 1 s at 200 Hz; how many of them a busy machine makes is its own business.
    assert 20 <= len(times) <= 210 and times[-1] >= 0.9 * SECONDS_NS
    for (kind, at), (_, before) in zip(ns[1:], ns):
        if kind == "pose":
            assert before <= at + 100 * MS


def test_topics_are_selected_and_played_under_other_names(tmp_path, programs, remote, recording):
    ear = Ear(remote, {"/or/left/measured_cp": PoseStamped, "/measured_cp": PoseStamped, "/or/pedal": Joy}, ("/or/pedal",))
    values = {"bag_replay.mode": "play", "replay.path": str(recording), "replay.rate": 10.0,
              "replay.topics": ["/measured_cp", "/clutch"], "replay.wait_for_subscribers": peer.TIMEOUT_S,
              "replay.remap": ["/measured_cp:=left/measured_cp", "/clutch:=pedal"]}  # fmt: skip
    program = programs(peer.Program(tmp_path, "bag_replay", values, namespace="or"))
    report = end(remote, program)
    assert report["topics"] == {"/or/left/measured_cp": 100, "/or/pedal": 3}
    assert len(ear.on("/or/left/measured_cp")) == 100 and len(ear.on("/or/pedal")) == 3
    assert ear.on("/measured_cp") == []


def test_another_quality_of_service_is_offered_where_it_is_asked_for(tmp_path, programs, remote, recording):
    qos = ["measured_cp=best_effort", "clutch=volatile,depth=5"]
    program = programs(player(tmp_path, recording, replay__qos=qos, replay__paused=True, replay__wait_for_subscribers=0.0))
    offers = {}

    def all_there():
        for topic in ("/measured_cp", "/clutch", "/late"):
            offers[topic] = remote.node.get_publishers_info_by_topic(topic)
        return all(offers.values())

    remote.wait_for(all_there, "the publishers of the replay")
    assert offers["/measured_cp"][0].qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert offers["/clutch"][0].qos_profile.reliability == ReliabilityPolicy.RELIABLE
    assert offers["/clutch"][0].qos_profile.durability == DurabilityPolicy.VOLATILE
    assert offers["/late"][0].qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert program.interrupt()[0] == 0, program.log()


def call(remote, name):
    answer = remote.call(Trigger, f"/bag_replay/{name}", Trigger.Request())
    return answer.success, answer.message


def test_a_replay_begins_paused_steps_from_pose_to_pose_and_resumes_where_it_stood(
    tmp_path, programs, remote, recording
):
    ear = Ear(remote, {"/measured_cp": PoseStamped, "/clutch": Joy}, ("/clutch",))
    program = programs(player(tmp_path, recording, replay__paused=True, replay__topics=["measured_cp", "clutch"]).wait_ready())
    assert call(remote, "pause") == (False, "the replay pauses already")
    assert ear.heard == []
    for count in (1, 2, 3):
        success, text = call(remote, "step")
        assert success and "up to and including the next pose" in text
        remote.wait_for(lambda count=count: len(ear.poses_ms()) == count, "the step")
    # The latched message before the first pose and the one behind it came along.
    assert ear.poses_ms() == [0, 10, 20] and len(ear.on("/clutch")) == 1
    remote.spin(0.2)
    assert len(ear.poses_ms()) == 3
    level, summary, values = remote.new_status("/bag_replay: replay")
    assert summary == values["state"] == "paused" and values["position_s"] == "0.020"
    assert float(values["duration_s"]) == 0.99 and values["rounds"] == "1" and values["messages"] == "4"
    assert call(remote, "resume") == (True, "the replay goes on")
    success, text = call(remote, "resume")
    assert (success, text) == (False, "the replay does not pause")
    success, text = call(remote, "step")
    assert not success and "~/pause" in text
    end(remote, program)
    assert ear.poses_ms() == list(range(0, 1000, 10))
    log = program.log()
    for tenth in range(1, 11):
        assert f"{10 * tenth} %: " in log


def test_a_pause_holds_everything_and_the_rest_keeps_its_spacing(tmp_path, programs, remote, recording):
    ear = Ear(remote, {"/measured_cp": PoseStamped})
    program = programs(player(tmp_path, recording, replay__rate=0.5, replay__topics=["measured_cp"]))
    remote.wait_for(lambda: len(ear.heard) >= 10, "the first poses")
    success, text = call(remote, "pause")
    assert success and "~/resume" in text
    remote.spin(0.1)
    held = len(ear.heard)
    assert held < 100
    remote.spin(0.5)
    assert len(ear.heard) == held
    assert call(remote, "resume")[0]
    report = end(remote, program)
    assert ear.poses_ms() == list(range(0, 1000, 10))
    # Nothing is made up for: after the pause nothing was late by as much as the pause.
    assert report["latest_ms"] < 400


def transform(at_ms, z=0.25):
    message = bags.stamp(TransformStamped(), at_ms)
    message.header.frame_id = "base"
    message.child_frame_id = "tip"
    message.transform.translation.x = at_ms * 1e-3
    message.transform.translation.z = z
    message.transform.rotation.z, message.transform.rotation.w = 0.6, 0.8
    return message


def test_transforms_of_older_crtk_devices_are_played_as_poses(tmp_path, programs, remote):
    rows = [("/MTMR/position_cartesian_current", at_ms, transform(at_ms)) for at_ms in range(20)]
    rows += [("/camera", at_ms + 0.5, transform(at_ms)) for at_ms in range(20)]
    path = bags.write(tmp_path / "bag", sorted(rows, key=lambda row: row[1]))
    ear = Ear(remote, {"/measured_cp": PoseStamped, "/camera": TransformStamped})
    program = programs(player(tmp_path, path, replay__remap=["/MTMR/position_cartesian_current:=measured_cp"]))
    end(remote, program)
    assert ear.poses_ms() == list(range(20)) and len(ear.on("/camera")) == 20
    for at_ms, message in enumerate(ear.on("/measured_cp")):
        position, orientation = message.pose.position, message.pose.orientation
        assert (message.header.frame_id, position.x, position.z) == ("base", at_ms * 1e-3, 0.25)
        assert (orientation.x, orientation.z, orientation.w) == (0.0, 0.6, 0.8)


def test_broken_messages_are_left_out_and_counted(tmp_path, programs, remote):
    def row(at_ms):
        kind, data = bags.type_name(PoseStamped), bags.serialize_message(pose(at_ms))
        broken = {3: data[:-1], 5: b"", 7: b"\x00\x01\x00", 9: b"\x07\x07\x00\x00" + data[4:]}
        return "/measured_cp", at_ms, (kind, broken.get(at_ms, data))

    path = bags.write(tmp_path / "bag", [row(at_ms) for at_ms in range(12)])
    ear = Ear(remote, {"/measured_cp": PoseStamped})
    program = programs(player(tmp_path, path))
    report = end(remote, program)
    assert ear.poses_ms() == [0, 1, 2, 4, 6, 8, 10, 11]
    assert report["broken_messages"] == 4 and report["messages"] == 8
    assert program.log().count("is left out: not a geometry_msgs/msg/PoseStamped") == 4


def gadget(path):
    """Two topics; one of another definition of a known type, one of a known name and another type."""
    store = get_typestore(Stores.EMPTY)
    text = "std_msgs/Header header\nfloat64 x\nfloat64 y\n"
    time = "int32 sec\nuint32 nanosec\n"
    header = "builtin_interfaces/Time stamp\nstring frame_id\n"
    for types in (
        get_types_from_msg(time, "builtin_interfaces/msg/Time"),
        get_types_from_msg(header, "std_msgs/msg/Header"),
        get_types_from_msg(text, "geometry_msgs/msg/PoseStamped"),
    ):
        store.register(types)
    return bags.write(path, [("/measured_cp", 0, ("geometry_msgs/msg/PoseStamped", b"\x00\x01\x00\x00" + bytes(40)))], store=store)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"replay.path": "{gadget}"}, ["/measured_cp", "geometry_msgs/msg/PoseStamped", "x"]),
        ({"replay.remap": ["measured_cp"]}, ["replay.remap", "measured_cp", "FROM:=TO"]),
        ({"replay.remap": ["measured_cp:=late"]}, ["/measured_cp", "/late", "both"]),
        ({"replay.remap": ["nothing:=late"]}, ["replay.remap", "/nothing"]),
        ({"replay.remap": ["late:=measured_cp", "measured_cp:=x"]}, ["/late", "std_msgs/msg/Bool", "PoseStamped"]),
        ({"replay.qos": ["measured_cp=fast"]}, ["replay.qos", "fast", "best_effort"]),
        ({"replay.qos": ["nothing=reliable"]}, ["replay.qos", "/nothing"]),
        ({"replay.start": -1.0}, ["replay.start", "-1"]),
        ({"replay.start": 1e5}, ["replay.start", "100000 s", "ends", "after its first message"]),
        ({"replay.lockstep": True, "replay.topics": ["clutch"]}, ["replay.lockstep", "no poses", "/clutch"]),
        ({"replay.lockstep": True, "devices": ["left"]}, ["replay.lockstep", "left", "/measured_cp"]),
    ],
)
def test_what_cannot_be_played_as_it_is_asked_for_is_one_error_and_nothing_is_sent(
    tmp_path, programs, recording, values, words
):
    values = {"bag_replay.mode": "play", "replay.path": str(recording)} | values
    if values["replay.path"] == "{gadget}":
        values["replay.path"] = str(gadget(tmp_path / "gadget"))
    program = programs(peer.Program(tmp_path, "bag_replay", values))
    assert program.process.wait(peer.TIMEOUT_S) == 1
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert len(errors) == 1, program.log()
    for word in words:
        assert word in errors[0], program.log()
    assert "ready:" not in program.log()


def test_a_topic_that_another_node_knows_with_another_type_is_an_error(tmp_path, programs, remote, recording):
    other = remote.node.create_publisher(String, "/measured_cp", 10)
    other.publish(String(data="not a pose"))
    program = programs(player(tmp_path, recording, replay__wait_for_subscribers=2.0, replay__topics=["measured_cp"]))
    remote.wait_for(lambda: program.process.poll() is not None, "the end of the replay")
    errors = [line for line in program.log().splitlines() if "ERROR" in line]
    assert program.process.returncode == 1 and len(errors) == 1, program.log()
    for word in ("/measured_cp", "std_msgs/msg/String", "geometry_msgs/msg/PoseStamped"):
        assert word in errors[0]
