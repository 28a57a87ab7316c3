#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Command line and node, as somebody installs and uses them, in a root without anything else.
set -euo pipefail
source /tmp/package/steps.sh
packages=(ros-sks-detector python3-sks-detector libsks-detector0.2)
longest_demo=1200  # from the start of demo.launch to the first detection [s]

install "${packages[@]}"
step "installed: $(installed | tr '\n' ' ')with $(dpkg --list | grep -c ^ii) packages in all"
check_links "${packages[@]}"

cd /tmp/home
step "$(sks --version)"
for file in /usr/share/man/man1/sks.1.gz /usr/share/bash-completion/completions/sks; do
  [[ -s $file ]] || fail "$file is missing"
done
sks simulate --builtin --scenes 1 --output tables >/dev/null 2>simulate.err || fail "$(cat simulate.err)"
sks train --builtin --output objects.sks >/dev/null 2>train.err || fail "$(cat train.err)"
sks detect --codebook objects.sks tables/scenes/scene000.pcd --json found.json >/dev/null
python3 - <<'END'
import json
with open("found.json") as file:
    found = json.load(file)
detections = [d for d in found["clouds"][0]["detections"] if d["score"] >= 0.5]
print("  sks detect:", ", ".join("%s %.2f" % (d["object"], d["score"]) for d in detections))
if not detections:
    raise SystemExit("sks detect has found nothing")
END

add python3-rostopic
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://localhost:$port ROS_HOSTNAME=localhost
begin=$SECONDS
roslaunch --port "$port" sks_detector demo.launch >demo.log 2>&1 &
launch=$!
trap 'kill -INT "$launch" 2>/dev/null || true' EXIT
# What a subscriber may ask for before the master is there is asked again.
until timeout "$longest_demo" rostopic echo -n 1 --filter 'len(m.detections) > 0' /detector/detections >seen.txt 2>seen.err; do
  if ! kill -0 "$launch" 2>/dev/null || ((SECONDS - begin >= longest_demo)); then
    cat demo.log seen.err >&2
    fail "demo.launch has shown no detection within $longest_demo s, or has ended"
  fi
  sleep 1
done
step "demo.launch: the first detections after $((SECONDS - begin)) s: $(grep --perl-regexp --only-matching '(?<=object: ).*' seen.txt | sort | tr '\n' ' ')"
kill -INT "$launch"
for _ in {1..60}; do
  kill -0 "$launch" 2>/dev/null || break
  sleep 1
done
if kill -0 "$launch" 2>/dev/null; then
  fail "demo.launch does not end within 60 s"
fi

install libsks-detector-dev
add catkin cmake g++ libactionlib-msgs-dev libgeometry-msgs-dev libroscpp-dev libsensor-msgs-dev libstd-msgs-dev make \
  ros-message-generation ros-message-runtime
if ! { cmake -S /tmp/package/robot -B /tmp/robot && cmake --build /tmp/robot; } >/tmp/robot.log 2>&1; then
  cat /tmp/robot.log >&2
  fail "a catkin package cannot be built against library and messages"
fi
step "a catkin package was built against library and messages: $(/tmp/robot/devel/lib/robot/robot)"
purge libsks-detector-dev "${packages[@]}"
install_and_purge libsks-detector-dev "${packages[@]}"
