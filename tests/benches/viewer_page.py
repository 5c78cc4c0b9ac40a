"""What a page in a browser gets and draws, and what the node pays for it; `--csv FILE` keeps every run.

    npm ci --prefix tests/viewer
    . launch/ros2_env.sh && cargo build --release -p haptic_device -p deformation -p visualization -p rhombus_cli
    "$RHOMBUS_PYTHON" tests/benches/viewer_page.py --csv viewer_page.csv

The simulated hand presses the generated liver; headless Chromium looks at it at 1280x720 and counts updates in the page
(tests/viewer/measure.js). Rates are those while the surface moves, by the stamps of its updates; `age_ms` is how old they
are, by the median, when the page has them, which waits for its pictures. The node's processor time is measured beside it,
with the page and without (the baseline). At the end the model is killed, and the page has to say so.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from viewer_load import REPOSITORY, SETTLE_S, machine, processor_s, resident_mb, session

COLUMNS = ["first_picture_ms", "received_hz", "applied_hz", "not_applied", "dropped", "age_ms", "pictures_hz", "cpu_percent", "rss_mb"]
COLUMNS += ["cpu_percent_without_page", "gone_said_ms"]


def cpu_percent(node, seconds):
    begun, before = time.monotonic(), processor_s(node)
    time.sleep(seconds)
    return 100 * (processor_s(node) - before) / (time.monotonic() - begun)


def measure(vertices, seconds):
    with tempfile.TemporaryDirectory() as name:
        nodes, port = session(Path(name), vertices)
        try:
            node = nodes["visualization"]
            time.sleep(SETTLE_S)
            alone = cpu_percent(node, seconds)
            environment = {**os.environ, "RHOMBUS_VIEWER_URL": f"http://127.0.0.1:{port}/"}
            page = subprocess.Popen(
                ["node", "measure.js", str(seconds + SETTLE_S)], cwd=REPOSITORY / "tests" / "viewer", env=environment,
                stdout=subprocess.PIPE, text=True,
            )  # fmt: skip
            time.sleep(SETTLE_S)
            watched = cpu_percent(node, seconds)
            memory_mb = resident_mb(node)
            said = json.loads(page.stdout.readline())
            killed_s = time.time()
            nodes["deformation"].kill()
            gone_s = json.loads(page.communicate(timeout=120)[0])["gone_at_s"]
            return {
                **said,
                "cpu_percent": watched,
                "rss_mb": memory_mb,
                "cpu_percent_without_page": alone,
                "gone_said_ms": 1000 * (gone_s - killed_s),
            }
        finally:
            for process in nodes.values():
                process.kill()
                process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vertices", default=[3116, 50000], type=int, nargs="+")
    parser.add_argument("--seconds", default=12.0, type=float, help="measured time of each run; the hand's motion repeats after 12 s")
    parser.add_argument("--runs", default=3, type=int)
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    os.environ.setdefault("ROS_DOMAIN_ID", str(60 + os.getpid() % 30))
    # As in a session: kept to this machine, the middleware would add shared memory by itself.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SUBNET"
    started_on, renderer, lines = machine(), "", []
    for vertices in options.vertices:
        rows = [measure(vertices, options.seconds) for _ in range(options.runs)]
        renderer = rows[0]["renderer"]
        lines += [
            ",".join([str(vertices), str(run), *(f"{row[column]:.1f}" for column in COLUMNS)]) for run, row in enumerate(rows, 1)
        ]
        words = ", ".join(f"{column} {statistics.median(row[column] for row in rows):.1f}" for column in COLUMNS)
        print(f"{vertices} vertices: {words}; {renderer}", flush=True)
    if options.csv:
        options.csv.write_text("\n".join([f"# {started_on}; {renderer}", ",".join(["vertices", "run", *COLUMNS]), *lines]) + "\n")


if __name__ == "__main__":
    main()
