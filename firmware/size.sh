#!/usr/bin/env bash
# Flash of functions: `size.sh CPU ROBOT/SCALAR/HOW FUNCTION…` prints for each function the bytes that
# a program with it has more than the same program without, code and constants with all they call.
set -euo pipefail
cd "$(dirname "$0")"
. ./toolchain.sh
cpu=$1 subject=$2
shift 2

bytes() {
  PROBE="$subject/$1" on "$cpu" "$cargo" build -q --release --bin flash
  size "target/$target/release/flash" | awk 'NR == 2 { print $1 + $2 }'
}

none=$(bytes none)
for function in "$@"; do
  echo "flash;${subject//\//;};$function;$(($(bytes "$function") - none))"
done
