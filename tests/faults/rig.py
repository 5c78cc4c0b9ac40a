"""A session to be broken: model and driver as they are shipped, a device that is a double, and a hand that presses."""

import itertools
import os
import subprocess
import tempfile
import time
from pathlib import Path

from crtk_msgs.msg import OperatingState, StringStamped

import peer as graph
from peer import SCENE, TIMEOUT_S, Program, latched, reliable

from record import Record

# The device stands so that its origin is just above the middle of the block's top.
SCENE_FROM_DEVICE = [0.011, 0.007, 0.06, 0.0, 0.0, 0.0, 1.0]
FREE, PRESSED = "0,0,0.01", "0,0,-0.03"
PRESSING_N = 1.0
MEMORY = Path("/dev/shm")
# Some newtons in this body under this hand.
STIFF = {"chains.normal_stiffness": [2000.0], "chains.tangential_stiffness": [400.0]}
# Without these two rules a run takes a fraction of a second: a device that comes back under the pressing hand gets its
# force at once, at the slew limit. With them the hand has to withdraw first, and the force then grows for 2 s. What is
# measured, how the force goes, happens before they matter.
QUICK = {
    "safety.engage_force": 100.0,
    "safety.engage_ticks": 0,
    "safety.engage_ramp": 0.0,
    "safety.passivity": False,
    "unsafe.parameters": ["safety.engage_force", "safety.engage_ticks", "safety.engage_ramp", "safety.passivity"],
}


def as_a_device():
    """A device keeps its own time, however busy the machine is that plays it; where that is permitted."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(60))
    except PermissionError:
        pass


class NotPressing(AssertionError):
    """The motors do not push before anything was broken, or the machine was too busy for the session."""


class Double:
    """A device that is not there, with a hand on its handle."""

    def __init__(self, backend, folder, hand):
        folder.mkdir(parents=True, exist_ok=True)
        # In memory: a device waits for no disk. And with a short name, because a Unix socket comes into it.
        self.memory = tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None)
        self.record_path = Path(self.memory.name) / "record.csv"
        sdk = self.memory.name
        program, options, self.values = {
            "serial": ("serial_double", ["--link", folder / "tty"], {"serial.port": str(folder / "tty")}),
            "force_dimension": ("force_dimension_double", ["--sdk", sdk], {"force_dimension.sdk": sdk}),
            "haply": ("haply_double", [], {"haply.max_force": 20.0}),
        }[backend]
        self.values["device.backend"] = backend
        command = [graph.PROGRAMS / program, "--record", self.record_path, *options, *hand]
        self.process = subprocess.Popen(
            [str(word) for word in command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=as_a_device,
        )
        ready = self.process.stdout.readline()
        assert ready.startswith("ready: "), ready
        if backend == "haply":
            self.values["haply.url"] = ready.split()[1]

    def close(self):
        self.process.terminate()
        self.process.communicate(timeout=TIMEOUT_S)
        self.memory.cleanup()


class Rig:
    """Model (or none), driver, double and the hand. `values` are parameters on top of the scene's."""

    def __init__(self, peer, folder, backend="serial", values=None, driver="haptic_device", press_after_s=0.0, model="deformation"):
        self.peer, self.folder, self.driver_name = peer, folder, driver
        self.numbers = itertools.count()
        hand = ["--from", FREE, "--to", PRESSED, "--during", 0.4, "--after", press_after_s]
        self.double = Double(backend, folder / "device", hand)
        self.values = {
            **SCENE,
            **STIFF,
            "device.scene_from_device": SCENE_FROM_DEVICE,
            # What a viewer needs is not what is tested, and the machine may be small.
            "surface.rate": 10.0,
            **self.double.values,
            **(values or {}),
        }
        self.record = Record(self.double.record_path)
        self.programs = []
        self.states = peer.heard(OperatingState, "operating_state", latched(10))
        try:
            self.model = self.start(model) if model else None
            self.driver = self.start(driver)
        except NotPressing:
            self.close()
            raise

    def start(self, executable, environment=None):
        """Another process of the session, in a folder of its own."""
        folder = self.folder / str(next(self.numbers))
        values = {**self.values, "recording.directory": str(folder / "recordings")}
        program = Program(folder, executable, values, environment=environment)
        self.programs.append(program)
        try:
            return program.wait_ready()
        except AssertionError as reason:
            raise NotPressing(reason) from reason

    def restart_driver(self):
        """Another driver for the one that ended."""
        self.driver.kill()
        self.programs.remove(self.driver)
        self.driver = self.start(self.driver_name)

    def wait_pressing(self, timeout_s=TIMEOUT_S):
        """Until the motors push steadily; with how much, N."""
        end = time.monotonic() + timeout_s
        while True:
            if time.monotonic() > end:
                raise NotPressing(f"no steady force within {timeout_s} s\n{self.driver.log()}")
            time.sleep(0.01)
            if self.state() == "FAULT":
                # A machine that is busy with other things for 20 ms is one for the device.
                self.enable()
            begin_ns = time.monotonic_ns() - 60_000_000
            lines = [line for line in self.record.since(begin_ns) if line.event == "command"]
            sizes = [line.size_n for line in lines]
            if len(lines) > 30 and min(sizes) >= PRESSING_N and max(sizes) - min(sizes) < 0.2:
                return sizes[-1]

    def wait_zero(self, since_ns, timeout_s=3.0):
        """The first line without any force from a time on."""
        end = time.monotonic() + timeout_s
        while True:
            zero = next((line for line in self.record.since(since_ns) if line.is_zero), None)
            if zero is not None:
                return zero
            last = self.record.lines[-1]
            assert time.monotonic() < end, f"not within {timeout_s} s of {since_ns}: {last}\n{self.driver.log()}"
            time.sleep(0.005)

    def check_device(self, lines):
        """The device's watchdog acts where nothing was done to the driver when the machine is too busy to be one."""
        if any(line.event == "watchdog" for line in lines):
            raise NotPressing("the machine was too busy for the device")

    def state(self):
        """The operating state last heard."""
        self.peer.spin(0.002)
        return self.states[-1].state if self.states else None

    def command(self, word):
        message = StringStamped(string=word)
        self.peer.publish(message, "state_command", reliable(10))

    def enable(self):
        """Clears a fault, as soon as what caused it is gone."""
        end = time.monotonic() + TIMEOUT_S
        while True:
            self.command("enable")
            self.peer.spin(0.05)
            if self.states and self.states[-1].state == "ENABLED":
                return
            assert time.monotonic() < end, f"not enabled: {self.states[-1:]}\n{self.driver.log()}"

    def close(self):
        for program in self.programs:
            # Who is killed cannot say goodbye, and is taken for alive by the others for a while.
            if program.process.poll() is None:
                program.process.terminate()
        for program in self.programs:
            try:
                program.process.wait(5.0)
            except subprocess.TimeoutExpired:
                program.kill()
        self.double.close()
