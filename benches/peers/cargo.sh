# Sourced by run.sh: builds of this workspace, and the robot that is imported.
host=$(rustc -vV | sed -n 's/^host: //p')

# cargo_release FLAGS OPTIONS: a build with these flags of the compiler. The generator runs while compiling, so it need
# not be fast itself.
cargo_release() {
  RUSTFLAGS=$1 cargo build --release --manifest-path "$root/Cargo.toml" --target "$host" --target-dir "$PEERS_DIR/rust" \
    --config 'profile.release.package.bgdyn-codegen.opt-level=1' "${@:2}"
}

# import_talos SPEC: the humanoid TALOS, its grippers closed by one joint each, free in the world.
import_talos() {
  local files=$PEERS_DIR/urdfs/files
  [ -e "$1" ] && return
  mkdir -p "$PEERS_DIR/urdfs" "$(dirname "$1")"
  if [ ! -d "$files" ]; then
    "$venv/bin/pip" download -q --disable-pip-version-check --no-deps -d "$PEERS_DIR/urdfs" example-robot-data==6.0.0
    "$venv/bin/python" -m zipfile -e "$PEERS_DIR"/urdfs/example_robot_data-*.whl "$files"
  fi
  "$PEERS_DIR/bin/bgdyn" import "$(find "$files" -name talos_reduced.urdf)" --base floating -o "$1"
  "$venv/bin/python" "$here/depth_first.py" "$1"
}
