# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
#
# Sourced by the steps that scripts/test_package runs inside a root.
ours=(ros-sks-detector python3-sks-detector libsks-detector-dev libsks-detector0.2)

step() { echo "  $*"; }

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# install PACKAGE...: of ours, from their files, and what they depend on.
install() {
  local files=() name
  for name; do
    files+=("$(compgen -G "/tmp/debs/${name}_*.deb")")
  done
  apt-get -qq install --yes --no-install-recommends "${files[@]}" >/tmp/apt.log 2>&1 || {
    tail -n 30 /tmp/apt.log >&2
    fail "apt-get install $*"
  }
}

# add PACKAGE...: of Debian, for the test itself.
add() { apt-get -qq install --yes --no-install-recommends "$@" >/tmp/apt.log 2>&1 || fail "apt-get install $*"; }

# What is installed now of our packages.
installed() { dpkg-query --show --showformat '${db:Status-Abbrev}${Package}\n' "${ours[@]}" 2>/dev/null | grep -v '^un' || true; }

list_files() {
  find / -xdev \( -path /proc -o -path /tmp -o -path /var/log -o -path /var/cache/apt -o -path /var/lib/apt \) -prune \
    -o -print | sort
}

# No link leads to nowhere, and every library that a program or library of our packages needs is there.
check_links() {
  local package file missing
  for package; do
    while read -r file; do
      [[ -e $file ]] || fail "$file of $package is a link to nowhere"
      [[ -f $file && ! -L $file ]] || continue
      head --bytes=4 "$file" | cmp --quiet - <(printf '\177ELF') || continue
      missing=$(ldd "$file" 2>/dev/null | grep "not found" || true)
      [[ -z $missing ]] || fail "$file of $package needs what is not installed: $missing"
    done < <(dpkg --listfiles "$package")
  done
}

# purge PACKAGE...: nothing is left of them: no file, no state, no path with our name.
purge() {
  local listed=/tmp/listed left
  dpkg --listfiles "$@" | grep '^/[^.]' | sort --unique >"$listed"
  apt-get -qq purge --yes "$@" >/tmp/apt.log 2>&1 || fail "apt-get purge $*"
  left=$(installed)
  [[ -z $left ]] || fail "still known to dpkg: $left"
  left=$(list_files | grep --extended-regexp 'sks[-_]detector|/sks(\.|$)' || true)
  [[ -z $left ]] || fail "left after purge: $left"
  left=$(while read -r file; do
    # Folders may be those of other packages too.
    [[ -e $file || -L $file ]] && { [[ ! -d $file ]] || ! dpkg --search "$file" >/dev/null 2>&1; } && echo "$file"
  done <"$listed" || true)
  [[ -z $left ]] || fail "left after purge: $left"
  step "purge $*: nothing left of $(wc -l <"$listed") paths"
}

# install_and_purge PACKAGE...: where all that they depend on is there already, the root is the same before and after.
install_and_purge() {
  list_files >/tmp/before
  install "$@"
  purge "$@"
  list_files >/tmp/after
  diff /tmp/before /tmp/after || fail "the root is not as it was before $*"
  step "install and purge $*: all $(wc -l </tmp/before) paths are as before"
}
