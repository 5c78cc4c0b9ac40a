"""The generated parts of the README: `python3 tests/install/readme_tables.py --write` brings them up to date."""

import re
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
README = REPOSITORY / "README.md"
RHOMBUS = REPOSITORY / "target" / "release" / "rhombus"


def parameter_table():
    """The schema's own table."""
    result = subprocess.run([RHOMBUS, "parameters", "--markdown"], capture_output=True, text=True, check=True)
    return result.stdout.strip()


def with_part(text, name, content):
    """`text` with what stands between the markers of `name` replaced."""
    pattern = re.compile(rf"(<!-- {name}:begin -->\n).*?(<!-- {name}:end -->)", re.DOTALL)
    return pattern.sub(lambda found: f"{found[1]}{content}\n{found[2]}", text)


def up_to_date():
    """The README as it should be."""
    return with_part(README.read_text(), "parameters", parameter_table())


if __name__ == "__main__":
    if sys.argv[1:] != ["--write"]:
        sys.exit("usage: readme_tables.py --write")
    README.write_text(up_to_date())
