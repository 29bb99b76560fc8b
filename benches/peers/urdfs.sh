#!/usr/bin/env bash
# URDFs as robot packages have them, with meshes, transmissions, mimic and safety tags: imports all those of the
# Python package example-robot-data, and compares mass matrix and bias with Pinocchio's.
#
#   benches/peers/urdfs.sh [TABLE.md]
#
# Needs a Rust toolchain and Python 3 with venv and pip. What it installs is in $PEERS_DIR (target/peers).
set -euo pipefail
cd "$(dirname "$0")/../.."
dir=${PEERS_DIR:-target/peers}/urdfs
mkdir -p "$dir"
[ -x "$dir/venv/bin/python" ] || python3 -m venv "$dir/venv"
"$dir/venv/bin/pip" install -q --disable-pip-version-check pin pyyaml
if [ ! -d "$dir/files" ]; then
  "$dir/venv/bin/pip" download -q --disable-pip-version-check --no-deps -d "$dir" example-robot-data==6.0.0
  "$dir/venv/bin/python" -m zipfile -e "$dir"/example_robot_data-*.whl "$dir/files"
fi
cargo build --release -p bgdyn-cli
"$dir/venv/bin/python" benches/peers/urdfs.py target/release/bgdyn "$dir/files" "$@"
