#!/usr/bin/env bash
# The example `reach` beside Crocoddyl, in turn: time of an iteration and of the whole solve, µs.
#
#   benches/peers/reach/run.sh
#
# Needs a Rust toolchain and Python 3 with venv. Installs Crocoddyl in $PEERS_DIR/reach_venv (target/peers), with the
# Pinocchio that it is built for: with a newer one it crashes. ROUNDS (3) rounds.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
peers=${PEERS_DIR:-$root/target/peers}
mkdir -p "$peers"
. "$here/../venv.sh"
PEERS_DIR=$peers venv reach crocoddyl==3.2.1 pin==4.0.0 numpy
RUSTFLAGS="-C target-cpu=native" cargo build --release --manifest-path "$root/Cargo.toml" --target-dir "$peers/rust" \
  -p controllers --example reach
for _ in $(seq "${ROUNDS:-3}"); do
  echo "bgdyn     $("$peers/rust/release/examples/reach" --times)"
  echo "Crocoddyl $(OMP_NUM_THREADS=1 "$venv/bin/python" "$here/crocoddyl_runs.py" "$root/tests/golden/urdf/panda7.urdf" \
    "$root/tests/golden/mpc/reach_panda7.json")"
done
