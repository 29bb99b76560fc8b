#!/usr/bin/env bash
# Methods of controllers and identification beside Pinocchio and the C that CasADi generates from it, in turn.
#
#   benches/peers/control/run.sh [--docs] [SPEC ...]
#
# Needs a Rust toolchain, Python 3 with venv, and, where the packages below are missing, apt. Without SPEC the arms of
# docs/peers_control.md. Peers and C stand in $PEERS_DIR (target/peers); --docs writes docs/peers_control.md, else it is
# written there. PEERS_ROUNDS (5) rounds of PEERS_SECONDS (0.05) per measurement; PEERS_PATIENCE (60) seconds for a
# compiler with one function.
set -euo pipefail
control=$(cd "$(dirname "$0")" && pwd)
here=$(cd "$control/.." && pwd)
root=$(cd "$here/../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR"/{bin,control}
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)

docs=
if [ "${1:-}" = --docs ]; then docs=--docs; shift; fi
cd "$root"
[ $# -gt 0 ] || set -- tests/golden/specs/{scara4,puma560,panda7}.yaml specs/ur5.yaml
specs=$(realpath "$@")

. "$here/install.sh"
. "$here/compilers.sh"
program control_generated "$control/generated.cpp" g++ $fast -ldl
program control_pinocchio "$control/pinocchio.cpp" clang++-19 $fast $pinocchio
program control_codegen "$control/codegen.cpp" clang++-19 -O1 -isystem "$packages/casadi/include" $pinocchio \
  -L"$packages/casadi" -lcasadi -Wl,-rpath,"$packages/casadi"
. "$here/cargo.sh"
BGDYN_PEERS=$specs cargo_release "-C target-cpu=native" -p peers_control -p peers
cp "$PEERS_DIR/rust/$host/release"/{control,describe} "$PEERS_DIR/bin/"

for spec in $specs; do
  name=$(basename "$spec" .yaml)
  folder=$PEERS_DIR/control/$name
  [ "$folder/done" -nt "$spec" ] && continue
  echo "generating C for $name"
  rm -rf "$folder"
  mkdir -p "$folder"
  "$PEERS_DIR/bin/describe" "$spec" "$folder"
  "$PEERS_DIR/bin/control_codegen" "$folder/$name.flat" "$folder" 70000
  for c in "$folder"/*.c; do
    compile "$c" clang-19 -ffp-contract=fast
    compile "$c" gcc
  done
  touch "$folder/done"
done
"$venv/bin/python" "$control/compare.py" $docs $specs
