#!/usr/bin/env bash
# Builds the controllers, runs them under QEMU and fails where one misses: efforts beside the host's,
# instructions, stack, flash, and whether any f64 is left in what computes in f32.
set -euo pipefail
cd "$(dirname "$0")"
. ./toolchain.sh
. ../tests/skip.sh
programs=(scara puma560 payload)

# run CPU FLAGS…: builds the controllers, all at once because each is linked on one core, and runs them.
run() {
  local cpu=$1 program
  shift
  on "$cpu" "$cargo" build -q --release "$@" $(printf -- '--bin %s ' "${programs[@]}")
  for program in "${programs[@]}"; do
    on "$cpu" "$cargo" run -q --release "$@" --bin "$program"
  done
}

# What the compiler calls for f64 in software, by the ABI of Arm and by its own names.
soft_double='__aeabi_(c?d[a-z]|f2d|u?i2d|u?l2d)|__[a-z]*(df[2-3]|[dsx]fdf2|dfsf2|dfsi|dfdi|sidf|didf)$'
# no_double FOLDER PROGRAM…
no_double() {
  local folder=$1 program symbols found
  shift
  for program in "$@"; do
    symbols=$(readelf -sW "target/$folder/release/$program" | awk '{ print $8 }')
    grep -qE 'main|_start' <<<"$symbols" || { echo "MISSED: $program has no symbols to search"; exit 1; }
    found=$(grep -E "$soft_double" <<<"$symbols" || true)
    if [ -n "$found" ]; then
      echo "MISSED: f64 in $program:" $found
      exit 1
    fi
    echo "$program: no f64"
  done
}

echo "== Cortex-M4F, f32"
run m4f
no_double "$target" "${programs[@]}"

echo "== Cortex-M4F, f32, opt-level \"s\""
CARGO_PROFILE_RELEASE_OPT_LEVEL=s run m4f
no_double "$target" "${programs[@]}"

echo "== Cortex-M7, f32 and f64"
run m7
run m7 --features double

riscv=riscv32imafc-unknown-none-elf
if ! command -v qemu-riscv32 >/dev/null; then
  skip "firmware on RISC-V" "there is no qemu-riscv32" "install qemu-user"
elif [ -z "${CARGO_UNSTABLE_BUILD_STD:-}" ] && [ ! -d "$("$rustc" --print sysroot)/lib/rustlib/$riscv" ]; then
  skip "firmware on RISC-V" "no library for $riscv" "\`rustup target add $riscv\`"
else
  for level in 3 s; do
    echo "== RISC-V (RV32IMAFC), f32, opt-level $level"
    CARGO_PROFILE_RELEASE_OPT_LEVEL=$level "$cargo" run -q --release -p riscv --target "$riscv"
    no_double "$riscv" riscv
  done
fi

echo "== instructions, stack"
for cpu in m4f m7; do
  figures=$(on "$cpu" "$cargo" run -q --release --bin figures) || { echo "$figures" | grep -v '^figure;'; exit 1; }
  # The generated functions in f32.
  echo "$figures" | sed -n "s/^figure;\(.*\);f32;generated;/$cpu \1: /p" | tr ';' ' '
  echo "$figures" | sed -n "s/^root;f32;\(.*\)/$cpu square root: \1/p"
done

echo "== flash of the SCARA's inverse dynamics, mass matrix and forward dynamics in f32"
flash=$(./size.sh m4f scara/f32/generated all)
echo "${flash##*;} bytes, 8192 allowed"
[ "${flash##*;}" -lt 8192 ]
