#!/usr/bin/env bash
# Measures everything anew and writes the tables of docs/embedded.md. A few minutes.
set -euo pipefail
cd "$(dirname "$0")"
. ./toolchain.sh
out=target/figures
mkdir -p "$out"

for cpu in m4f m7; do
  on "$cpu" "$cargo" run -q --release --bin figures | grep -E '^(figure|beyond);' >"$out/$cpu.txt"
  for robot in scara puma560 panda; do
    for scalar in f32 f64; do
      for how in generated textbook; do
        ./size.sh "$cpu" "$robot/$scalar/$how" "inverse dynamics" "mass matrix" \
          "forward dynamics" "control step" all >>"$out/$cpu.txt"
      done
    done
  done
done
"$rustc" --version >"$out/versions.txt"
qemu-system-arm --version | sed -n 1p >>"$out/versions.txt"
git rev-parse --short HEAD >>"$out/versions.txt"
python3 figures.py "$out" ../docs/embedded.md
