"""The installed tree has what `ros2 run` and `ros2 launch` look for, and its launch files name only what is in it."""

import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
import yaml
from ament_index_python.packages import get_package_prefix, get_package_share_directory

REPOSITORY = Path(__file__).resolve().parents[2]
EXECUTABLES = ["bag_replay", "deformation", "haptic_device", "rhombus", "visualization"]
LAUNCH_FILES = ["session.launch.xml", "replay.launch.xml"]
SESSION_ARGUMENTS = [
    *("device", "serial", "second_device", "second_serial", "device_config"),
    *("scene", "mesh", "namespace", "record", "rviz", "foxglove", "use_sim_time", "log_level"),
]


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """The tree that the documented script installs, on the ament index like a sourced workspace."""
    target = tmp_path_factory.mktemp("prefix")
    subprocess.run([REPOSITORY / "launch" / "install", target], check=True, stdout=subprocess.DEVNULL)
    os.environ["AMENT_PREFIX_PATH"] = f"{target}{os.pathsep}{os.environ['AMENT_PREFIX_PATH']}"
    return target


def test_the_ament_index_finds_both_packages(prefix):
    for package in ("rhombus_haptics", "rhombus_haptics_msgs"):
        assert Path(get_package_prefix(package)) == prefix


@pytest.mark.parametrize("name", EXECUTABLES)
def test_ros2_run_finds_every_executable(prefix, name):
    assert os.access(prefix / "lib" / "rhombus_haptics" / name, os.X_OK)


def test_an_installed_node_starts_with_the_installed_environment_alone(prefix):
    script = f"source {prefix}/setup.bash && exec {prefix}/lib/rhombus_haptics/deformation --ros-args -p no.such.key:=1"
    result = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=30)
    assert result.returncode != 0
    assert "no.such.key" in result.stderr


@pytest.mark.parametrize("name", LAUNCH_FILES)
def test_launch_files_are_installed_and_name_only_what_is_installed(prefix, name):
    share = Path(get_package_share_directory("rhombus_haptics"))
    path = share / "launch" / name
    root = ElementTree.parse(path).getroot()
    for argument in root.iter("arg"):
        assert argument.get("description"), f"{name}: argument {argument.get('name')} has no description"
    names = {argument.get("name") for argument in root.iter("arg")}
    names |= {variable.get("name") for variable in root.iter("let")}
    assert set(re.findall(r"\$\(var (\w+)\)", path.read_text())) <= names
    for node in root.iter("node"):
        if node.get("pkg") == "rhombus_haptics":
            assert node.get("exec") in EXECUTABLES
    for relative in re.findall(r"find-pkg-share rhombus_haptics\)/([\w./-]+)", path.read_text()):
        assert (share / relative).is_file(), f"{name} names {relative}"


def test_the_session_launch_file_has_the_documented_arguments(prefix):
    share = Path(get_package_share_directory("rhombus_haptics"))
    root = ElementTree.parse(share / "launch" / "session.launch.xml").getroot()
    assert [argument.get("name") for argument in root.iter("arg")] == SESSION_ARGUMENTS


def test_the_session_launch_file_offers_every_backend_for_both_devices(prefix):
    rhombus = prefix / "lib" / "rhombus_haptics" / "rhombus"
    listing = subprocess.run([rhombus, "parameters", "--json"], capture_output=True, text=True, check=True)
    accepted = next(row["accepted"] for row in yaml.safe_load(listing.stdout) if row["name"] == "device.backend")
    backends = re.findall(r'"(\w+)"', accepted)
    assert len(backends) == 6
    root = ElementTree.parse(REPOSITORY / "launch" / "session.launch.xml").getroot()
    for name, none in (("device", []), ("second_device", [""])):
        argument = next(each for each in root.iter("arg") if each.get("name") == name)
        assert [choice.get("value") for choice in argument.iter("choice")] == none + backends


def test_every_parameter_in_the_launch_files_is_one_that_the_nodes_know(prefix):
    listing = subprocess.run(
        [prefix / "lib" / "rhombus_haptics" / "rhombus", "parameters", "--json"], capture_output=True, text=True, check=True
    )
    known = {row["name"] for row in yaml.safe_load(listing.stdout)}
    for name in LAUNCH_FILES:
        root = ElementTree.parse(REPOSITORY / "launch" / name).getroot()
        used = {each.get("name") for each in root.iter("set_parameter")}
        ours = (node for node in root.iter("node") if node.get("pkg") == "rhombus_haptics")
        used |= {each.get("name") for node in ours for each in node.iter("param")}
        assert used <= known, f"{name}: {sorted(used - known)}"


def test_scenes_and_layouts_are_installed(prefix):
    share = Path(get_package_share_directory("rhombus_haptics"))
    for ending in ("yaml", "rviz", "json"):
        ours, installed = (sorted(p.name for p in (root / "config").rglob(f"*.{ending}")) for root in (REPOSITORY, share))
        assert ours and ours == installed
