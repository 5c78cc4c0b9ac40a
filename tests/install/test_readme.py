"""The README says what the product says: parameters, topics, files."""

import json
import re
import subprocess

import readme_tables
from readme_tables import README, REPOSITORY, RHOMBUS


def test_the_parameter_table_is_the_schemas():
    assert README.read_text() == readme_tables.up_to_date(), "run: python3 tests/install/readme_tables.py --write"


def test_the_topic_table_has_every_topic_with_its_type():
    explained = subprocess.run(
        [RHOMBUS, "explain", REPOSITORY / "config" / "liver.yaml", "--json"], capture_output=True, text=True, check=True
    )
    table = README.read_text().split("<!-- topics:begin -->")[1].split("<!-- topics:end -->")[0]
    for topic in json.loads(explained.stdout)["topics"]:
        assert f"`{topic['name']}`" in table, topic["name"]
        if not topic["name"].startswith("/"):
            row = next(line for line in table.splitlines() if line.startswith(f"| `{topic['name']}`"))
            assert topic["message"] in row


def test_every_file_and_folder_the_readme_links_to_exists():
    for target in re.findall(r"\]\(([^)#]+)\)", README.read_text()):
        if "://" not in target:
            assert (REPOSITORY / target).exists(), target
