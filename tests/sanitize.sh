#!/usr/bin/env bash
# Runs the tests under what finds faults that no test asks for.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

usage() {
  cat <<'TEXT'
usage: tests/sanitize.sh [memory] [threads] [asserts]

memory    the quick suite under AddressSanitizer and UndefinedBehaviorSanitizer
threads   the tests that compare numbers of threads, and a hybrid scene with two threads, under
          ThreadSanitizer
asserts   the golden scenes with internal checks on (gcc, preset audit); their hashes may differ
Without arguments all three. Each part also runs planted faults and fails if one is not found.
memory and threads need clang 16: packages clang-16, libclang-rt-16-dev, llvm-16.
Builds in build-asan, build-tsan and build-audit. Exit code 1 if anything was found.
Environment: ACINUS_JOBS   compile jobs (default: number of processors)
TEXT
}

jobs=${ACINUS_JOBS:-$(nproc)}
clang=clang++-16
failed=()
fail() {
  failed+=("$1")
  printf 'sanitize.sh: FAILED: %s\n' "$1" >&2
}
command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache

# must_find NAME PATTERN COMMAND...: the planted fault ends the program and is named.
must_find() {
  local name=$1 pattern=$2 output status=0
  shift 2
  output=$("$@" 2>&1) || status=$?
  if [[ $status -ne 0 && $output =~ $pattern ]]; then
    echo "planted $name: found"
  else
    printf '%s\n' "$output" >&2
    fail "planted $name was not found (exit code $status)"
  fi
}

# build_with_clang FOLDER OPTION...: everything with a sanitizer. It takes half of gcc's time.
build_with_clang() {
  local folder=$1
  shift
  command -v "$clang" >/dev/null || { fail "needs $clang"; return 1; }
  cmake -G Ninja -B "$folder" -DCMAKE_CXX_COMPILER="$clang" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g" \
    -DACINUS_PLANTED=ON -DACINUS_PRECOMPILE=ON "$@" >/dev/null &&
    cmake --build "$folder" -j "$jobs" || { fail "$folder: the build"; return 1; }
}

check_memory() {
  build_with_clang build-asan -DACINUS_SANITIZE=ON -DACINUS_ASSERTS=ON || return 0
  export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.txt:print_suppressions=0
  export ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
  must_find index "heap-buffer-overflow" build-asan/tests/planted_index
  must_find "NaN in a force" "refused: |internal error: " build-asan/tests/planted_nan
  ctest --test-dir build-asan --output-on-failure -LE 'slow|golden' || fail "the quick suite under ASan and UBSan"
  unset LSAN_OPTIONS ASAN_OPTIONS UBSAN_OPTIONS
}

check_threads() {
  build_with_clang build-tsan -DACINUS_SANITIZE_THREADS=ON -DACINUS_BENCH=OFF || return 0
  export TSAN_OPTIONS=exitcode=66
  must_find "data race" "WARNING: ThreadSanitizer: data race" build-tsan/tests/planted_race
  build-tsan/tests/planted_race clean || fail "a sum without a race is told as one"
  # The tests whose names speak of threads, each in its own process.
  local name suite test found=0
  for name in build-tsan/tests/*_tests; do
    suite=
    while IFS= read -r test; do
      case $test in
        ' '*[Tt]hread*)
          found=$((found + 1))
          "$name" --gtest_brief=1 --gtest_filter="$suite${test// /}" || fail "threads: $suite${test// /}"
          ;;
        ' '*) ;;
        *) suite=$test ;;
      esac
    done < <("$name" --gtest_list_tests | sed -e '/^Running main/d' -e 's/ *#.*//')
  done
  [[ $found -ge 10 ]] || fail "threads: only $found tests found"
  local out
  out=$(mktemp -d)
  build-tsan/acinus run lobule_hybrid --set start_up.growth_time="30 min" --until "5 min" --threads 2 \
    --out "$out/hybrid" --quiet || fail "threads: hybrid scene"
  rm -rf -- "$out"
  unset TSAN_OPTIONS
}

check_asserts() {
  cmake --preset audit -DACINUS_PLANTED=ON >/dev/null
  cmake --build build-audit -j "$jobs"
  must_find "NaN in a force" "refused: |internal error: " build-audit/tests/planted_nan
  local case output
  while IFS= read -r case; do
    # Other flags may give other bits; that one and two threads give the same still holds.
    output=$(python3 tests/golden/golden.py build-audit/acinus "$case" 2>&1) ||
      [[ $output == *"not the recorded state"* || $output == *"recorded: None"* ]] || {
      printf '%s\n' "$output" >&2
      fail "asserts: $case"
      continue
    }
    echo "asserts: $case is clean"
  done < <(ctest --test-dir build-audit -N -L golden | sed -nE 's/.*: golden_(.*)/\1/p')
}

parts=("$@")
[[ ${#parts[@]} -gt 0 ]] || parts=(memory threads asserts)
for part in "${parts[@]}"; do
  case $part in
    memory | threads | asserts) "check_$part" ;;
    *) usage >&2; exit 2 ;;
  esac
done
if [[ ${#failed[@]} -gt 0 ]]; then
  printf 'sanitize.sh: %d failed:\n' "${#failed[@]}" >&2
  printf '  %s\n' "${failed[@]}" >&2
  exit 1
fi
echo "sanitize.sh: nothing found in: ${parts[*]}"
