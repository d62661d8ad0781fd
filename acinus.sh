#!/usr/bin/env bash
# Installs what is missing, builds what changed, then runs. See usage() or README.md.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: ./acinus.sh COMMAND [ARGUMENT...]

  test [CTEST ARGUMENT...]  build everything and run the test suite without the tests labelled slow;
                            labels of your own, as in `test -L slow`, replace that choice
  build                     build everything, run nothing
  python [test]             build the Python module beside the build folder and say how to use it,
                            or run its tests and the notebooks
  deb                       build the programs and a Debian package of them in the build folder, and
                            print its path
  packages                  install missing Debian packages, nothing else
  help                      this text
  anything else             build the program and hand all arguments to it, in the folder you are
                            in: run, check, schema, explain, list, new, mesh, import, voxelise, calibrate, compare,
                            report, study, infer, serve, openvt, bench (`./acinus.sh --help` says more)

Missing packages of packages.txt are installed by apt-get, as root or through sudo.
Environment: ACINUS_JOBS               compile jobs (default: number of processors)
             ACINUS_BUILD_DIR          build folder (default: build/ beside this script, or below
                                       ~/.cache/acinus when that cannot be written)
             ACINUS_SKIP_PACKAGES=1    do not look at packages
Exit code: that of the program or of ctest; 1 if packages cannot be installed or the build fails.
TEXT
}

# All messages go to stderr: stdout belongs to the program.
say() { printf 'acinus.sh: %s\n' "$*" >&2; }
die() {
  say "$@"
  exit 1
}

here=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd -P)

# ---- folders and the lock -------------------------------------------------------------------

# build/ beside the script; a checkout that cannot be written gets a folder of its own in the cache.
preset=release
choose_build_dir() {
  local checksum
  if [[ -n ${ACINUS_BUILD_DIR:-} ]]; then
    build=$ACINUS_BUILD_DIR
  elif [[ -d $here/build && -w $here/build ]] || [[ ! -e $here/build && -w $here ]]; then
    build=$here/build
  else
    # Not below /tmp: another user could have put a program there under the same name.
    [[ -n ${XDG_CACHE_HOME:-${HOME:-}} ]] ||
      die "cannot write beside this script, and neither HOME nor XDG_CACHE_HOME says where else; set ACINUS_BUILD_DIR"
    checksum=$(printf '%s' "$here" | cksum)
    build=${XDG_CACHE_HOME:-${HOME:-}/.cache}/acinus/build-${checksum%% *}
  fi
  # A library's code is compiled otherwise than a program's.
  [[ $preset != python ]] || build=${build%/}-python
  mkdir -p -- "$build" || die "cannot make the build folder $build; set ACINUS_BUILD_DIR"
  build=$(cd -- "$build" && pwd -P)
  log=$build/build.log
}

# One installer or builder at a time per build folder. The lock must not outlive the build: a run
# may take days and another one may start meanwhile.
lock() {
  command -v flock >/dev/null || return 0
  exec 9>"$build/.lock" || die "cannot write in $build"
  flock -n 9 && return 0
  say "waiting for another acinus.sh that is building in $build"
  flock 9
}
unlock() { exec 9>&-; }

# One log per call: packages, cmake and compilers one after the other. A call with nothing to do
# leaves the log of the last one that did something.
start_log() {
  [[ -n ${log_started:-} ]] || : >"$log"
  log_started=yes
}

# ---- packages -------------------------------------------------------------------------------

# No process substitution anywhere: a root without /proc mounted has no /dev/fd.
list_wanted_packages() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$here/packages.txt"; }

list_missing_packages() { # ... PACKAGE...
  local name installed
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for name in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed $name"$'\n'* ]] || printf '%s ' "$name"
  done
}

# apt_get ARGUMENT...: through sudo unless root. Waits when another program (a machine that has just
# started updates itself) holds one of apt's locks; the lists lock has no time-out option in apt.
apt_get() {
  local status=0 retries=30
  while true; do
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get -o DPkg::Lock::Timeout=600 "$@" </dev/null >"$log.apt" 2>&1 && status=0 || status=$?
    cat -- "$log.apt" >>"$log"
    [[ $status -ne 0 && $retries -gt 0 ]] && grep -q 'Could not get lock' "$log.apt" ||
      return "$status"
    retries=$((retries - 1))
    sleep 10
  done
}

install_packages() {
  local -a missing as_root=()
  [[ ${ACINUS_SKIP_PACKAGES:-} == 1 ]] && return 0
  if ! command -v dpkg-query >/dev/null; then
    say "no dpkg here: packages are not checked (made for Debian 12; see packages.txt)"
    return 0
  fi
  # shellcheck disable=SC2046 # package names hold no blanks: words are what is wanted
  read -r -a missing <<<"$(list_missing_packages $(list_wanted_packages))"
  [[ ${#missing[@]} -eq 0 ]] && return 0
  if [[ $EUID -ne 0 ]]; then
    # sudo asks for its password here, because apt-get's own output goes to the log.
    command -v sudo >/dev/null && sudo -v && as_root=(sudo)
    [[ ${#as_root[@]} -gt 0 ]] || die "packages are missing and there is no sudo. As root, run:
  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}
(or set ACINUS_SKIP_PACKAGES=1 if you have them from elsewhere)"
  fi
  say "installing ${#missing[@]} Debian packages and what they need (log: $log)"
  local start=$SECONDS
  start_log
  # A failed update alone is no reason to stop: the lists at hand may do, and one broken foreign
  # source makes apt-get fail too.
  apt_get update || say "apt-get update failed; trying with the package lists at hand"
  if ! apt_get install -y --no-install-recommends "${missing[@]}"; then
    tail -n 20 -- "$log.apt" >&2
    die "apt-get could not install: ${missing[*]}
Is the network up, and does /etc/apt name a Debian 12 mirror? Full log: $log"
  fi
  rm -f -- "$log.apt"
  say "packages installed in $((SECONDS - start)) s"
}

# ---- build ----------------------------------------------------------------------------------

show_log_and_die() {
  # From the first failed compilation; if cmake was the one that stopped, the end of the log.
  if grep -q '^FAILED: ' "$log" && ! grep -q '^FAILED: build\.ninja' "$log"; then
    sed -n '/^FAILED: /,$p' "$log" | head -n 80 >&2
  else
    tail -n 60 -- "$log" >&2
  fi
  die "$1. Full log: $log"
}

# Reads ninja's output; writes it to the log and shows one line that counts up on a terminal.
show_progress() {
  local line shown=0
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$log"
    if [[ -t 2 && $line =~ ^\[([0-9]+/[0-9]+)\] ]]; then
      printf '\racinus.sh: building %s ' "${BASH_REMATCH[1]}" >&2
      shown=1
    fi
  done
  [[ $shown -eq 0 ]] || printf '\r\033[K' >&2
}

# A build folder that was copied or moved together with its checkout cannot be used further.
is_configured() {
  [[ -f $build/build.ninja && -f $build/CMakeCache.txt ]] || return 1
  grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$here" "$build/CMakeCache.txt" &&
    grep -qxF "CMAKE_CACHEFILE_DIR:INTERNAL=$build" "$build/CMakeCache.txt"
}

# build_targets [TARGET...]: configure if needed, compile what changed; silent if nothing did.
build_targets() {
  local start=$SECONDS
  # A checkout that belongs to another user (containers) must not hide its commit from the build.
  local n=${GIT_CONFIG_COUNT:-0}
  export GIT_CONFIG_COUNT=$((n + 1)) "GIT_CONFIG_KEY_$n=safe.directory" "GIT_CONFIG_VALUE_$n=$here"
  if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
    mkdir -p -- "${CCACHE_DIR:-${HOME:-/nowhere}/.cache/ccache}" 2>/dev/null ||
      export CCACHE_DIR=$build/ccache
  fi
  if ! is_configured; then
    say "configuring in $build"
    start_log
    (cd -- "$here" && cmake --fresh --preset "$preset" -B "$build") >>"$log" 2>&1 </dev/null ||
      show_log_and_die "cmake failed"
  fi
  # Captured first: with pipefail, a pipe into grep -q would fail when ninja is cut short.
  local plan
  plan=$(ninja -C "$build" -n "$@" 2>&1) || true
  if [[ $plan != *"no work to do"* ]]; then
    [[ -t 2 ]] || say "building (log: $log)"
    start_log
    NINJA_STATUS='[%f/%t] ' ninja -C "$build" -j "${ACINUS_JOBS:-$(nproc)}" "$@" 2>&1 </dev/null |
      show_progress || show_log_and_die "the build failed"
    say "built in $((SECONDS - start)) s"
  fi
  unset "GIT_CONFIG_KEY_$n" "GIT_CONFIG_VALUE_$n"
  if [[ $n -gt 0 ]]; then export GIT_CONFIG_COUNT=$n; else unset GIT_CONFIG_COUNT; fi
}

prepare() {
  choose_build_dir
  lock
  install_packages
  [[ $# -eq 0 ]] || build_targets "$@"
  unlock
}

# ---- commands -------------------------------------------------------------------------------

case ${1:-help} in
  help) usage ;;
  packages) prepare ;;
  build) prepare all ;;
  test)
    shift
    labels=(-LE slow)
    for argument in "$@"; do
      case $argument in -L | -LE | --label-regex* | --label-exclude*) labels=() ;; esac
    done
    prepare all
    exec ctest --test-dir "$build" --output-on-failure "${labels[@]}" "$@"
    ;;
  python)
    preset=python
    if [[ ${2:-} == test ]]; then
      prepare acinus acinus_python
      exec ctest --test-dir "$build" --output-on-failure -R '^python_(simulation|notebooks)$'
    fi
    [[ $# -eq 1 ]] || die "python takes nothing or the word test"
    prepare acinus_python
    printf 'export PYTHONPATH=%q\n' "$build/python"
    ;;
  deb)
    [[ $# -eq 1 ]] || die "deb takes no arguments"
    prepare acinus acinus-bench
    lock
    start_log
    rm -f -- "$build"/acinus_*.deb
    (cd -- "$build" && cpack -G DEB) >>"$log" 2>&1 </dev/null || show_log_and_die "cpack failed"
    printf '%s\n' "$build"/acinus_*.deb
    ;;
  bench)
    prepare acinus acinus-bench
    exec "$build/acinus" "$@"
    ;;
  *)
    prepare acinus
    exec "$build/acinus" "$@"
    ;;
esac
