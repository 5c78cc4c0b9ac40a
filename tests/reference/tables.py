"""Result tables: CSV files, and their short form in README.md.

    python tables.py              puts the tables of results/*.csv into README.md"""

import csv
import re
from pathlib import Path

HERE = Path(__file__).parent
TABLES = {
    "validation": "validation.csv",
    "convergence": "liver_convergence.csv",
    "nonlinear": "liver_nonlinear.csv",
}


def percent(fraction: float) -> str:
    return f"{100 * fraction:.3f}"


def write_csv(path: Path, rows: list[dict]) -> None:
    """Rows need not have the same columns: what a row lacks stays empty."""
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"wrote {path.name}: {len(rows)} rows", flush=True)


def markdown(path: Path) -> str:
    with open(path, newline="") as file:
        columns, *rows = csv.reader(file)
    names = [name.replace("_percent", " %").replace("_", " ") for name in columns]
    lines = ["| " + " | ".join(names) + " |", "|---" + "|---:" * (len(columns) - 1) + "|"]
    for row in rows:
        short = [f"{float(x):.2f}" if "percent" in c and x else x for c, x in zip(columns, row)]
        lines.append("| " + " | ".join(short) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    readme = HERE / "README.md"
    text = readme.read_text()
    for marker, name in TABLES.items():
        if not (HERE / "results" / name).exists():
            continue
        table = markdown(HERE / "results" / name)
        block = f"<!-- {marker} -->\n{table}\n<!-- /{marker} -->"
        text = re.sub(rf"<!-- {marker} -->.*<!-- /{marker} -->", lambda _: block, text, flags=re.S)
    readme.write_text(text)
