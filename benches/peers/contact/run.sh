#!/usr/bin/env bash
# Closed forms of contact in bgdyn, MuJoCo and Drake, in turn: errors, and times for a simulated second.
#
#   benches/peers/contact/run.sh [--quick] [--docs]
#
# Needs a Rust toolchain and Python 3 with venv. Installs the peers in $PEERS_DIR/contact_venv (target/peers). --docs writes
# docs/peers_contact.md and its figures, else they are written in $PEERS_DIR. --quick tests the scripts: long steps, one
# round. PEERS_ROUNDS (3) rounds of times otherwise, in which all systems take turns. PEERS_PRIORITY=0 measures without
# priority on one core.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR/bin"
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)
. "$here/../venv.sh"
venv contact mujoco==4.0.0 drake==1.51.1 pyyaml==6.0.2
. "$here/../cargo.sh"
cargo_release "-C target-cpu=native" -p peers_contact -p peers_plots
cp "$PEERS_DIR/rust/$host/release"/{contact,plots} "$PEERS_DIR/bin/"
"$venv/bin/python" "$here/compare.py" "$@"
