"""Puts the modules that `rhombus calibrate --body` solves elasticity with on the path: import it before them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "nodes" / "rhombus_cli" / "elasticity"))
