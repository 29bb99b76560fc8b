#!/usr/bin/env bash
# Mechanisms with closed loops in bgdyn, Pinocchio, MuJoCo and Drake: gaps, errors, energies, times.
#
#   benches/peers/loops/run.sh [--quick | --without-times] [--docs]
#
# Needs a Rust toolchain and Python 3 with venv. Installs the peers in $PEERS_DIR/loops_venv (target/peers). --docs writes
# docs/peers_loops.md and docs/peers_loops.svg, else they are written in $PEERS_DIR. --quick tests the scripts: short runs,
# one round; --without-times measures errors alone. PEERS_ROUNDS (3) rounds of times otherwise, in which all runs take turns.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR/bin"
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)
. "$here/../venv.sh"
venv loops pin==4.1.0 mujoco==4.0.0 drake==1.51.1 numpy
# The generator runs while compiling, so it need not be fast itself.
RUSTFLAGS="-C target-cpu=native" cargo build --release --manifest-path "$root/Cargo.toml" --target-dir "$PEERS_DIR/rust" \
  --config 'profile.release.package.bgdyn-codegen.opt-level=1' -p peers_loops -p peers_plots
cp "$PEERS_DIR"/rust/release/{loops,plots} "$PEERS_DIR/bin/"
"$venv/bin/python" "$here/measure.py" "$@"
