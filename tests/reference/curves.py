"""How the error of a calibrated liver depends on the number of chains, harmonics, body modes and sites.

    python curves.py [--rhombus PROGRAM] [--work FOLDER]

Calibrates it with `rhombus calibrate --body`, each time judged at the held-out sites of liver_r5.npz, and writes
bodies/curves.csv. Presses are kept in FOLDER (not committed), so that an interrupted run goes on where it was."""

import argparse
import json
import subprocess
import sys
from pathlib import Path

from tables import write_csv

HERE = Path(__file__).parent
BODY = ["--body", "liver", "--young", "10000", "--poisson", "0.45", "--fixed", "facing:0,0,-1,0.7"]
# sites, chains, harmonics, modes
USUAL = (80, 6, 2, 16)
RUNS = [
    *((28, 6, 2, 8), (40, 6, 2, 16), (60, 6, 2, 16)),
    *((80, chains, 2, 16) for chains in (3, 4, 5)),
    *((80, 6, harmonics, 16) for harmonics in (0, 1)),
    *((80, 6, 2, modes) for modes in (0, 8, 24, 32)),
    USUAL,
]


def calibrate(rhombus: str, work: Path, run: tuple[int, int, int, int]) -> dict:
    """One row."""
    sites, chains, harmonics, modes = run
    command = [rhombus, "calibrate", *BODY, "--held-out", HERE / "results" / "liver_r5.npz", "--python", sys.executable]
    command += ["--sites", sites, "--chains", chains, "--harmonics", harmonics, "--modes", modes]
    command += ["--keep-work", "--force", "--json", "-o", work / f"sites_{sites}.body"]
    found = json.loads(subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout)
    errors = next(region for region in found["errors"] if region["region"] == "reference sites")
    (median, worst), (median_near, worst_near) = errors["field"], errors["near_field"]
    print(run, f"{100 * median:.1f} % median, {100 * worst:.1f} % worst", flush=True)
    return {
        "sites": sites,
        "chains": chains,
        "harmonics": harmonics,
        "modes": modes,
        "median_field": f"{median:.4f}",
        "worst_field": f"{worst:.4f}",
        "median_near": f"{median_near:.4f}",
        "worst_near": f"{worst_near:.4f}",
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rhombus", default=str(HERE.parents[1] / "target" / "release" / "rhombus"))
    parser.add_argument("--work", type=Path, default=HERE / "solutions" / "curves")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    (HERE / "bodies").mkdir(exist_ok=True)
    write_csv(HERE / "bodies" / "curves.csv", [calibrate(options.rhombus, options.work, run) for run in RUNS])
