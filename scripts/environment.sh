# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
#
# Sourced by the other scripts. Sets
#   root       this checkout
#   workspace  catkin workspace that they build in: $SKS_WORKSPACE, by default build/catkin in the checkout
#   SKS_DATA   (exported) folder of the recorded data sets, by default ../shared/data beside the checkout
# and link_checkout, a function.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
workspace=${SKS_WORKSPACE:-$root/build/catkin}
export SKS_DATA=${SKS_DATA:-$(dirname "$root")/shared/data}

# Threads that wait for each other sleep, or they slow each other down wherever other programs need the cores.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}

# catkin and its modules belong to the system's python3; another one may come first in PATH.
export PATH=/usr/bin:$PATH

# ROS Noetic on Ubuntu 20.04 lives in a folder of its own; Debian's ROS needs no set-up.
if [[ -f /opt/ros/noetic/setup.bash ]]; then
  set +u
  # shellcheck disable=SC1091
  source /opt/ros/noetic/setup.bash
  set -u
fi

# link_checkout FOLDER: makes it a folder of links to all that is in the checkout but `build` and what holds FOLDER itself:
# ROS walks through packages, link by link, and would not end.
link_checkout() {
  local entry
  [[ -L $1 ]] && rm "$1"
  mkdir -p "$1"
  find "$1" -maxdepth 1 -type l -delete
  for entry in "$root"/*; do
    [[ $entry == "$root/build" || $1/ == "$entry"/* ]] || ln -s "$entry" "$1/"
  done
}
