#!/usr/bin/env bash
# MJCFs of Python packages: imports all those of the suite of dm_control and of gymnasium, gymnasium-robotics and
# robosuite, and compares mass matrix and bias with MuJoCo's.
#
#   benches/peers/mjcf.sh [TABLE.md]
#
# Needs a Rust toolchain and Python 3 with venv and pip. What it installs is in $PEERS_DIR (target/peers).
set -euo pipefail
cd "$(dirname "$0")/../.."
dir=${PEERS_DIR:-target/peers}/mjcf
mkdir -p "$dir"
[ -x "$dir/venv/bin/python" ] || python3 -m venv "$dir/venv"
"$dir/venv/bin/pip" install -q --disable-pip-version-check mujoco==4.0.0 numpy
if [ ! -d "$dir/files" ]; then
  "$dir/venv/bin/pip" download -q --disable-pip-version-check --no-deps -d "$dir" \
    dm_control==1.0.50 gymnasium==1.4.0 gymnasium-robotics==1.4.2 robosuite==1.5.2
  for wheel in "$dir"/*.whl; do
    "$dir/venv/bin/python" -m zipfile -e "$wheel" "$dir/wheels"
  done
  mkdir "$dir/files"
  mv "$dir/wheels/dm_control/suite" "$dir/files/dm_control_suite"
  mv "$dir/wheels/gymnasium/envs/mujoco/assets" "$dir/files/gymnasium"
  mv "$dir/wheels/gymnasium_robotics/envs/assets" "$dir/files/gymnasium_robotics"
  mv "$dir/wheels/robosuite/models/assets" "$dir/files/robosuite"
fi
cargo build --release -p bgdyn-cli
"$dir/venv/bin/python" benches/peers/mjcf.py target/release/bgdyn "$dir/files" "$@"
