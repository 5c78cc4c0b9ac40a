"""The faults: what is done to which part of a session, how long the force may then last, and how the session goes on.

Limits are from the moment of the fault to the motors' first zero, ms:

- the driver's process or its motor loop stands still: the device's own watchdog (serial 20, Force Dimension 31.25, Haply 20);
- a contact law is not renewed: its validity of at most 100 and a fall of 30 (`safety.law_validity`, `safety.decay`);
- a commanded force is not renewed: 50 after the last one, of which 20 are its validity and 30 the fall;
- the driver ends by itself, in whatever way: at the slew limit, 10 for 20 N, after at most 10 until a signal is seen.

`SLACK_MS` on top is for what no limit of the product contains: the delivery of the signal and the device's own clock.
"""

import signal
import time
from dataclasses import dataclass
from typing import Callable

from std_msgs.msg import Empty

import peer as graph
from processors import Processors
from record import change_n
from rig import NotPressing
from threads import Hang

SLACK_MS = 15.0
WATCHDOG_MS = {"serial": 20.0, "force_dimension": 31.25, "haply": 20.0}
LAW_MS = 100.0 + 30.0
SERVO_MS = 20.0 + 30.0
END_MS = 10.0 + 10.0
# The message that tells the driver to panic may take so long on a busy machine.
DELIVERY_MS = 200.0
PERIOD_NS = 1_000_000
SLEW_STEP_N = 2.0  # safety.slew, 2000 N/s, in a period of 1 ms
ROUNDING_N = 1e-4  # the serial line carries single precision
UNCHANGED_N = 0.1
# How long the force must stay away after it has gone, s.
QUIET_S = 0.03
# How long the force is watched when it comes back, s.
BACK_S = 0.1


@dataclass(frozen=True)
class Fault:
    """One way to break a session."""

    part: str
    what: str
    # Called with the rig, gives two functions: one that breaks it and returns when it did, by the monotonic clock, ns, and
    # one that ends the fault.
    arm: Callable
    # Watchdog, stale or end: whose limit counts.
    limit: str
    # What has to be done before the hand is pushed again: nothing, or what has to be started anew: driver or session.
    heal: str = "nothing"
    driver: str = "haptic_device"
    # On top of the limit, ms.
    slack_ms: float = SLACK_MS
    # Whether a single step may take the force away: where nobody is left who could let it fall.
    may_step: bool = False

    @property
    def name(self):
        return f"{self.part}: {self.what}"

    def limit_ms(self, backend, force_source):
        return {
            "watchdog": WATCHDOG_MS[backend],
            "stale": LAW_MS if force_source == "contact_law" else SERVO_MS,
            "end": END_MS,
        }[self.limit]


def nothing():
    pass


def send(part, *numbers):
    """Signals to a part's process, one after the other; the last one counts."""

    def arm(rig):
        process = getattr(rig, part).process

        def strike():
            for number in numbers:
                begin_ns = time.monotonic_ns()
                process.send_signal(number)
            return begin_ns

        return strike, nothing

    return arm


def stop(part):
    """SIGSTOP, until the end."""

    def arm(rig):
        strike, _ = send(part, signal.SIGSTOP)(rig)
        return strike, lambda: getattr(rig, part).process.send_signal(signal.SIGCONT)

    return arm


def hang(part, thread=None):
    """One thread stands still, until the end."""

    def arm(rig):
        hung = Hang(getattr(rig, part).process.pid, thread)

        def strike():
            begin_ns = time.monotonic_ns()
            hung.begin()
            return begin_ns

        return strike, hung.end

    return arm


def panic_in_the_nodes_thread(rig):
    publisher = rig.peer.node.create_publisher(Empty, "panic", graph.reliable(10))
    rig.peer.wait_for(lambda: publisher.get_subscription_count() > 0, "a reader of panic")

    def strike():
        begin_ns = time.monotonic_ns()
        publisher.publish(Empty())
        return begin_ns

    return strike, nothing


def died(part, number):
    return Fault(part, signal.Signals(number).name, send(part, number), "stale", "session")


def panicked(what, arm, heal="driver", **options):
    return Fault("driver", f"panic {what}", arm, "end", heal, driver="panicking_driver", **options)


DRIVER_STANDS_STILL = [
    Fault("driver", "SIGKILL", send("driver", signal.SIGKILL), "watchdog", "driver", may_step=True),
    Fault("driver", "SIGSTOP", stop("driver"), "watchdog", may_step=True),
    Fault("driver", "motor loop hangs", hang("driver", "motor_loop"), "watchdog", may_step=True),
]
DRIVER_IN_PARTS = [
    Fault("driver", "ROS thread hangs", hang("driver"), "stale"),
    Fault("driver", "publisher thread hangs", hang("driver", "publisher"), "stale"),
]
DRIVER_ENDS = [
    Fault("driver", "SIGTERM", send("driver", signal.SIGTERM), "end", "driver"),
    Fault("driver", "SIGHUP", send("driver", signal.SIGHUP), "end", "driver"),
    Fault("driver", "SIGINT twice", send("driver", signal.SIGINT, signal.SIGINT), "end", "driver"),
    Fault("driver", "SIGABRT", send("driver", signal.SIGABRT), "end", "driver"),
]
DRIVER_PANICS = [
    panicked("in a thread of its own", send("driver", signal.SIGUSR1)),
    # Anew each time: a publisher takes the readers of a driver that died for alive for a while.
    panicked("in the ROS thread", panic_in_the_nodes_thread, "session", slack_ms=DELIVERY_MS),
    panicked("in the motor loop", send("driver", signal.SIGUSR2), may_step=True),
]
MODEL_STANDS_STILL = [
    Fault("model", "SIGSTOP", stop("model"), "stale"),
    Fault("model", "its thread hangs", hang("model"), "stale"),
]
# A panic ends the process at once, as an abort does.
MODEL_ENDS = [died("model", signal.SIGKILL), died("model", signal.SIGABRT), died("model", signal.SIGTERM)]


def listener(executable, what, arm):
    """Breaks who only listens. Starts it when it is needed, and again after it died."""

    def arm_it(rig):
        program = getattr(rig, executable, None)
        if program is None or program.process.poll() is not None:
            # The tests keep discovery to this machine, where the middleware adds shared memory by itself; who only listens
            # listens as in a session.
            setattr(rig, executable, rig.start(executable, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}))
            rig.peer.wait_for(lambda: rig.peer.node.count_subscribers("contact_state") > 0, "who listens")
        return arm(executable)(rig)

    return Fault({"bag_replay": "recorder"}.get(executable, executable), what, arm_it, "never")


def sent(number):
    return lambda part: send(part, number)


BYSTANDERS = [
    listener("visualization", "SIGKILL", sent(signal.SIGKILL)),
    listener("visualization", "SIGABRT", sent(signal.SIGABRT)),
    listener("visualization", "SIGSTOP", stop),
    listener("visualization", "its thread hangs", hang),
    listener("bag_replay", "SIGKILL", sent(signal.SIGKILL)),
    listener("bag_replay", "SIGSTOP", stop),
]


@dataclass(frozen=True)
class Change:
    """How much the force changed although nothing should have."""

    force_n: float
    change_n: float


def stand_by(rig, fault, seconds=5.0):
    """Breaks somebody who has no part in the force, and watches it: for longer than queues take to fill."""
    rig.wait_pressing()
    strike, end = fault.arm(rig)
    force_n = rig.wait_pressing()
    processors = Processors()
    begin_ns = strike()
    try:
        processors.watch(seconds)
        lines = rig.record.since(begin_ns)
    finally:
        end()
    rig.check_device(lines)
    changed = next((line for line in lines if abs(line.size_n - force_n) > UNCHANGED_N), None)
    # No law within its validity, and nobody is in the way but the machine itself.
    if changed and processors.were_busy(changed.t_ns - LAW_MS * graph.MS, changed.t_ns):
        raise NotPressing("the machine had no time left for a contact law")
    return Change(force_n, max(abs(line.size_n - force_n) for line in lines))


@dataclass(frozen=True)
class Result:
    """What one run showed."""

    force_n: float  # before the fault
    zero_ms: float
    event: str  # what took the last of the force away
    step_n: float  # the largest step of the force on its way to zero
    back_step_n: float  # the largest step after the fault has ended, where the part goes on
    limit_ms: float


def run(rig, fault):
    """Breaks a pressing session once, waits until the force is gone, and ends the fault."""
    rig.wait_pressing()
    strike, end = fault.arm(rig)
    force_n = rig.wait_pressing()
    begin_ns = strike()
    try:
        zero = rig.wait_zero(begin_ns)
        time.sleep(QUIET_S)
        lines = rig.record.since(begin_ns)
    finally:
        end()
    fallen = lines.index(zero)
    assert all(line.is_zero for line in lines[fallen:]), f"{fault.name}: the force came back during the fault"
    way = [line for line in rig.record.lines if line.t_ns < begin_ns][-1:] + lines[: fallen + 1]
    if fault.heal == "nothing":
        time.sleep(BACK_S)
    back = rig.record.since(zero.t_ns)
    backend, source = rig.values["device.backend"], rig.values.get("device.force_source", "contact_law")
    rig.record.forget(begin_ns)
    return Result(
        force_n,
        (zero.t_ns - begin_ns) * 1e-6,
        zero.event,
        largest_step_n(way),
        largest_commanded_step_n(back),
        fault.limit_ms(backend, source),
    )


def largest_step_n(lines):
    return max((change_n(before, line) for before, line in zip(lines, lines[1:])), default=0.0)


def largest_commanded_step_n(lines):
    """The largest step from one command of the driver to the next. What the device does by itself is no step of the driver's. A
    line that was held up keeps the newest command only, which may be as far from the last one that came as those in between
    would have brought it: a device that numbers commands knows how many they were, others only the time that went by."""
    largest_n, earlier_ns = 0.0, None
    for before, line in zip(lines, lines[1:]):
        if line.t_ns > before.t_ns:
            earlier_ns = before.t_ns
        if line.event == "command" and earlier_ns is not None:
            periods = max(line.commands - before.commands, round((line.t_ns - earlier_ns) / PERIOD_NS))
            largest_n = max(largest_n, change_n(before, line) / periods)
    return largest_n


def holds(result, fault):
    """Whether a run stayed within its limits."""
    if fault.limit == "never":
        return result.change_n <= UNCHANGED_N
    step_n = result.back_step_n if fault.may_step else max(result.step_n, result.back_step_n)
    return result.zero_ms <= result.limit_ms + fault.slack_ms and step_n <= SLEW_STEP_N + ROUNDING_N


def heal(rig, fault):
    """Makes the session able to press again. False when it has to be started anew."""
    if fault.heal == "session":
        return False
    try:
        if fault.heal == "driver":
            rig.restart_driver()
    except NotPressing:
        return False
    return True
