"""What the viewer costs: updates that pages get, processor time and memory of the node, bytes; `--csv FILE` keeps it.

    . launch/ros2_env.sh && cargo build --release -p haptic_device -p deformation -p visualization -p rhombus_cli
    "$RHOMBUS_PYTHON" tests/benches/viewer_load.py --csv viewer_load.csv

The simulated hand presses the generated liver while pages read in a process of their own; without a page is the baseline. What a
busy machine does not let the driver and the model do is not sent: the rate of the surfaces that the model published stands beside
what a page got.
"""

import argparse
import json
import multiprocessing
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
sys.path.insert(0, str(REPOSITORY / "tests" / "graph"))
TICK_S = 1 / os.sysconf("SC_CLK_TCK")
SETTLE_S = 4.0


def machine():
    model = next(
        line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line
    )
    return f"{model}, {os.cpu_count()} CPUs, Linux {os.uname().release}; load at the start {os.getloadavg()[0]:.1f}"


def processor_s(process):
    fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * TICK_S


def resident_mb(process):
    text = Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+) kB", text)[1]) / 1024


def read_pages(port, pages, begin, seconds, results):
    """What each of the pages gets in the time, from when `begin` is set."""
    from websocket import SURFACE, STATE, Page

    opened = [Page(port) for _ in range(pages)]
    while not begin.is_set():
        for page in opened:
            page.poll()
        time.sleep(0.002)
    for page in opened:
        page.bytes = 0
        page.shown[SURFACE].clear()
        page.shown[STATE].clear()
    begun = time.monotonic()
    while time.monotonic() - begun < seconds:
        for page in opened:
            page.poll()
        time.sleep(0.002)
    elapsed = time.monotonic() - begun
    # The hand does not always touch: while it does, one surface follows the other.
    times = [when for when, _ in opened[0].shown[SURFACE]]
    moving_s = [later - when for when, later in zip(times, times[1:]) if later - when < 0.1]
    touched = [len(page.surface(index)[2]) for page in opened[:1] for index in range(len(page.shown[SURFACE]))]
    results.put(
        {
            "surfaces_hz": min(len(page.shown[SURFACE]) for page in opened) / elapsed,
            "touching_hz": len(moving_s) / sum(moving_s) if moving_s else 0,
            "states_hz": min(len(page.shown[STATE]) for page in opened) / elapsed,
            "kb_per_s": max(page.bytes for page in opened) / elapsed / 1000,
            "touched": statistics.mean(touched) if touched else 0,
            "dropped": sum(page.dropped() for page in opened if page.shown[STATE]),
        }
    )


def session(folder, vertices):
    """The three nodes, ready."""
    scene = (REPOSITORY / "config" / "liver.yaml").read_text()
    parameters = folder / "scene.yaml"
    if vertices != 3116:
        mesh = folder / "liver.obj"
        subprocess.run(
            [PROGRAMS / "rhombus", "mesh", "make", "liver", "--vertices", str(vertices), "--output", mesh], check=True,
            stdout=subprocess.DEVNULL,
        )  # fmt: skip
        scene = re.sub(r"mesh: liver\b.*", f"mesh: {mesh}", scene)
    parameters.write_text(scene)
    nodes = {}
    for name in ("deformation", "visualization", "haptic_device"):
        command = [PROGRAMS / name, "--ros-args", "--params-file", parameters]
        if name == "visualization":
            command += ["-p", "viewer.port:=0"]
        log = folder / f"{name}.log"
        nodes[name] = subprocess.Popen(command, stderr=log.open("wb"))
        while "ready:" not in log.read_text():
            if nodes[name].poll() is not None:
                sys.exit(log.read_text())
            time.sleep(0.02)
    return nodes, int(re.search(r"viewer: http://[\d.]+:(\d+)/", (folder / "visualization.log").read_text())[1])


def measure(vertices, pages, seconds):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        nodes, port = session(folder, vertices)
        results, begin = multiprocessing.Queue(), multiprocessing.Event()
        reader = None
        try:
            if pages:
                reader = multiprocessing.Process(target=read_pages, args=(port, pages, begin, seconds, results))
                reader.start()
            time.sleep(SETTLE_S)
            node = nodes["visualization"]
            began, before = time.monotonic(), processor_s(node)
            begin.set()
            time.sleep(seconds)
            percent = 100 * (processor_s(node) - before) / (time.monotonic() - began)
            row = {"percent": percent, "rss_mb": resident_mb(node)}
            row |= results.get(timeout=30) if pages else {}
            nodes["deformation"].send_signal(signal.SIGINT)
            nodes["deformation"].wait(20)
            report = (folder / "deformation.log").read_text().split("closing report: ", 1)[1].splitlines()[0]
            poses = json.loads(report)["poses"]
            return {**row, "poses": poses}
        finally:
            if reader:
                reader.terminate()
            for process in nodes.values():
                process.kill()
                process.wait()


COLUMNS = ["percent", "rss_mb", "surfaces_hz", "touching_hz", "states_hz", "touched", "kb_per_s", "dropped", "poses"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vertices", default=[3116, 50000], type=int, nargs="+")
    parser.add_argument("--pages", default=[0, 1, 4], type=int, nargs="+")
    parser.add_argument("--seconds", default=12.0, type=float, help="measured time of each run; the hand's motion repeats after 12 s")
    parser.add_argument("--runs", default=3, type=int)
    parser.add_argument("--csv", type=Path, help="appends; the machine is named before the first row")
    options = parser.parse_args()
    os.environ.setdefault("ROS_DOMAIN_ID", str(60 + os.getpid() % 30))
    # As in a session: kept to this machine, the middleware would add shared memory by itself.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SUBNET"
    lines = []
    if options.csv is None or not options.csv.exists():
        lines += [
            f"# {machine()}",
            "# percent: processor time of the node in percent of one core; hz, kb_per_s: of the page that got least, most; touching_hz: surfaces while they change; touched: mean of a surface",
            ",".join(["vertices", "pages", "run", *COLUMNS]),
        ]
    for vertices in options.vertices:
        for pages in options.pages:
            rows = [measure(vertices, pages, options.seconds) for _ in range(options.runs)]
            for run, row in enumerate(rows, 1):
                values = [f"{row[column]:.1f}" if column in row else "" for column in COLUMNS]
                lines.append(",".join([str(vertices), str(pages), str(run), *values]))
            words = ", ".join(
                f"{column} {statistics.median(row[column] for row in rows):.1f}" for column in COLUMNS if column in rows[0]
            )
            print(f"{vertices} vertices, {pages} pages: {words}", flush=True)
    if options.csv:
        with options.csv.open("a") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
