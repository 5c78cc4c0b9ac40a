"""What a page may do: set live parameters, and lead the hand of a pointer device."""

import signal
import time

import peer
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import GetParameters
from rhombus_haptics_msgs.msg import ContactState
from std_msgs.msg import Bool
from viewer import start  # noqa: F401


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


def test_a_parameter_is_set_on_every_node_that_has_it_or_on_none(start, tmp_path):
    scene = {**peer.SCENE, "viewer.port": 0}
    session = start(scene)
    model = peer.Program(tmp_path, "deformation", scene, session.namespace).wait_ready()
    try:
        page = session.page()
        both = [f"/{session.namespace}/deformation", f"/{session.namespace}/visualization"]
        shown = lambda: {each["name"]: each for each in (page.last("parameters") or {"parameters": []})["parameters"]}
        stiffness = "chains.normal_stiffness"
        session.wait_for(lambda: shown().get(stiffness, {}).get("nodes") == both, "the parameters of both nodes")
        described = shown()[stiffness]
        assert (described["value"], described["type"], described["unit"]) == ([500.0], "double_array", "N/m")
        assert described["exclusive_min"] and described["min"] == 0.0 and "> 0" in described["accepted"]
        assert not any(name.startswith(("safety.", "device.", "unsafe.")) for name in shown())
        assert "body.mesh" not in shown(), "not live"
        assert "visualization.full_scale" in shown() and "visualization.show_chains" not in shown(), "a page draws its own chains"

        def value_of(node):
            answer = session.call(GetParameters, f"{node}/get_parameters", GetParameters.Request(names=[stiffness]))
            return list(answer.values[0].double_array_value)

        def set_it(value):
            number = len(page.said("parameter_result")) + 1
            page.send(type="set_parameter", id=number, name=stiffness, value=value)
            session.wait_for(lambda: len(page.said("parameter_result")) == number, "the result")
            assert page.last("parameter_result")["id"] == number
            return page.last("parameter_result")

        assert set_it([650.0])["ok"]
        assert [value_of(node) for node in both] == [[650.0], [650.0]]
        session.wait_for(lambda: shown()[stiffness]["value"] == [650.0], "the new value on the page")
        session.wait_for(
            lambda: page.last("chains")["chains"][0]["normal_stiffness_n_per_m"] == 650.0, "the new chains"
        )
        for wrong, reason in [([-1.0], "> 0"), ([1e-9], "k"), ("stiff", "accepted"), ([1.0, 2.0], "chains")]:
            refused = set_it(wrong)
            assert not refused["ok"] and reason in refused["reason"], refused
        assert [value_of(node) for node in both] == [[650.0], [650.0]], "all or none"

        page.send(type="set_parameter", id=99, name="safety.max_speed", value=1.0)
        session.wait_for(lambda: page.last("parameter_result")["id"] == 99, "no protection is a page's to change")
        assert not page.last("parameter_result")["ok"]

        model.process.send_signal(signal.SIGSTOP)
        hung = set_it([700.0])
        model.process.send_signal(signal.SIGCONT)
        assert not hung["ok"] and "has not answered" in hung["reason"]
        session.spin(0.5)
        assert [value_of(node) for node in both] == [[650.0], [650.0]], "one that hung changes nothing when it goes on"
    finally:
        model.kill()


def test_a_node_that_refuses_what_others_accepted_has_it_taken_back(start):
    session = start()
    stubborn = rclpy.create_node("zz_stubborn", namespace=session.namespace)
    stubborn.declare_parameter("visualization.full_scale", 0.005)
    refuse = lambda parameters: SetParametersResult(successful=False, reason="not while I live")
    stubborn.add_on_set_parameters_callback(refuse)
    stubborn.create_publisher(ContactState, "contact_state", 10)
    page = session.page()
    answer = lambda: rclpy.spin_once(stubborn, timeout_sec=0)
    nodes = lambda: next(
        (each["nodes"] for each in (page.last("parameters") or {"parameters": []})["parameters"] if "full_scale" in each["name"]),
        [],
    )
    session.wait_for(lambda: len(nodes()) == 2, "the parameter of both nodes", answer)
    page.send(type="set_parameter", id=1, name="visualization.full_scale", value=0.009)
    session.wait_for(lambda: page.said("parameter_result"), "the result", answer)
    result = page.last("parameter_result")
    assert not result["ok"] and result["reason"] == f"/{session.namespace}/zz_stubborn: not while I live"
    request = GetParameters.Request(names=["visualization.full_scale"])
    values = session.call(GetParameters, f"/{session.namespace}/visualization/get_parameters", request).values
    assert values[0].double_value == 0.005
    stubborn.destroy_node()


def test_a_page_takes_the_pointer_moves_it_and_lets_go_by_silence(start):
    session = start()
    page, other = session.page(), session.page()
    target = lambda n, **more: {
        "type": "pointer_target",
        "device": "",
        "sequence": n,
        "position": [0.01, 0.02, 0.003 * n],
        "grasp": False,
        **more,
    }
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.said("pointer"), "an answer")
    assert not page.last("pointer")["granted"] and "device.backend" in page.last("pointer")["reason"]
    assert session.node.count_publishers(session.node.resolve_topic_name("pointer_target")) == 0

    targets = session.heard(PoseStamped, "pointer_target", peer.reliable(10))
    grasps = session.heard(Bool, "grasp", peer.reliable(10))
    free = lambda: (page.last("status") or {"devices": [{}]})["devices"][0].get("pointer")
    held = lambda: page.last("status")["devices"][0]["held"]
    session.wait_for(free, "the device listens")
    assert not held()
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.last("pointer")["granted"], "the pointer")
    numbers = iter(range(1, 1_000_000))
    session.wait_for(lambda: targets, "a target", lambda: page.send(**target(next(numbers))))
    now = time.time()
    session.wait_for(held, "a page moves it", lambda: page.send(**target(next(numbers))))
    heard = targets[-1]
    assert heard.header.frame_id == f"{session.namespace}/body"
    assert abs(heard.header.stamp.sec + heard.header.stamp.nanosec * 1e-9 - now) < 1.0
    assert (heard.pose.position.x, heard.pose.orientation.w) == (0.01, 1.0)

    other.send(type="pointer_take", device="")
    page.send(**target(next(numbers)))
    session.wait_for(lambda: other.said("pointer"), "an answer", lambda: page.send(**target(next(numbers))))
    assert not other.last("pointer")["granted"], "one page at a time"
    other.send(**target(10_000_000))
    session.wait_for(lambda: other.said("refused"), "a page that does not hold it moves nothing")

    session.spin(0.1)
    before = len(targets)
    page.send(**target(1))
    session.wait_for(lambda: page.said("refused"), "a target that was overtaken")
    session.spin(0.1)
    assert len(targets) == before

    session.wait_for(lambda: grasps and grasps[-1].data, "the grasp", lambda: page.send(**target(next(numbers), grasp=True)))
    begun, count = time.monotonic(), len(grasps)
    session.wait_for(lambda: not grasps[-1].data, "silence lets go")
    assert 0.2 < time.monotonic() - begun < 0.6 and len(grasps) == count + 1
    count = len(targets)
    session.spin(0.5)
    assert len(targets) == count, "and targets end"
    session.wait_for(lambda: not held(), "what a silent page has may be taken")

    other.send(type="pointer_take", device="")
    session.wait_for(lambda: other.last("pointer")["granted"] and not page.last("pointer")["granted"], "a silent page loses it")
    session.wait_for(lambda: grasps[-1].data, "the other page grasps", lambda: other.send(**target(next(numbers), grasp=True)))
    other.close()
    session.pages.remove(other)
    session.wait_for(lambda: not grasps[-1].data, "a page that is gone holds nothing")
    topic = session.node.resolve_topic_name("pointer_target")
    session.wait_for(lambda: session.node.count_publishers(topic) == 0, "nobody publishes targets any more")


def test_a_device_whose_driver_says_that_the_target_is_out_of_reach_is_said_so_to_pages(start):
    session = start({"devices": ["left", "right"]})
    page = session.page()
    diagnostics = session.node.create_publisher(DiagnosticArray, "/diagnostics", 10)

    def say(out_of_reach):
        values = [KeyValue(key="is_out_of_reach", value=out_of_reach)]
        name = f"/{session.namespace}/right/haptic_device: pointer"
        diagnostics.publish(DiagnosticArray(status=[DiagnosticStatus(name=name, values=values)]))

    told = lambda: [each["out_of_reach"] for each in (page.last("status") or {"devices": []})["devices"]]
    session.wait_for(lambda: told() == [False, True], "it is said", lambda: say("true"))
    session.wait_for(lambda: told() == [False, False], "it is in reach again", lambda: say("false"))


def test_targets_arrive_within_milliseconds(start):
    session = start()
    page = session.page()
    arrivals = []
    session.node.create_subscription(
        PoseStamped, "pointer_target", lambda message: arrivals.append(time.monotonic()), peer.reliable(10)
    )
    free = lambda: (page.last("status") or {"devices": [{}]})["devices"][0].get("pointer")
    session.wait_for(free, "the device listens")
    page.send(type="pointer_take", device="")
    session.wait_for(lambda: page.said("pointer"), "the pointer")
    number, waits = 0, []
    deadline = time.monotonic() + 10
    while len(waits) < 100 and time.monotonic() < deadline:
        before, number, begun = len(arrivals), number + 1, time.monotonic()
        page.send(type="pointer_target", device="", sequence=number, position=[0, 0, 0], grasp=False)
        while len(arrivals) == before and time.monotonic() - begun < 0.2:
            rclpy.spin_once(session.node, timeout_sec=0.05)
        page.poll()
        if len(arrivals) > before:
            waits.append(arrivals[before] - begun)
        time.sleep(0.003)
    assert len(waits) == 100
    assert sorted(waits)[50] < 0.005, f"median {1000 * sorted(waits)[50]:.1f} ms"
