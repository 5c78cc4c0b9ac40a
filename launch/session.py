"""A session on a machine without `ros2 launch`: start the four nodes, watch them, sum up.

Called by launch/demo, which has set up the environment and checked the scene. A node that ends before its time ends
the session with its log and exit code 1. The summary is what the nodes report about themselves when they close.
"""

import argparse
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import ExternalShutdownException

REPOSITORY = Path(__file__).resolve().parent.parent
READY_TIMEOUT_S = 20.0
STOP_TIMEOUT_S = 10.0


class NodeProcess:
    """One node executable with its log file."""

    def __init__(self, executable, name, options, parameters, log_directory):
        self.name = name
        self.log_path = log_directory / f"{name}.log"
        command = [str(REPOSITORY / "target" / "release" / executable), "--ros-args", "-r", f"__node:={name}"]
        if options.namespace:
            command += ["-r", "__ns:=/" + options.namespace.strip("/")]
        command += ["--log-level", options.log_level, "--params-file", options.scene]
        for key, value in parameters.items():
            command += ["-p", f"{key}:={value}"]
        self.log = open(self.log_path, "wb")
        # A session of its own: Ctrl-C reaches this script only, which then ends the nodes in order.
        self.process = subprocess.Popen(
            command, stdout=self.log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True
        )

    def text(self):
        return self.log_path.read_text(errors="replace")

    def has_ended(self):
        return self.process.poll() is not None

    def interrupt(self):
        if not self.has_ended():
            self.process.send_signal(signal.SIGINT)

    def wait_or_kill(self, timeout_s):
        try:
            self.process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return f"{self.name} did not stop within {timeout_s:.0f} s of SIGINT and was killed"
        if self.process.returncode != 0:
            return f"{self.name} ended with exit code {self.process.returncode}"
        return None

    def closing_report(self):
        marker = "closing report: "
        for line in reversed(self.text().splitlines()):
            if marker in line:
                return json.loads(line.split(marker, 1)[1])
        return {}


class Monitor:
    """The newest diagnostics of each node, its statuses together, read by a thread of its own."""

    def __init__(self, namespace):
        self.prefix = "/" + namespace.strip("/") + "/" if namespace else "/"
        self.values = {}
        rclpy.init(args=[], signal_handler_options=rclpy.SignalHandlerOptions.NO)
        self.node = rclpy.create_node("session_monitor", namespace=namespace)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self.receive, 100)
        self.thread = threading.Thread(target=self.spin, name="monitor", daemon=True)
        self.thread.start()

    def receive(self, message):
        for status in message.status:
            node = status.name.split(":", 1)[0]
            if node.startswith(self.prefix):
                values = {entry.key: entry.value for entry in status.values}
                self.values.setdefault(node[len(self.prefix) :], {}).update(values)

    def spin(self):
        try:
            rclpy.spin(self.node)
        except ExternalShutdownException:
            pass

    def value(self, node, key, default="-"):
        return self.values.get(node, {}).get(key, default)

    def close(self):
        rclpy.shutdown()
        self.thread.join(2.0)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--duration", type=float, required=True, help="seconds")
    parser.add_argument("--scene", required=True, help="ROS parameter file")
    parser.add_argument("--mesh", default="", help="replaces body.mesh of the scene")
    parser.add_argument("--device", default="simulated", help="device backend")
    parser.add_argument("--namespace", default="")
    parser.add_argument("--name", required=True, help="of the recording and the log directory")
    parser.add_argument("--log", required=True, help="directory of the nodes' logs")
    parser.add_argument("--log-level", default="warn")
    parser.add_argument("--record", action="store_true")
    return parser.parse_args()


def start_nodes(options, log_directory):
    """Yield each node once it is ready, in the order in which the data will need them: the device comes last."""
    common = {"body.mesh": json.dumps(options.mesh)} if options.mesh else {}
    plan = [
        ("deformation", "deformation", {}),
        ("visualization", "visualization", {}),
        ("haptic_device", "haptic_device", {"device.backend": options.device}),
    ]
    if options.record:
        recorder = {
            "bag_replay.mode": "record",
            "recording.directory": json.dumps(str(REPOSITORY / "recordings")),
            "recording.name": json.dumps(options.name),
        }
        plan.insert(0, ("bag_replay", "recorder", recorder))
    for executable, name, parameters in plan:
        if name == "haptic_device":
            # Every reader of the poses must be there before the first pose is sent.
            parameters = {**parameters, "device.wait_for_readers": len(plan) - 1}
        node = NodeProcess(executable, name, options, {**common, **parameters}, log_directory)
        yield node
        deadline = time.monotonic() + READY_TIMEOUT_S
        while "ready:" not in node.text() and not node.has_ended() and time.monotonic() < deadline:
            time.sleep(0.02)


def live_line(monitor, elapsed_s, duration_s):
    """One line that says how the session runs."""
    rate = monitor.value("deformation", "rate_hz")
    depth = monitor.value("deformation", "depth_mm")
    force = monitor.value("deformation", "force_n")
    latency = monitor.value("haptic_device", "latency_median_us")
    return (
        f"{elapsed_s:5.1f} / {duration_s:.1f} s   poses {rate} Hz   depth {depth} mm   force {force} N"
        f"   latency {latency} us"
    )


def summary(reports, options):
    """The closing reports as a short plain-text table."""
    device, model = reports.get("haptic_device", {}), reports.get("deformation", {})
    recorder, view = reports.get("recorder", {}), reports.get("visualization", {})
    latency = device.get("latency_us") or {}

    def number(source, key, digits=0):
        value = source.get(key)
        return "-" if value is None else f"{value:.{digits}f}"

    lines = [
        "session summary",
        f"  poses sent            {number(device, 'poses')}   ({number(device, 'pose_rate_hz', 1)} Hz)",
        f"  forces received       {number(device, 'forces')}   ({number(device, 'force_rate_hz', 1)} Hz)",
        f"  poses unanswered      {number(device, 'unanswered')}",
        f"  poses rejected        {number(model, 'rejected')}",
        f"  surfaces published    {number(model, 'surfaces')}",
        f"  markers published     {number(view, 'markers')}",
        f"  peak depth            {number(model, 'peak_depth_mm', 2)} mm",
        f"  peak force            {number(model, 'peak_force_n', 3)} N",
        f"  pose to force         median {number(latency, 'median')} us, p99 {number(latency, 'p99')} us, "
        f"max {number(latency, 'max')} us",
        f"  answered in           median {number(model, 'step_median_us', 1)} us, p99 {number(model, 'step_p99_us', 1)} us "
        "(in the model node: pose taken to force sent)",
        f"  missed deadlines      {number(device, 'missed_deadlines')} (force later than one period), "
        f"{number(device, 'late_ticks')} late ticks of the motor loop",
    ]
    if options.record:
        lines.append(f"  messages recorded     {number(recorder, 'messages')}")
        lines.append(f"recording: recordings/{options.name}")
    else:
        lines.append("recording: none (--no-record)")
    return "\n".join(lines)


def stop(nodes):
    """End the nodes, the source of data first and the recorder last; return what went wrong."""
    problems = []
    for node in reversed(nodes):
        node.interrupt()
        problem = node.wait_or_kill(STOP_TIMEOUT_S)
        if problem:
            problems.append((node, problem))
    return problems


def main():
    options = parse_arguments()
    log_directory = Path(options.log)
    interrupted = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: interrupted.set())

    monitor = Monitor(options.namespace)
    nodes = []
    dead = None
    try:
        for node in start_nodes(options, log_directory):
            nodes.append(node)
        start = time.monotonic()
        live = sys.stdout.isatty()
        next_line_s = 0.0
        while dead is None and not interrupted.is_set():
            elapsed_s = time.monotonic() - start
            dead = next((node for node in nodes if node.has_ended()), None)
            if elapsed_s >= options.duration:
                break
            if elapsed_s >= next_line_s:
                end = "\r" if live else "\n"
                print(live_line(monitor, elapsed_s, options.duration), end=end, flush=True)
                next_line_s += 0.5 if live else 2.0
            time.sleep(0.05)
    finally:
        problems = stop([node for node in nodes if node is not dead])
        monitor.close()
    print()
    if dead is not None:
        problems.insert(0, (dead, f"{dead.name} ended by itself with exit code {dead.process.returncode}"))
    for node, problem in problems:
        print(f"demo: {problem}; its log ({node.log_path}):", file=sys.stderr)
        print("\n".join("  " + line for line in node.text().splitlines()[-30:]), file=sys.stderr)
    if problems:
        return 1
    print(summary({node.name: node.closing_report() for node in nodes}, options))
    return 0


if __name__ == "__main__":
    os.chdir(REPOSITORY)
    sys.exit(main())
