"""The parameters of a running node through the standard services, as `ros2 param` uses them."""

import pytest
import rclpy
from rcl_interfaces.msg import Parameter, ParameterEvent, ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.parameter import Parameter as RclpyParameter
from rclpy.parameter import parameter_value_to_python

import peer as graph
from peer import SCENE, Device, Peer, Program, force_of, pressed, reliable, yaml_of


@pytest.fixture(scope="module", autouse=True)
def ros():
    graph.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


@pytest.fixture
def node(tmp_path):
    program = Program(tmp_path, "deformation", SCENE)
    yield program.wait_ready()
    program.kill()


def value(x):
    return RclpyParameter("x", value=x).get_parameter_value()


def names(peer, node="/deformation", **request):
    return peer.call(ListParameters, f"{node}/list_parameters", ListParameters.Request(**request)).result


def get(peer, *wanted, node="/deformation"):
    values = peer.call(GetParameters, f"{node}/get_parameters", GetParameters.Request(names=list(wanted))).values
    return [parameter_value_to_python(each) for each in values]


def describe(peer, *wanted):
    request = DescribeParameters.Request(names=list(wanted))
    return peer.call(DescribeParameters, "/deformation/describe_parameters", request).descriptors


def set_each(peer, **values):
    parameters = [Parameter(name=name.replace("__", "."), value=value(x)) for name, x in values.items()]
    return peer.call(
        SetParameters, "/deformation/set_parameters", SetParameters.Request(parameters=parameters)
    ).results


def test_every_parameter_of_the_node_is_listed_with_its_value(node, peer):
    listed = names(peer).names
    assert set(SCENE) <= set(listed) and "use_sim_time" in listed
    assert not any(name.startswith(("simulated.", "recording.")) for name in listed), "those of other nodes are not"
    assert {"chains", "surface", "body"} <= set(names(peer).prefixes)
    assert set(names(peer, prefixes=["surface"]).names) == {n for n in listed if n.startswith("surface.")}
    assert get(peer, "body.mesh", "chains.units", "chains.ratio", "surface.rate", "devices", "use_sim_time") == [
        "block",
        [12],
        [0.8],
        60.0,
        [""],
        False,
    ]
    assert get(peer, "chains.weight") == [[1.0]], "computed values are shown too"
    assert get(peer, "no.such.parameter") == [None]
    types = GetParameterTypes.Request(names=["chains.units", "surface.rate", "no.such.parameter"])
    assert list(peer.call(GetParameterTypes, "/deformation/get_parameter_types", types).types) == [
        ParameterType.PARAMETER_INTEGER_ARRAY,
        ParameterType.PARAMETER_DOUBLE,
        ParameterType.PARAMETER_NOT_SET,
    ]


def test_descriptions_carry_meaning_unit_range_and_what_may_change(node, peer):
    rate, ratio, units, mesh = describe(peer, "surface.rate", "chains.ratio", "chains.units", "body.mesh")
    assert rate.type == ParameterType.PARAMETER_DOUBLE and "[Hz]" in rate.description
    assert (rate.floating_point_range[0].from_value, rate.floating_point_range[0].to_value) == (0.0, 1000.0)
    assert (rate.read_only, ratio.read_only, mesh.read_only) == (False, True, True)
    assert ratio.type == ParameterType.PARAMETER_DOUBLE_ARRAY and ratio.additional_constraints
    assert units.integer_range[0].from_value == 1
    for each in describe(peer, *names(peer).names):
        assert each.description and each.type != ParameterType.PARAMETER_NOT_SET, each.name


def test_a_dump_starts_another_node_with_the_same_parameters(node, peer, tmp_path):
    listed = names(peer).names
    dump = dict(zip(listed, get(peer, *listed)))
    dump = {name: list(each) if hasattr(each, "__iter__") and not isinstance(each, str) else each for name, each in dump.items()}
    other = Program(tmp_path / "other", "deformation", yaml_of(dump), namespace="copy").wait_ready()
    try:
        assert get(peer, *listed, node="/copy/deformation") == get(peer, *listed)
    finally:
        other.kill()


def test_a_live_parameter_is_set_at_once_and_announced(node, peer):
    events = peer.heard(ParameterEvent, "/parameter_events", reliable(1000))
    device = Device(peer)
    for name, x in {"surface.rate": 10.0, "surface.cutoff": 0.2, "grasp.close_below": 0.5}.items():
        (result,) = set_each(peer, **{name.replace(".", "__"): x})
        assert result.successful, result.reason
        assert get(peer, name) == [x]
    (result,) = set_each(peer, surface__rate=30)
    assert result.successful and get(peer, "surface.rate") == [30.0], "an integer is a number"
    changed = [(p.name, parameter_value_to_python(p.value)) for e in events for p in e.changed_parameters]
    peer.wait_for(lambda: sum(len(e.changed_parameters) for e in events) == 4, "four events")
    changed = [(p.name, parameter_value_to_python(p.value)) for e in events for p in e.changed_parameters]
    assert changed[-1] == ("surface.rate", 30.0) and {e.node for e in events} == {"/deformation"}
    assert force_of(device.ask(pressed(0.002))[0])[2] > 0.0


def test_what_is_not_accepted_is_refused_with_the_reason_and_changes_nothing(node, peer):
    for name, x, word in [
        ("surface.rate", -1.0, "-1.0"),
        ("surface.rate", float("nan"), "NaN"),
        ("surface.rate", "fast", "string"),
        ("surface.rat", 1.0, "surface.rate"),
        ("body.scale", 2.0, "starts"),
        ("simulated.mass", 1.0, "no such parameter"),
    ]:
        before = get(peer, "surface.rate", "body.scale")
        (result,) = set_each(peer, **{name.replace(".", "__"): x})
        assert not result.successful and name in result.reason and word in result.reason, result.reason
        assert get(peer, "surface.rate", "body.scale") == before
    unset = Parameter(name="surface.rate", value=ParameterValue())
    request = SetParameters.Request(parameters=[unset])
    assert not peer.call(SetParameters, "/deformation/set_parameters", request).results[0].successful


def test_several_are_set_one_by_one_or_all_together(node, peer):
    good, bad = set_each(peer, surface__rate=20.0, surface__cutoff=7.0)
    assert good.successful and not bad.successful
    assert get(peer, "surface.rate") == [20.0]
    both = [Parameter(name="surface.rate", value=value(40.0)), Parameter(name="surface.cutoff", value=value(7.0))]
    request = SetParametersAtomically.Request(parameters=both)
    result = peer.call(SetParametersAtomically, "/deformation/set_parameters_atomically", request).result
    assert not result.successful and "surface.cutoff" in result.reason
    assert get(peer, "surface.rate") == [20.0]


def test_what_would_make_the_force_jump_waits_until_nothing_is_touched(node, peer):
    device = Device(peer)
    before_n = force_of(device.ask(pressed(0.003))[0])[2]
    (result,) = set_each(peer, chains__normal_stiffness=[800.0])
    assert not result.successful and "touches" in result.reason
    assert force_of(device.ask(pressed(0.003))[0])[2] == before_n
    device.ask(pressed(-0.01))
    (result,) = set_each(peer, chains__normal_stiffness=[800.0])
    assert result.successful, result.reason
    _, law, _ = device.ask(pressed(0.003))
    assert list(law.normal_stiffness) == [800.0] and force_of(device.forces[-1])[2] > before_n
    device.ask(pressed(-0.01))
    (result,) = set_each(peer, chains__tangential_stiffness=[1e6])
    assert not result.successful and "chains" in result.reason, "what the model does not accept"
