#!/usr/bin/env bash
# Proves the two README commands and the Debian package on a Debian 12 that has nothing but its smallest installation.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/debootstrap.sh [--keep] [--packages-only] FOLDER

Makes two minimal Debian 12 roots in FOLDER. In the first it puts a clean clone of the last commit, runs
the commands of README.md and makes the Debian package. In the second it installs that package, runs
`acinus run two_cells` in an empty folder, installs what the package suggests and builds and runs
docs/examples/library. Prints how long each took. Needs root, debootstrap and git.
  --keep            leave FOLDER behind (without anything mounted); a later call with the same
                    FOLDER starts from it instead of from nothing
  --packages-only   stop when the packages for building are installed
The mirror is the one this machine's own apt uses.
TEXT
}

suite=bookworm
keep=no packages_only=no folder=
for argument in "$@"; do
  case $argument in
    --keep) keep=yes ;;
    --packages-only) packages_only=yes ;;
    -*) usage >&2; exit 2 ;;
    *) folder=$argument ;;
  esac
done
[[ -n $folder ]] || { usage >&2; exit 2; }
[[ $EUID -eq 0 ]] || { echo "debootstrap.sh: must be root" >&2; exit 2; }
for tool in debootstrap git; do
  command -v "$tool" >/dev/null || { echo "debootstrap.sh: needs $tool" >&2; exit 2; }
done
project=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
mkdir -p -- "$folder"
folder=$(cd -- "$folder" && pwd -P)
marker=$folder/made-by-debootstrap.sh
[[ -f $marker || -z $(ls -A -- "$folder") ]] || {
  echo "debootstrap.sh: $folder is not empty and was not made by this script" >&2
  exit 2
}
touch "$marker"

# Prints "URI" of every apt source of this machine that offers the suite named $1, both notations.
find_mirrors() {
  local file
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ -f $file ]] || continue
    sed -E 's/^(deb )\[[^]]*\] */\1/' "$file" |
      awk -v suite="$1" '$1 == "deb" && $3 == suite && / main( |$)/ { print $2 }'
  done
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ -f $file ]] || continue
    awk -v suite="$1" '
      function finish() { if (uri != "" && (" " suites " ") ~ (" " suite " ")) print uri
                          uri = suites = "" }
      /^[[:space:]]*$/ { finish() }
      /^URIs:/ { uri = $2 }
      /^Suites:/ { sub(/^Suites:[ \t]*/, ""); suites = $0 }
      END { finish() }' "$file"
  done
}
first_mirror() { find_mirrors "$1" | sed -n 1p; }

mounted=()
clean_up() {
  local i
  for ((i = ${#mounted[@]} - 1; i >= 0; i--)); do umount -- "${mounted[i]}"; done
  if [[ $keep == yes ]]; then
    echo "debootstrap.sh: $folder is kept"
  else
    rm -rf --one-file-system -- "$folder"
  fi
}
trap clean_up EXIT

# timed LABEL COMMAND...: runs it and prints label, seconds and exit code.
timed() {
  local label=$1 start=$SECONDS status=0
  shift
  "$@" || status=$?
  printf '== %s: %d s, exit %d\n' "$label" "$((SECONDS - start))" "$status"
  return "$status"
}

run_debootstrap() { # ROOT MIRROR
  debootstrap --variant=minbase "$suite" "$1" "$2" >"$1.log" || {
    tail -n 20 "$1.log" >&2
    return 1
  }
  rm -f -- "$1.log"
}

make_root() { # ROOT
  local root=$1 name source
  # The file is the last thing written: a root that was cut short is made again.
  if [[ ! -f $root/etc/acinus-test-root ]]; then
    rm -rf --one-file-system -- "$root"
    source=$(first_mirror "$suite")
    [[ -n $source ]] || { echo "debootstrap.sh: /etc/apt names no source of $suite" >&2; exit 2; }
    timed "debootstrap minbase, ${root##*/}" run_debootstrap "$root" "$source"
    : >"$root/etc/apt/sources.list"
    for name in "$suite" "$suite-updates" "$suite-security"; do
      source=$(first_mirror "$name")
      [[ -z $source ]] || echo "deb $source $name main" >>"$root/etc/apt/sources.list"
    done
    touch "$root/etc/acinus-test-root"
  fi
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  cp -L /etc/hosts "$root/etc/hosts"
  mount -t proc proc "$root/proc" && mounted+=("$root/proc")
  mount -t sysfs -o ro sysfs "$root/sys" && mounted+=("$root/sys")
  mkdir -p "$root/dev/shm" # Open MPI keeps its shared memory there
  mount -t tmpfs tmpfs "$root/dev/shm" && mounted+=("$root/dev/shm")
}

inside() { # ROOT COMMAND: in the root, with an environment as after a log-in
  chroot "$1" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} /bin/bash -c "$2"
}

# ---- first root: the README commands and the package ----------------------------------------

builder=$folder/build-root
make_root "$builder"
home=$builder/root/acinus
rm -rf -- "$home"
if [[ $packages_only == yes ]]; then
  mkdir -p "$home"
  cp -- "$project/acinus.sh" "$project/packages.txt" "$home/"
  timed "packages" inside "$builder" "cd /root/acinus && ./acinus.sh packages"
  timed "packages again" inside "$builder" "cd /root/acinus && ./acinus.sh packages"
  du -sh --one-file-system "$builder"
  exit 0
fi
git clone --quiet --no-hardlinks -- "$project" "$home"
# The commands are taken from the README itself, so that it cannot promise something else.
mapfile -t commands < <(
  sed -nE 's/^ {4}(\.\/acinus\.sh [^#]*[^# ]).*/\1/p' "$home/README.md" | sed -n 1,2p)
[[ ${#commands[@]} -eq 2 ]] || {
  echo "debootstrap.sh: README.md does not show two commands" >&2
  exit 1
}
for command in "${commands[@]}"; do
  timed "$command" inside "$builder" "cd /root/acinus && $command"
done
timed "./acinus.sh deb" inside "$builder" "cd /root/acinus && ./acinus.sh deb"

# ---- second root: the package alone ---------------------------------------------------------

user=$folder/user-root
make_root "$user"
rm -rf -- "$user/root/acinus_test"
mkdir -p "$user/root/acinus_test/empty"
cp -- "$home"/build/acinus_*.deb "$user/root/acinus_test/acinus.deb"
cp -r -- "$home/docs/examples/library" "$user/root/acinus_test/library"
apt="DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install"
timed "install the package" inside "$user" "apt-get -qq update && $apt /root/acinus_test/acinus.deb"
timed "acinus run two_cells" inside "$user" "cd /root/acinus_test/empty && acinus run two_cells"
# What the package suggests must be all that the example needs, but for a tool to run the compiler: make.
timed "install what it suggests" inside "$user" \
  "$apt make \$(dpkg-deb -f /root/acinus_test/acinus.deb Suggests | tr -d ,)"
timed "docs/examples/library" inside "$user" \
  "cd /root/acinus_test/library && cmake -B build && cmake --build build && build/three_cells"
