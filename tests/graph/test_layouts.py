"""RViz configuration and Foxglove layout against a running session: every topic, type, field, frame and quality of service."""

import importlib
import json
import re
from pathlib import Path

import pytest
import rclpy
import yaml
from crtk_msgs.msg import OperatingState
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

import peer as graph
from peer import SCENE, Peer, Program, latched, reliable

CONFIG = Path(__file__).resolve().parents[2] / "config"
SESSION = {**SCENE, "device.rate": 200.0, "simulated.period": 6.0}
# What RViz draws with each display.
DRAWS = {
    "rviz_default_plugins/MarkerArray": "visualization_msgs/msg/MarkerArray",
    "rviz_default_plugins/Wrench": "geometry_msgs/msg/WrenchStamped",
}
# What each Foxglove panel shows.
SHOWS = {
    "3D": {"visualization_msgs/msg/MarkerArray"},
    "DiagnosticSummary": {"diagnostic_msgs/msg/DiagnosticArray"},
    "DiagnosticStatusPanel": {"diagnostic_msgs/msg/DiagnosticArray"},
    "RosOut": {"rcl_interfaces/msg/Log"},
}
NUMBERS = r"(float|double|u?int(8|16|32|64)|byte|octet)"


class Session(Peer):
    """The real nodes, with somebody who reads what they only publish to readers."""

    def __init__(self, folder):
        super().__init__()
        self.programs = [
            Program(folder, name, SESSION) for name in ("deformation", "visualization", "haptic_device")
        ]
        for program in self.programs:
            program.wait_ready()
        self.frames, self.markers, self.diagnostics = set(), [], {}
        self.node.create_subscription(TFMessage, "/tf", self.hear_frames, reliable(100))
        self.node.create_subscription(TFMessage, "/tf_static", self.hear_frames, latched(100))
        self.node.create_subscription(MarkerArray, "markers", self.markers.append, reliable(10))
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self.hear_values, reliable(100))
        states = self.heard(OperatingState, "operating_state", latched(10))
        namespaces = lambda: {marker.ns for message in self.markers for marker in message.markers if marker.action == 0}
        complete = lambda: "force" in namespaces() and {"probe", "device_tip"} <= self.frames and states and len(self.diagnostics) > 4
        self.wait_for(complete, "a contact that is drawn")
        self.namespaces = namespaces()

    def hear_frames(self, message):
        for each in message.transforms:
            self.frames |= {each.header.frame_id, each.child_frame_id}

    def hear_values(self, message):
        for status in message.status:
            self.diagnostics.setdefault(status.name, {}).update({each.key: each.value for each in status.values})

    def publishers_of(self, topic):
        """Type and quality of service of each publisher; there is one at least."""
        found = self.node.get_publishers_info_by_topic(self.node.resolve_topic_name(topic))
        assert found, f"nobody publishes {topic}"
        return [(each.topic_type, each.qos_profile) for each in found]

    def type_of(self, topic):
        types = {message_type for message_type, _ in self.publishers_of(topic)}
        assert len(types) == 1, topic
        return types.pop()

    def close(self):
        for program in self.programs:
            program.kill()
        super().close()


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    graph.isolate()
    rclpy.init(args=[])
    session = Session(tmp_path_factory.mktemp("session"))
    yield session
    session.close()
    rclpy.shutdown()


@pytest.fixture(scope="module")
def rviz():
    return yaml.safe_load((CONFIG / "session.rviz").read_text())["Visualization Manager"]


@pytest.fixture(scope="module")
def foxglove():
    return json.loads((CONFIG / "foxglove.json").read_text())


def with_topics(rviz):
    displays = [display for display in rviz["Displays"] if "Topic" in display]
    assert len(displays) == 2
    return displays


def test_rviz_shows_topics_that_are_published_in_the_type_that_it_draws(session, rviz):
    for display in with_topics(rviz):
        assert session.type_of(display["Topic"]["Value"]) == DRAWS[display["Class"]], display["Name"]


def test_rviz_asks_for_no_more_than_the_publishers_offer(session, rviz):
    for display in with_topics(rviz):
        topic = display["Topic"]
        for _, offered in session.publishers_of(topic["Value"]):
            if topic["Reliability Policy"] == "Reliable":
                assert offered.reliability == ReliabilityPolicy.RELIABLE, topic
            if topic["Durability Policy"] == "Transient Local":
                assert offered.durability == DurabilityPolicy.TRANSIENT_LOCAL, topic


def test_rviz_stands_in_a_frame_of_the_session_and_knows_every_kind_of_marker(session, rviz):
    assert rviz["Global Options"]["Fixed Frame"] in session.frames
    markers = next(display for display in rviz["Displays"] if display["Class"].endswith("/MarkerArray"))
    assert set(markers["Namespaces"]) == session.namespaces


def kind(panel):
    return panel.split("!")[0]


def panels_in(node):
    if isinstance(node, str):
        return [node]
    return [] if node is None else panels_in(node["first"]) + panels_in(node["second"])


def test_every_foxglove_panel_has_its_place_once(foxglove):
    tabs = [config for panel, config in foxglove["configById"].items() if kind(panel) == "Tab"]
    placed = panels_in(foxglove["layout"])
    for tab in tabs:
        placed += [panel for each in tab["tabs"] for panel in panels_in(each["layout"])]
    assert sorted(placed) == sorted(foxglove["configById"])


def topics_of(foxglove):
    """Every topic of the layout, with the types that its panel can show; none: any."""
    for panel, config in foxglove["configById"].items():
        shown = SHOWS.get(kind(panel))
        if "topicToRender" in config:
            yield config["topicToRender"], shown
        if "topicPath" in config:
            yield config["topicPath"], shown
        for topic in config.get("topics", {}):
            yield topic, shown
        for path in config.get("paths", []):
            yield path["value"].split(".")[0], shown


def test_foxglove_shows_topics_that_are_published_in_types_that_its_panels_know(session, foxglove):
    topics = list(topics_of(foxglove))
    assert {topic for topic, _ in topics} >= {"/markers", "/contact_state", "/servo_cf", "/operating_state", "/diagnostics"}
    for topic, shown in topics:
        found = session.type_of(topic)
        assert shown is None or found in shown, f"{topic} is {found}"


def test_all_publishers_of_a_topic_in_foxglove_offer_the_same(session, foxglove):
    """The bridge subscribes once for all of them, and asks for no more than each of them offers."""
    for topic in {topic for topic, _ in topics_of(foxglove)}:
        offers = {(offered.reliability, offered.durability) for _, offered in session.publishers_of(topic)}
        assert len(offers) == 1, topic
        assert offers.pop()[0] == ReliabilityPolicy.RELIABLE, topic


def field(message_type, path):
    """The type of a field, by a path of names."""
    for name in path:
        parts = message_type.split("/")
        fields = getattr(importlib.import_module(f"{parts[0]}.msg"), parts[-1]).get_fields_and_field_types()
        assert name in fields, f"{message_type} has no {name}"
        message_type = fields[name]
    return message_type


def test_every_path_in_foxglove_leads_to_a_value_that_is_there(session, foxglove):
    diagnostic = re.compile(r'/diagnostics\.status\[:\]\{name=="(.+)"\}\.values\[:\]\{key=="(\w+)"\}\.value')
    count = 0
    for panel, config in foxglove["configById"].items():
        for path in config.get("paths", []):
            count += 1
            if found := diagnostic.fullmatch(path["value"]):
                float(session.diagnostics[found[1]][found[2]])
                continue
            topic, *names = path["value"].split(".")
            value = field(session.type_of(topic), names)
            if kind(panel) == "Plot":
                assert re.fullmatch(NUMBERS, value), f"{path['value']} is {value}"
    assert count > 8
    for config in (config for panel, config in foxglove["configById"].items() if kind(panel) == "DiagnosticStatusPanel"):
        assert config["selectedName"] in session.diagnostics


def test_every_frame_in_foxglove_is_one_of_the_session(session, foxglove):
    scene = foxglove["configById"]["3D!session"]
    named = {name.removeprefix("frame:") for name in scene["transforms"]}
    named |= {scene["followTf"]} | {layer["frameId"] for layer in scene["layers"].values()}
    assert named == session.frames
