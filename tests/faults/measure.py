#!/usr/bin/env python3
"""Breaks pressing sessions many times and writes down how long the force lasted.

    . launch/ros2_env.sh
    "$RHOMBUS_PYTHON" tests/faults/measure.py --runs 100 --csv FILE [--only TEXT] [--programs FOLDER]

One line of the CSV for each run; a table of medians and worst cases on stdout. Ends with 1 when a limit did not hold.
"""

import argparse
import csv
import os
import platform
import statistics
import sys
import tempfile
import time
from pathlib import Path

import rclpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "graph"))
import faults
import peer as graph
from peer import Peer
import rig as bench

CONTACT_LAW, SERVO_CF = "contact_law", "servo_cf"
QUICK, DEFAULT = "quick", "default"
COLUMNS = "backend,force_source,rules,part,fault,run,force_n,zero_ms,event,step_n,back_step_n,limit_ms,within".split(",")


def plan(runs):
    """What is measured: backend, source of force, rules, faults, runs of each."""
    some, few = max(1, runs // 8), max(1, runs // 100)
    # Listeners are watched for seconds; with the rules as shipped the hand has to withdraw, and the force takes 2 s.
    stands_still = faults.DRIVER_STANDS_STILL
    stale = [*faults.DRIVER_IN_PARTS, *faults.MODEL_STANDS_STILL]
    ends = [*faults.DRIVER_ENDS, *faults.DRIVER_PANICS]
    yield "serial", CONTACT_LAW, QUICK, [*stands_still, *stale], runs
    yield "serial", SERVO_CF, QUICK, stale, runs
    yield "serial", CONTACT_LAW, QUICK, [*ends, *faults.MODEL_ENDS], runs
    yield "serial", SERVO_CF, QUICK, faults.MODEL_ENDS[:1], runs
    for backend in ("force_dimension", "haply"):
        yield backend, CONTACT_LAW, QUICK, stands_still, runs
    yield "serial", CONTACT_LAW, QUICK, faults.BYSTANDERS, some
    yield "serial", CONTACT_LAW, DEFAULT, [*stands_still, *stale, *ends, *faults.MODEL_ENDS], few


class Session:
    """A rig that is there when it is needed, and made anew when it is broken for good."""

    def __init__(self, folder, backend, source, rules, driver):
        self.folder, self.backend, self.driver = folder, backend, driver
        self.values = {"device.force_source": source, **(bench.QUICK if rules == QUICK else {})}
        # The hand must not press before the driver has seen it free.
        self.press_after_s = 0.0 if rules == QUICK else 3.0
        self.peer = self.rig = None
        self.count = 0

    def ready(self):
        if self.rig is None:
            self.count += 1
            self.peer = Peer()
            folder = self.folder / str(self.count)
            self.rig = bench.Rig(self.peer, folder, self.backend, self.values, self.driver, self.press_after_s)
        return self.rig

    def end(self):
        if self.rig is not None:
            self.rig.close()
            self.peer.close()
        self.rig = self.peer = None


def measure(fault, session, rules, runs):
    """Results of the runs, one after the other."""
    for _ in range(runs):
        for again in (True, True, False):
            try:
                run = faults.stand_by if fault.limit == "never" else faults.run
                result = run(session.ready(), fault)
                break
            except bench.NotPressing as reason:
                # What was to be broken did not work to begin with: the machine is busy with something else.
                session.end()
                if not again:
                    raise
                print(f"{fault.name}: again, because {reason}", file=sys.stderr, flush=True)
        yield result
        # With the rules as shipped the force comes back only after the hand has withdrawn, which it does not.
        if rules == DEFAULT or not faults.heal(session.rig, fault):
            session.end()


def machine():
    """What was measured on."""
    rows = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((row.split(":")[1].strip() for row in rows if row.startswith("model name")), platform.machine())
    return f"{model}, {os.cpu_count()} CPUs, Linux {platform.release()}; load at the start {os.getloadavg()[0]:.1f}"


def row_of(result, fault):
    """The rest of a run's line. Where the force must stay as it is, step_n is how much it changed."""
    within = int(faults.holds(result, fault))
    if fault.limit == "never":
        return [f"{result.force_n:.3f}", "", "", f"{result.change_n:.4f}", "", "", within]
    numbers = [f"{result.zero_ms:.3f}", result.event, f"{result.step_n:.4f}", f"{result.back_step_n:.4f}"]
    return [f"{result.force_n:.3f}", *numbers, result.limit_ms, within]


def in_words(results):
    """Median and worst case."""
    if isinstance(results[0], faults.Change):
        return f"{len(results):4} runs  changes the force by at most {max(result.change_n for result in results):.3f} N"
    times = [result.zero_ms for result in results]
    worst = {name: max(getattr(result, name) for result in results) for name in ("zero_ms", "step_n", "back_step_n")}
    return (
        f"{len(times):4} runs  median {statistics.median(times):6.1f} ms  worst {worst['zero_ms']:6.1f} ms  "
        f"limit {results[0].limit_ms:6.2f} ms  largest step {worst['step_n']:5.2f} N, back {worst['back_step_n']:5.2f} N"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=100, help="of each fault; of those who only listen an eighth, with all rules as shipped a hundredth")
    parser.add_argument("--csv", type=Path, required=True)
    parser.add_argument("--only", default="", help="only rows that contain this: backend, source, rules, part: fault")
    parser.add_argument("--programs", type=Path, help="folder of the executables")
    options = parser.parse_args()
    if options.programs:
        graph.PROGRAMS = options.programs.resolve()
    graph.isolate()
    # Not one of the tests' domains: they may run beside this.
    os.environ["ROS_DOMAIN_ID"] = str(101 + os.getpid() % 100)
    rclpy.init(args=[])
    held = True
    with options.csv.open("w", newline="") as file, tempfile.TemporaryDirectory() as folder:
        file.write(f"# {machine()}\n# rules quick: engage rule and passivity switched off by unsafe.parameters, so that a run is short; default: as shipped\n")
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for number, (backend, source, rules, row, runs) in enumerate(plan(options.runs)):
            for fault in row:
                if options.only not in f"{backend} {source} {rules} {fault.name}":
                    continue
                begin = time.monotonic()
                session = Session(Path(folder) / f"{number} {fault.name}", backend, source, rules, fault.driver)
                results = []
                try:
                    for result in measure(fault, session, rules, runs):
                        results.append(result)
                        table.writerow([backend, source, rules, fault.part, fault.what, len(results), *row_of(result, fault)])
                        file.flush()
                finally:
                    session.end()
                held &= all(faults.holds(result, fault) for result in results)
                seconds = time.monotonic() - begin
                print(f"{backend:16}{source:12}{rules:8}{fault.name:36}{in_words(results)}  ({seconds:.0f} s)", flush=True)
    rclpy.shutdown()
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
