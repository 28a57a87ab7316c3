# SPDX-License-Identifier: BSD-3-Clause
#
# An image with the packages that scripts/package makes of this checkout; docs/install.md says how it is used.
FROM debian:12 AS packages
WORKDIR /sks_detector
COPY . .
RUN scripts/package /packages

FROM debian:12-slim
# Versions are not pinned (DL3008): what Debian's stable release changes is security, and old versions leave its mirrors.
# hadolint ignore=DL3008
RUN --mount=type=bind,from=packages,source=/packages,target=/packages \
  apt-get update \
  && apt-get install --yes --no-install-recommends /packages/*.deb python3-rostopic rosbash \
  && rm -rf /var/lib/apt/lists/* \
  && useradd --create-home robot
USER robot
WORKDIR /home/robot
CMD ["roslaunch", "sks_detector", "detector.launch"]
