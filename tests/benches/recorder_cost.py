"""What the recorder costs: processor time of each of its threads while a session is published; `--csv FILE` keeps it.

    . launch/ros2_env.sh && cargo build --release -p bag_replay
    "$RHOMBUS_PYTHON" tests/benches/recorder_cost.py --csv recorder_cost.csv

Poses and forces at 1 kHz and surfaces of 3000 vertices at 60 Hz come from tests/recordings/numbered_publisher.py. The recorder
records every topic of a session, as it does by default, so that the silent ones cost what they cost.
"""

import argparse
import json
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
PUBLISHER = REPOSITORY / "tests" / "recordings" / "numbered_publisher.py"
SCENARIOS = {
    "silence": [],
    "poses": ["measured_cp"],
    "poses_forces_surfaces": ["measured_cp", "servo_cf", "surface_displacement"],
    "six_at_1khz_and_surfaces": ["measured_cp", "measured_cv", "measured_cf", "servo_cf", "contact_state",
                                 "contact_law_copy", "surface_displacement"],
}  # fmt: skip
TICK_S = 1 / os.sysconf("SC_CLK_TCK")
SETTLE_S = 3.0


def machine():
    model = next(
        line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line
    )
    return f"{model}, {os.cpu_count()} CPUs, Linux {os.uname().release}; load at the start {os.getloadavg()[0]:.1f}"


def threads(process):
    """Name and processor seconds (user, system) of each thread."""
    found = {}
    for folder in Path(f"/proc/{process.pid}/task").iterdir():
        text = (folder / "stat").read_text()
        fields = text.rsplit(")", 1)[1].split()
        name = text[text.index("(") + 1 : text.rindex(")")]
        found[folder.name] = (name.rstrip("0123456789."), int(fields[11]) * TICK_S, int(fields[12]) * TICK_S)
    return found


def measure(program, topics, seconds, folder):
    """Percent of a core by the name of the thread, messages in a second, whether everything that was sent was recorded."""
    names = [name for name in topics if name == "contact_law_copy"]
    extra = f"\n    recording.topics: {json.dumps(topics)}" if names else ""
    parameters = folder / "recorder.yaml"
    parameters.write_text(
        f"/**:\n  ros__parameters:\n    recording.directory: {folder}\n    recording.name: session{extra}\n"
    )
    log = folder / "log"
    recorder = subprocess.Popen([program, "--ros-args", "--params-file", parameters], stderr=log.open("wb"))
    publisher = None
    try:
        while "ready:" not in log.read_text():
            if recorder.poll() is not None:
                sys.exit(log.read_text())
            time.sleep(0.01)
        if topics:
            count = str(round(1000 * (seconds + 2 * SETTLE_S)))
            publisher = subprocess.Popen(
                [sys.executable, PUBLISHER, count, *topics], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
        time.sleep(SETTLE_S)
        begin, before = time.monotonic(), threads(recorder)
        time.sleep(seconds)
        elapsed, after = time.monotonic() - begin, threads(recorder)
        said = json.loads(publisher.stdout.readline()) if publisher else {"sent": {}, "seconds": 1.0}
        time.sleep(0.3)
        recorder.send_signal(signal.SIGINT)
        if recorder.wait(30) != 0:
            sys.exit(log.read_text())
    finally:
        recorder.kill()
        if publisher:
            publisher.communicate("end\n")
    report = json.loads(log.read_text().split("closing report: ", 1)[1].splitlines()[0])
    complete = all(report["topics"].get(f"/{name}") == number for name, number in said["sent"].items())
    rate = sum(said["sent"].values()) / said["seconds"]
    percent = {}
    for thread, (name, user, system) in after.items():
        _, user_before, system_before = before.get(thread, (name, 0.0, 0.0))
        user_sum, system_sum = percent.get(name, (0.0, 0.0))
        percent[name] = (
            user_sum + 100 * (user - user_before) / elapsed,
            system_sum + 100 * (system - system_before) / elapsed,
        )
    return percent, rate, complete


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=REPOSITORY / "target" / "release" / "bag_replay", type=Path)
    parser.add_argument("--label", default="recorder", help="first column of the CSV file")
    parser.add_argument("--seconds", default=10.0, type=float, help="measured time of each run")
    parser.add_argument("--runs", default=3, type=int)
    parser.add_argument("--csv", type=Path, help="appends; the machine is named before the first row")
    options = parser.parse_args()
    os.environ.setdefault("ROS_DOMAIN_ID", str(60 + os.getpid() % 30))
    # As in a session: kept to this machine, the middleware would add shared memory by itself.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SUBNET"
    lines = []
    if options.csv is None or not options.csv.exists():
        lines += [f"# {machine()}", "# processor time in percent of one core, by thread; messages_per_s is what a busy machine let the publisher send; complete: nothing was lost"]
        lines += ["label,scenario,run,messages_per_s,thread,user_percent,system_percent,complete"]
    for scenario, topics in SCENARIOS.items():
        totals = []
        for run in range(1, options.runs + 1):
            with tempfile.TemporaryDirectory() as folder:
                percent, rate, complete = measure(options.program, topics, options.seconds, Path(folder))
            percent["total"] = tuple(map(sum, zip(*percent.values())))
            totals.append(sum(percent["total"]))
            rows = sorted(percent.items())
            lines += [
                f"{options.label},{scenario},{run},{rate:.0f},{name},{user:.2f},{system:.2f},{int(complete)}"
                for name, (user, system) in rows
                if user + system >= 0.1 or name == "total"
            ]
        print(f"{scenario}: {statistics.median(totals):.1f} % of a core (runs: {', '.join(f'{t:.1f}' for t in totals)})")
    if options.csv:
        with options.csv.open("a") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
