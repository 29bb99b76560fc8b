#!/usr/bin/env bash
# Generated models beside other systems: installs the peers, times them in turn with ours, compares the
# results, writes a table and a plot.
#
#   benches/peers/run.sh [--docs] [SPEC ...]
#
# Needs a Rust toolchain, Python 3 with venv, and, where the packages below are missing, apt. Without SPEC the
# robots of docs/peers.md. Peers, C and libraries stand in $PEERS_DIR (target/peers); --docs writes docs/peers.md
# and docs/peers.svg, else they are written there. PEERS_ROUNDS (5) rounds of PEERS_SECONDS (0.05) per measurement.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR"/{bin,robots}
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)

docs=
[ "${1:-}" = --docs ] && { docs=--docs; shift; }
if [ $# -eq 0 ]; then
  cd "$root"
  set -- tests/golden/specs/{scara4,puma560,panda7}.yaml specs/{ur5,torso}.yaml "$here"/specs/tree9.yaml \
    tests/golden/specs/chain8.yaml tests/chains/chain16.yaml tests/golden/specs/chain{32,64}.yaml
fi
specs=$(for spec in "$@"; do realpath "$spec"; done)

. "$here/install.sh"
. "$here/build.sh"
for spec in $specs; do generate "$spec"; done
"$PEERS_DIR/venv/bin/python" "$here/measure.py" $docs $specs
