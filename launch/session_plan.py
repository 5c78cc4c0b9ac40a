"""What a session consists of: its devices, and for each node the executable, the namespace and the parameters.

Nothing is started here. The scene is checked with `rhombus explain`, once for each device, with everything that the
command line puts in the place of the scene's values.
"""

import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
PROGRAMS = REPOSITORY / "target" / "release"
DRIVER = "haptic_device"
SIMULATED = "simulated"
POINTER = "pointer"
# What other options say.
NOT_SETTABLE = {"devices": "--device", "device.backend": "--device", "device.serial": "--device"}


class Refused(Exception):
    """An option or the scene is not accepted; the text is for the person who gave it."""


@dataclass(frozen=True)
class Device:
    """One device of the session. The name is its sub-namespace; empty: the session's own namespace."""

    name: str
    backend: str
    serial: str = ""

    @classmethod
    def parse(cls, text):
        """From `[NAME=]BACKEND[:SERIAL]`."""
        parts = re.fullmatch(r"(?:([A-Za-z]\w*)=)?([A-Za-z]\w*)(?::(.+))?", text, re.ASCII)
        if not parts:
            raise Refused(f"--device '{text}'; accepted: [NAME=]BACKEND[:SERIAL], like haply or left=serial:R7")
        name, backend, serial = (part or "" for part in parts.groups())
        return cls(name, backend, serial)

    @property
    def label(self):
        """What people are told: the name, or what the driver node is called."""
        return self.name or DRIVER

    @property
    def subject(self):
        """What the model's diagnostics and report call it."""
        return self.name or "device"


@dataclass(frozen=True)
class Assignment:
    """`[NAME/]KEY=VALUE`: a parameter in place of the scene's, for every node or for the driver of one device."""

    device: str
    key: str
    value: str

    @classmethod
    def parse(cls, text):
        parts = re.fullmatch(r"(?:(\w+)/)?([^=/]+)=(.*)", text, re.ASCII)
        if not parts:
            raise Refused(f"--set '{text}'; accepted: [NAME/]KEY=VALUE, like serial.port=/dev/ttyACM0")
        device, key, value = parts[1] or "", parts[2].strip(), parts[3].strip()
        if key in NOT_SETTABLE:
            raise Refused(f"--set '{text}': {key} is what {NOT_SETTABLE[key]} says")
        return cls(device, key, value)


@dataclass
class NodePlan:
    """One node: what it is called in the session, what is run, with which parameters in place of the scene's."""

    label: str
    executable: str
    name: str
    namespace: str
    parameters: list = field(default_factory=list)

    @property
    def full_name(self):
        return f"{self.namespace.rstrip('/')}/{self.name}"

    def arguments(self, scene, log_level):
        """Behind the executable's name."""
        arguments = ["--ros-args", "-r", f"__node:={self.name}", "-r", f"__ns:={self.namespace}"]
        arguments += ["--log-level", log_level, "--params-file", scene]
        # By the node's name: what a section of the scene says for this node would win over a bare parameter.
        for key, value in self.parameters:
            arguments += ["-p", f"{self.name}:{key}:={value}"]
        return arguments


class Plan:
    """The devices and nodes of a session. Raises Refused for what is not accepted."""

    def __init__(self, options):
        given = [Device.parse(text) for text in options.device]
        assignments = [Assignment.parse(text) for text in options.set]
        check_names(given, assignments)
        self.scene = options.scene
        self.namespace = "/" + options.namespace.strip("/")
        # A calibrated body is for one mesh.
        everywhere = [("body.mesh", json.dumps(options.mesh)), ("body.response", '""')] if options.mesh else []
        everywhere += [(each.key, each.value) for each in assignments if not each.device]
        self.devices = given or scene_devices(self.scene, everywhere)
        names = [device.name for device in self.devices]
        for each in assignments:
            if each.device and each.device not in names:
                raise Refused(f"--set '{each.device}/{each.key}={each.value}': no device is called '{each.device}'")
        self.common = [("devices", json.dumps(names)), *everywhere]
        self.of_device = {}
        for device in self.devices:
            what = [("device.backend", json.dumps(device.backend)), ("device.serial", json.dumps(device.serial))]
            own = [(each.key, each.value) for each in assignments if each.device and each.device == device.name]
            self.of_device[device] = (what if given else []) + own
        self.explanations = [explain(self.scene, [*self.common, *own]) for own in self.of_device.values()]

    @property
    def has_only_simulated_devices(self):
        return all(device.backend == SIMULATED for device in self.devices)

    @property
    def has_pointer(self):
        return any(device.backend == POINTER for device in self.devices)

    def drivers(self, readers):
        """One for each device; each waits for as many readers of its poses."""
        wait = [("device.wait_for_readers", str(readers))]
        return [
            NodePlan(
                label=device.label,
                executable=DRIVER,
                name=DRIVER,
                namespace=f"{self.namespace.rstrip('/')}/{device.name}".rstrip("/") or "/",
                parameters=self.common + wait + parameters,
            )
            for device, parameters in self.of_device.items()
        ]

    def node(self, executable, name=None, parameters=()):
        """Another node of the session."""
        name = name or executable
        return NodePlan(name, executable, name, self.namespace, self.common + list(parameters))


def check_names(devices, assignments):
    """Several devices need names, each its own."""
    names = [device.name for device in devices]
    if len(names) > 1 and "" in names:
        raise Refused("--device: several devices need names; accepted: --device left=BACKEND --device right=BACKEND")
    if len(set(names)) < len(names):
        raise Refused(f"--device: the name '{max(names, key=names.count)}' is given twice")
    keys = [(each.device, each.key) for each in assignments]
    if len(set(keys)) < len(keys):
        raise Refused(f"--set: '{max(keys, key=keys.count)[1]}' is given twice")


def scene_devices(scene, parameters):
    """The devices that the scene names itself."""
    found = json.loads(explain(scene, parameters, "--json"))["devices"]
    return [Device(device["name"], device["backend"]) for device in found]


def explain(scene, parameters, *options):
    """What the scene builds with these parameters in place of its own."""
    command = [str(PROGRAMS / "rhombus"), "explain", scene, *options]
    for key, value in parameters:
        command += ["--set", f"{key}={value}"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise Refused(result.stderr.strip().removeprefix("rhombus: "))
    return result.stdout
