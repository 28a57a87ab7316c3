#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# A program built against libsks-detector-dev, and the Python module, in a root without ROS.
set -euo pipefail
source /tmp/package/steps.sh
packages=(python3-sks-detector libsks-detector-dev libsks-detector0.2)

install "${packages[@]}"
step "installed: $(installed | tr '\n' ' ')with $(dpkg --list | grep -c ^ii) packages in all"
if dpkg --list | grep -E '^ii +(lib|python3-)?(ros|nodelet|catkin|tf2|rviz)'; then
  fail "a package of ROS was installed"
fi
check_links "${packages[@]}"

add cmake g++ make
if ! { cmake -S /tmp/consumer -B /tmp/consumer/build && cmake --build /tmp/consumer/build; } >/tmp/consumer.log 2>&1; then
  cat /tmp/consumer.log >&2
  fail "a program cannot be built against the library"
fi
/tmp/consumer/build/consumer
step "a program was built against the library and ran"

python3 - <<'END'
import numpy
import sks_detector
try:
    sks_detector.Detector("/tmp/none.sks")
except sks_detector.Error as error:
    print("  Python:", error)
else:
    raise SystemExit("a codebook that is not there was loaded")
END

purge "${packages[@]}"
install_and_purge "${packages[@]}"
