#!/usr/bin/env bash
# Simulated seconds a second: an arm that falls, in bgdyn, MuJoCo, Pinocchio, Drake and rapier, in turn: errors and times.
#
#   benches/peers/simulate/run.sh [--quick] [--docs]
#
# Needs a Rust toolchain, a C++ compiler and Python 3 with venv. Installs the peers in $PEERS_DIR/simulate_venv (target/peers).
# --docs writes docs/peers_simulate.md and its figure, else they are written in $PEERS_DIR. --quick tests the scripts: few
# steps, one round. PEERS_ROUNDS (3) rounds of times otherwise, in which all systems take turns. PEERS_PRIORITY=0 measures
# without priority on one core.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR/bin"
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)
. "$here/../venv.sh"
venv simulate pin==4.1.0 cmeel-eigen==3.4.1 mujoco==4.0.0 drake==1.51.1 numpy
. "$here/../cargo.sh"
. "$here/../compilers.sh"
cargo_release "-C target-cpu=native" -p peers_simulate -p peers_plots
cp "$PEERS_DIR/rust/$host/release"/{simulate,plots} "$PEERS_DIR/bin/"
robot=$root/tests/golden/specs/panda7.yaml
if [ ! -e "$PEERS_DIR/bin/describe" ]; then
  BGDYN_PEERS=$robot cargo_release "-C target-cpu=native" -p peers --bin describe
  cp "$PEERS_DIR/rust/$host/release/describe" "$PEERS_DIR/bin/"
fi
mkdir -p "$PEERS_DIR/robots/panda7"
"$PEERS_DIR/bin/describe" "$robot" "$PEERS_DIR/robots/panda7"
RUSTFLAGS="-C target-cpu=native" cargo build --release --manifest-path "$here/rapier/Cargo.toml" --target-dir "$PEERS_DIR/rapier"
cp "$PEERS_DIR/rapier/release/rapier-peer" "$PEERS_DIR/bin/rapier"
for compiler in clang++-19 clang++ g++; do
  if command -v $compiler > /dev/null; then break; fi
done
export CXX=$compiler
program simulate_runs "$here/runs.cpp" $compiler $fast -I "$here/../cpp" $pinocchio -isystem "$mujoco/include" \
  "$mujoco"/libmujoco.so.* -Wl,-rpath,"$mujoco"
"$venv/bin/python" "$here/compare.py" "$@"
