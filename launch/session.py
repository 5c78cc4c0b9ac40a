"""A session on a machine without `ros2 launch`: start the nodes, watch them, sum up.

Called by launch/demo, which has set up the environment and built the nodes. Exit code 2 for an option or a scene that is
not accepted, before anything starts. A node that cannot start or ends before its time ends the session with what it said
and exit code 1; of several drivers one may end and the others go on. The summary is what the nodes report about
themselves when they close.
"""

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import ExternalShutdownException

from session_plan import PROGRAMS, REPOSITORY, Plan, Refused
from session_report import live_line, summary

READY_TIMEOUT_S = 20.0
STOP_TIMEOUT_S = 10.0
# A session without a real device ends by itself.
SIMULATED_DURATION_S = 15.0
VIEWER_LINE = re.compile(r"\bviewer: (https?://\S+|from other machines .*)$", re.MULTILINE)
ERROR_LINE = re.compile(r"^\[(?:ERROR|FATAL)\](?: \[[^\]]*\])*: (.*)$", re.MULTILINE)


class NodeProcess:
    """One node executable with its log file."""

    def __init__(self, plan, options, log_directory):
        self.label = plan.label
        self.log_path = log_directory / f"{plan.full_name.removeprefix(options.namespace_prefix).replace('/', '_')}.log"
        command = [str(PROGRAMS / plan.executable), *plan.arguments(options.scene, options.log_level)]
        # A calibrated body reads a large table far apart; in large pages it is found sooner (README, "A calibrated organ").
        pages = {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"} if plan.executable == "deformation" else {}
        # A session of its own: Ctrl-C reaches this script only, which then ends the nodes in order.
        with open(self.log_path, "wb") as log:
            self.process = subprocess.Popen(
                command,
                stdout=log,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                env={**pages, **os.environ},
                start_new_session=True,
            )

    def text(self):
        return self.log_path.read_text(errors="replace")

    def is_ready(self):
        return "ready:" in self.text()

    def viewer(self):
        """Where the page is that the node serves, one line for each way to it; none when it serves none."""
        return VIEWER_LINE.findall(self.text())

    def has_ended(self):
        return self.process.poll() is not None

    def interrupt(self):
        if not self.has_ended():
            self.process.send_signal(signal.SIGINT)

    def wait_or_kill(self, timeout_s):
        """None, or what was wrong with the node's end."""
        try:
            self.process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return self.problem(f"did not stop within {timeout_s:.0f} s of SIGINT and was killed")
        code = self.process.returncode
        # Before a node is ready the signal may come before its handler.
        if code == 0 or (code == -signal.SIGINT and not self.is_ready()):
            return None
        return self.problem(f"ended with exit code {code}")

    def problem(self, what):
        """For people: the errors that the node logged; without any, what happened and the end of its log."""
        errors = ERROR_LINE.findall(self.text())
        if errors and self.process.returncode == 1:
            return "\n".join(f"demo: {self.label}: {error}" for error in dict.fromkeys(errors[-3:]))
        end = ["  " + line for line in self.text().splitlines()[-30:]]
        return "\n".join([f"demo: {self.label} {what}; its log ({self.log_path}):", *end])

    def closing_report(self):
        marker = "closing report: "
        for line in reversed(self.text().splitlines()):
            if marker in line:
                return json.loads(line.split(marker, 1)[1])
        return {}


class Monitor:
    """The newest diagnostics of each node, read by a thread of its own."""

    def __init__(self, namespace):
        self.prefix = namespace.rstrip("/")
        self.values = {}
        rclpy.init(args=[], signal_handler_options=rclpy.SignalHandlerOptions.NO)
        self.node = rclpy.create_node("session_monitor", namespace=namespace)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self.receive, 100)
        self.thread = threading.Thread(target=self.spin, name="monitor", daemon=True)
        self.thread.start()

    def receive(self, message):
        for status in message.status:
            node, _, subject = status.name.partition(": ")
            values = {entry.key: entry.value for entry in status.values}
            self.values.setdefault(node, {})[subject] = values

    def spin(self):
        try:
            rclpy.spin(self.node)
        except ExternalShutdownException:
            pass

    def value(self, node, key, subject=None):
        """Of a node (a full name, or one relative to the session) and a subject; without one, whichever has the key."""
        subjects = self.values.get(node if node.startswith("/") else f"{self.prefix}/{node}", {})
        found = [subjects.get(subject, {})] if subject else list(subjects.values())
        return next((values[key] for values in found if key in values), "-")

    def close(self):
        rclpy.shutdown()
        self.thread.join(2.0)


class Session:
    """The processes of a session, from the first to the last."""

    def __init__(self, plan, options):
        self.plan, self.options = plan, options
        self.log_directory = Path(options.log)
        self.drivers, self.others = [], []
        self.problems, self.lost = [], []
        self.interrupted = threading.Event()
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda *_: self.interrupted.set())

    def start_node(self, plan):
        return NodeProcess(plan, self.options, self.log_directory)

    def start(self):
        """Start everything; whether it is all there. What cannot start, a device that is not there first of all, is
        known before anything is recorded. The drivers send their first pose when all that read poses are there."""
        readers = 3 if self.options.record else 2
        self.drivers = [self.start_node(plan) for plan in self.plan.drivers(readers)]
        self.others = [self.start_node(self.plan.node(name)) for name in ("deformation", "visualization")]
        if not self.wait_ready(self.others):
            return False
        if self.options.record:
            parameters = [
                ("bag_replay.mode", "record"),
                ("recording.directory", json.dumps(str(REPOSITORY / "recordings"))),
                ("recording.name", json.dumps(self.options.name)),
            ]
            recorder = self.start_node(self.plan.node("bag_replay", "recorder", parameters))
            # In front, so that it ends last.
            self.others.insert(0, recorder)
            if not self.wait_ready([recorder]):
                return False
        return self.wait_ready(self.drivers)

    def wait_ready(self, nodes):
        """Until these nodes are ready; false when one of the session has ended, is too late or the user has had enough."""
        deadline = time.monotonic() + READY_TIMEOUT_S
        while not all(node.is_ready() for node in nodes):
            ended = [node for node in [*self.drivers, *self.others] if node.has_ended()]
            late = [node for node in nodes if not node.is_ready()] if time.monotonic() >= deadline else []
            self.problems += [node.problem(f"ended with exit code {node.process.returncode}") for node in ended]
            self.problems += [node.problem(f"was not ready within {READY_TIMEOUT_S:.0f} s") for node in late]
            if self.problems or self.interrupted.is_set():
                return False
            time.sleep(0.02)
        return True

    def tell_viewer(self):
        """Say where to look, and where to press with the mouse."""
        addresses = [address for node in self.others for address in node.viewer()]
        for address in addresses:
            print(f"viewer: {address}", flush=True)
        if self.plan.has_pointer:
            print(
                "drag presses the organ, Shift-drag holds and pulls it, Ctrl-C ends the session"
                if addresses
                else "no page is served (viewer.enabled, or a build without the viewer): publish pointer_target to lead the hand",
                flush=True,
            )

    def run(self, monitor):
        """Until the time is up, the user ends it, or a node that the session needs is gone."""
        start = time.monotonic()
        live = sys.stdout.isatty()
        next_line_s = 0.0
        while not self.interrupted.is_set():
            elapsed_s = time.monotonic() - start
            if not self.is_whole() or (self.options.duration is not None and elapsed_s >= self.options.duration):
                break
            if elapsed_s >= next_line_s:
                line = live_line(self.plan, monitor, elapsed_s, self.options.duration)
                print(line, end="\r" if live else "\n", flush=True)
                next_line_s += 0.5 if live else 2.0
            time.sleep(0.05)
        print()

    def is_whole(self):
        """Whether the session can go on. A driver that has ended leaves the other devices at work."""
        for node in [node for node in [*self.drivers, *self.others] if node.has_ended()]:
            problem = node.problem(f"ended by itself with exit code {node.process.returncode}")
            if node in self.others or len(self.drivers) == 1:
                self.problems.append(problem)
                return False
            print(f"\n{problem}\ndemo: the session goes on without {node.label}", file=sys.stderr, flush=True)
            self.drivers.remove(node)
            self.lost.append(node.label)
        return True

    def stop(self):
        """End the nodes: all drivers first, so that the motors are off, then in the order of the data; the recorder is the
        last. Their closing reports, by label."""
        nodes = [*self.drivers, *reversed(self.others)]
        already_gone = {node.label for node in nodes if node.has_ended()}
        for node in self.drivers:
            node.interrupt()
        for node in nodes:
            # A second signal would make a driver leave in a hurry.
            if node in self.others:
                node.interrupt()
            problem = node.wait_or_kill(STOP_TIMEOUT_S)
            if problem and node.label not in already_gone:
                self.problems.append(problem)
        return {node.label: node.closing_report() for node in nodes}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--duration", type=float, help="seconds")
    parser.add_argument("--scene", required=True, help="ROS parameter file")
    parser.add_argument("--mesh", default="", help="replaces body.mesh of the scene")
    parser.add_argument("--device", action="append", default=[], help="[NAME=]BACKEND[:SERIAL], for each device")
    parser.add_argument("--set", action="append", default=[], help="[NAME/]KEY=VALUE, in place of the scene's value")
    parser.add_argument("--namespace", default="")
    parser.add_argument("--name", required=True, help="of the recording and the log directory")
    parser.add_argument("--log", required=True, help="directory of the nodes' logs")
    parser.add_argument("--log-level", default="warn")
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    options.namespace_prefix = "/" + options.namespace.strip("/") + "/" if options.namespace.strip("/") else "/"
    return options


def main():
    options = parse_arguments()
    try:
        plan = Plan(options)
    except Refused as refused:
        print(f"demo: {refused}", file=sys.stderr)
        return 2
    Path(options.log, "explain.txt").write_text("\n".join(plan.explanations))
    if options.duration is None and plan.has_only_simulated_devices:
        options.duration = SIMULATED_DURATION_S

    session = Session(plan, options)
    monitor = Monitor(plan.namespace)
    reports, started = {}, False
    try:
        started = session.start()
        if started:
            session.tell_viewer()
            session.run(monitor)
    finally:
        reports = session.stop()
        monitor.close()
    if not started and options.record:
        # Nothing of a device is in it.
        shutil.rmtree(REPOSITORY / "recordings" / options.name, ignore_errors=True)
    if session.problems:
        print("\n".join(session.problems), file=sys.stderr)
        return 1
    if not started:
        return 0
    print(summary(plan, reports, options.name if options.record else ""))
    return 1 if session.lost else 0


if __name__ == "__main__":
    os.chdir(REPOSITORY)
    sys.exit(main())
