"""Stands in for Python with its finite elements in tests: the standard library alone, answers of which every number is known.

    double.py -c IMPORTS        the packages are there, unless DOUBLE_WITHOUT names one
    double.py press.py WORK     stiffness 100 exp(2 x) at a vertex at x, no displacements
    double.py fit.py WORK       the last candidate with the most modes; every chain has the same share

Every start adds a line to DOUBLE_RUNS, if that is set, and every batch that is pressed another one. DOUBLE_FAULT: what goes wrong."""

import json
import os
import signal
import struct
import sys
import time
import zipfile
from pathlib import Path

FAULT = os.environ.get("DOUBLE_FAULT", "")


def note(line):
    if "DOUBLE_RUNS" in os.environ:
        with open(os.environ["DOUBLE_RUNS"], "a") as runs:
            runs.write(f"{line} {os.getpid()}\n")


def say(**values):
    print(json.dumps(values), flush=True)


def array(kind, shape, values):
    """The bytes of an .npy file; `kind`: f8, f4 or i4."""
    code = {"f8": "d", "f4": "f", "i4": "i"}[kind]
    header = str({"descr": f"<{kind}", "fortran_order": False, "shape": tuple(shape)}).encode()
    header += b" " * (63 - (10 + len(header)) % 64) + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + struct.pack(f"<{len(values)}{code}", *values)


def save(path, **arrays):
    part = path.with_name(path.name + ".part")
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in arrays.items():
            archive.writestr(f"{name}.npy", array(*content))
    os.replace(part, path)


def press(work, job):
    positions = struct.iter_unpack("<3d", (work / "vertices.f64").read_bytes())
    x = [position[0] for position in positions]
    batches = job["batches"]
    done = sum((work / f"press_{k}.npz").exists() for k in range(len(batches)))
    say(done=done, of=len(batches))
    for k, batch in enumerate(batches):
        if (work / f"press_{k}.npz").exists():
            continue
        if FAULT == "site":
            say(error="no mesh around a disc at vertex 7", vertex=7)
            sys.exit(2)
        if FAULT == "slow":
            time.sleep(30)
        note(f"batch {k}")
        stiffness = [100 * 2.718281828459045 ** (2 * x[job["sites"][site]]) for site in batch]
        save(
            work / f"press_{k}.npz",
            site=("i4", [len(batch)], batch),
            stiffness=("f8", [len(batch)], stiffness),
            displacement=("f4", [0], []),
        )
        done += 1
        say(done=done, of=len(batches))
        if FAULT == "killed":
            os.kill(os.getpid(), signal.SIGKILL)


def fit(work, job):
    vertices, sites = job["vertices"], len(job["sites"])
    say(done=0, of=1)
    candidate, modes = job["candidates"][-1], job["modes"][-1]
    chains, harmonics = len(candidate["decays_m"]), candidate["harmonics"]
    per_chain = 2 + 6 * harmonics
    coefficients = ([1 / chains] + [0.0] * (per_chain - 1)) * chains * vertices
    if FAULT == "open":
        coefficients[0] = 0.5
    errors = [error for site in range(sites) for error in (0.01 * (site + 1), 0.005 * (site + 1))]
    save(
        work / "fit.npz",
        decays_m=("f8", [chains], candidate["decays_m"]),
        reaches_m=("f8", [chains], candidate["reaches_m"]),
        harmonics=("i4", [], [harmonics]),
        coefficients=("f4", [vertices, chains, per_chain], coefficients),
        amplitudes=("f4", [vertices, modes], [0.0] * (vertices * modes)),
        modes=("f4", [modes, vertices, 3], [0.0] * (3 * vertices * modes)),
        site_errors=("f8", [sites, 2], errors),
        choices=("f8", [1, 7], [chains, harmonics, modes, 0.1, 0.05, 0.2, 1.0]),
        chosen=("i4", [], [0]),
    )
    say(done=1, of=1)


if sys.argv[1] == "-c":
    missing = os.environ.get("DOUBLE_WITHOUT")
    if missing:
        sys.exit(f"ModuleNotFoundError: No module named '{missing}'")
else:
    program, folder = Path(sys.argv[1]).name, Path(sys.argv[2])
    note(program)
    {"press.py": press, "fit.py": fit}[program](folder, json.loads((folder / "job.json").read_text()))
