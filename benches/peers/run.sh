#!/usr/bin/env bash
# Generated models beside other systems: installs the peers, times them in turn with ours, compares the
# results, writes a table and a plot.
#
#   benches/peers/run.sh [--free] [--docs] [SPEC ...]
#
# Needs a Rust toolchain, Python 3 with venv, and, where the packages below are missing, apt. Without SPEC the
# robots of docs/peers.md, with --free only its machines with a floating joint, and only their part of the page; one is
# the TALOS of the Python package example-robot-data, which is imported by the command. Peers, C and libraries stand in
# $PEERS_DIR (target/peers); --docs writes docs/peers.md and docs/peers.svg, else they are written there. PEERS_ROUNDS (5) rounds of PEERS_SECONDS (0.05) per measurement.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export PEERS_DIR=${PEERS_DIR:-$root/target/peers}
mkdir -p "$PEERS_DIR"/{bin,robots}
PEERS_DIR=$(cd "$PEERS_DIR" && pwd)

options= free= talos=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --docs) options+=" $1" ;;
    --free) options+=" $1" free=1 ;;
    *) echo "unknown option $1" >&2; exit 2 ;;
  esac
  shift
done
specs=$(for spec in "$@"; do realpath "$spec"; done)
if [ $# -eq 0 ]; then
  cd "$root"
  talos=$PEERS_DIR/specs/talos_reduced.yaml
  machines="tests/golden/joints/quadrotor_arm.yaml tests/golden/joints/anymal_floating.yaml"
  [ "$free" ] || set -- tests/golden/specs/{scara4,puma560,panda7}.yaml specs/{ur5,torso}.yaml "$here"/specs/tree9.yaml \
    tests/golden/specs/chain8.yaml tests/chains/chain16.yaml tests/golden/specs/chain{32,64}.yaml
  specs=$(realpath "$@" $machines)
fi

. "$here/install.sh"
. "$here/cargo.sh"
cargo_release "-C target-cpu=native" -p bgdyn-cli -p peers_plots
cp "$PEERS_DIR/rust/$host/release"/{bgdyn,plots} "$PEERS_DIR/bin/"
if [ "$talos" ]; then
  import_talos "$talos"
  specs+=$'\n'$talos
fi
. "$here/compilers.sh"
. "$here/build.sh"
for spec in $specs; do generate "$spec"; done
"$PEERS_DIR/venv/bin/python" "$here/measure.py" $options $specs
