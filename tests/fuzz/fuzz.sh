#!/usr/bin/env bash
# Looks for inputs that break a reader of files, guided by what code they reach.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
usage: tests/fuzz/fuzz.sh SECONDS [TARGET...]

Builds the readers with clang 16, AddressSanitizer and UndefinedBehaviorSanitizer in build-fuzz and
lets libFuzzer look for faults in each TARGET (default: all) for SECONDS. What it found stands in
build-fuzz/found/TARGET: put it into tests/fuzz/corpus/TARGET once it is mended. Corpora grow in
build-fuzz/corpus. Exit code 1 if something was found.
Packages: clang-16, libclang-rt-16-dev, llvm-16.
TEXT
}

[[ $# -ge 1 && $1 =~ ^[0-9]+$ ]] || { usage >&2; exit 2; }
seconds=$1
shift
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(
  scene law network surface image_tiff image_nifti image_nrrd image_meta image_hdf5 image_zarr checkpoint run_file study
  summary submission)
cmake -G Ninja -B build-fuzz -DCMAKE_CXX_COMPILER=clang++-16 -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g" \
  -DACINUS_FUZZ=ON -DACINUS_SANITIZE=ON -DACINUS_BENCH=OFF -DACINUS_PRECOMPILE=ON >/dev/null
cmake --build build-fuzz -j "${ACINUS_JOBS:-$(nproc)}" --target fuzz_coverage fuzz_replay
export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.txt:print_suppressions=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
# HDF5 asks for as much memory as a damaged file says, and copes with a refusal.
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1024
failed=0
for target in "${targets[@]}"; do
  corpus=build-fuzz/corpus/$target found=build-fuzz/found/$target
  mkdir -p -- "$corpus" "$found"
  kept=()  # past failures and what reaches new code, where there are any
  [[ ! -d tests/fuzz/corpus/$target ]] || kept=("tests/fuzz/corpus/$target")
  build-fuzz/tests/fuzz_replay --seeds "$target" "$corpus"
  ACINUS_FUZZ_TARGET=$target build-fuzz/tests/fuzz_coverage -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -detect_leaks=0 -print_final_stats=1 -artifact_prefix="$found/" "$corpus" "${kept[@]}" || failed=1
done
exit "$failed"
