"""How fast a recording is replayed, and in how much memory; `--csv FILE` keeps every run.

    . launch/ros2_env.sh && cargo build --release -p rhombus_cli -p bag_replay -p deformation
    cargo build --release -p rhombus_cli --example make_bags && cargo build --release -p recording --example read_speed
    "$RHOMBUS_PYTHON" tests/benches/replay_speed.py --csv replay_speed.csv [--hour]

Without ROS: surfaces at 60 Hz beside forces only beside reading alone (the baseline), alternating. `--hour` adds recordings of
one minute and of one hour, each replayed, recorded anew and compared, for the memory. Lockstep over DDS: poses in a second
through `bag_replay` and `deformation`.
"""

import argparse
import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
PROGRAMS = REPOSITORY / "target" / "release"
SCENE = REPOSITORY / "config" / "liver.yaml"
FORCES_ONLY = ["--set", "surface.rate=0.0"]
HEADER = "case,run,poses,surfaces,recorded_s,elapsed_s,times_real_time,peak_rss_mib"


def machine():
    model = next(
        line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line
    )
    return f"{model}, {os.cpu_count()} CPUs, Linux {os.uname().release}; load at the start {os.getloadavg()[0]:.1f}"


def run(*command):
    """What a program says, and the most memory it had, MiB."""
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True, cwd=REPOSITORY)
    said = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"{command}: {said}")
    return said, usage.ru_maxrss / 1024


def replay(recording, *more):
    said, peak_mib = run(PROGRAMS / "rhombus", "replay", recording, "--params", SCENE, "--json", *more)
    report = json.loads(said)
    return report["poses"], report["surfaces"], report["recorded_s"], report["elapsed_s"], peak_mib


def read(recording, recorded_s):
    said, peak_mib = run(PROGRAMS / "examples" / "read_speed", recording)
    count, seconds = re.search(r"; (\d+) messages of .* in ([\d.]+) s", said).groups()
    return int(count), 0, recorded_s, float(seconds), peak_mib


def lockstep(recording, folder):
    """Poses in a second of a replay over DDS, and how long it took."""
    folder.mkdir()
    values = {"bag_replay.mode": "play", "replay.path": str(recording), "replay.lockstep": True}
    values |= {"replay.wait_for_subscribers": 10.0}
    lines = SCENE.read_text().rstrip() + "\n" + "".join(f"    {name}: {json.dumps(value)}\n" for name, value in values.items())
    parameters = folder / "parameters.yaml"
    parameters.write_text(lines)
    model, player = (
        subprocess.Popen(
            [PROGRAMS / name, "--ros-args", "--params-file", parameters], stderr=(folder / name).open("wb"), cwd=REPOSITORY
        )
        for name in ("deformation", "bag_replay")
    )
    try:
        if player.wait(600) != 0:
            sys.exit((folder / "bag_replay").read_text())
        model.send_signal(signal.SIGINT)
        model.wait(30)
    finally:
        player.kill()
        model.kill()
    report = json.loads((folder / "bag_replay").read_text().split("closing report: ", 1)[1].splitlines()[0])["lockstep"]
    return report["poses"], report["pose_rate_hz"]


class Table:
    def __init__(self, csv):
        self.csv, self.ratios, self.lines = csv, {}, []

    def add(self, case, number, row):
        poses, surfaces, recorded_s, elapsed_s, peak_mib = row
        ratio = recorded_s / elapsed_s
        self.ratios.setdefault(case, []).append((ratio, peak_mib))
        self.lines.append(
            f"{case},{number},{poses},{surfaces},{recorded_s:.3f},{elapsed_s:.4f},{ratio:.1f},{peak_mib:.1f}"
        )

    def close(self, started_on):
        for case, rows in self.ratios.items():
            ratios = [ratio for ratio, _ in rows]
            print(
                f"{case}: {statistics.median(ratios):.0f} x real time (runs: "
                f"{', '.join(f'{ratio:.0f}' for ratio in ratios)}), at most {max(peak for _, peak in rows):.0f} MiB"
            )
        if self.csv:
            self.csv.write_text("\n".join([f"# {started_on}", HEADER, *self.lines]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", default=60, type=int, help="length of the recording")
    parser.add_argument("--runs", default=5, type=int)
    parser.add_argument("--hour", action="store_true", help="memory of a minute beside that of an hour")
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    os.environ.setdefault("ROS_DOMAIN_ID", str(60 + os.getpid() % 30))
    # As in a session: kept to this machine, the middleware would add shared memory by itself.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SUBNET"
    started_on, table = machine(), Table(options.csv)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def recording(seconds):
            path = folder / f"{seconds}_s"
            if path.exists():
                return path / "session"
            run(PROGRAMS / "examples" / "make_bags", path, seconds)
            return path / "session"

        one = recording(options.seconds)
        for number in range(1, options.runs + 1):
            table.add("surfaces_60hz", number, replay(one))
            table.add("forces_only", number, replay(one, *FORCES_ONLY))
            table.add("reading_alone", number, read(one, options.seconds))
        for number in range(1, options.runs + 1):
            start = time.monotonic()
            poses, rate_hz = lockstep(one, folder / f"lockstep_{number}")
            elapsed_s = poses / rate_hz
            table.add("lockstep_over_dds", number, (poses, 0, options.seconds, elapsed_s, 0.0))
            print(f"lockstep run {number}: {rate_hz:.0f} poses/s, whole run {time.monotonic() - start:.1f} s")
        for seconds in (60, 3600) if options.hour else ():
            long = recording(seconds)
            golden = folder / f"golden_{seconds}"
            table.add(f"record_{seconds}_s", 1, replay(long, "--record", golden))
            table.add(f"compare_{seconds}_s", 1, replay(long, "--expect", golden))
    table.close(started_on)


if __name__ == "__main__":
    main()
