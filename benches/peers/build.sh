# Sourced by run.sh: compiles the programs that are timed, and the C that the peers generate.
program generated "$here/cpp/generated.cpp" g++ $fast -ldl
[ "$free" ] || program generated_lanes "$here/cpp/generated_lanes.cpp" g++ $fast -ldl
program pinocchio "$here/cpp/pinocchio.cpp" clang++-19 $fast $pinocchio
[ "$free" ] || program mujoco "$here/cpp/mujoco.cpp" clang++-19 $fast -isystem "$mujoco/include" "$mujoco"/libmujoco.so.* -Wl,-rpath,"$mujoco"
# Its library is compiled for any x86-64: with -march=native Eigen would align memory in another way.
[ "$free" ] || program kdl "$here/cpp/kdl.cpp" clang++-19 -O3 -isystem /usr/include/eigen3 -lorocos-kdl
program casadi_codegen "$here/cpp/casadi_codegen.cpp" clang++-19 -O1 -isystem "$packages/casadi/include" $pinocchio \
  -L"$packages/casadi" -lcasadi -Wl,-rpath,"$packages/casadi"
program cppad_codegen "$here/cpp/cppad_codegen.cpp" clang++-19 -O1 -isystem "$PEERS_DIR/include" $pinocchio -ldl

# Ours, with the machine's instructions and with those of any x86-64 (or other) machine.
ours() {
  BGDYN_PEERS=$specs cargo_release "$2" -p peers
  cp "$PEERS_DIR/rust/$host/release/ours" "$PEERS_DIR/bin/$1"
}
ours ours "-C target-cpu=native"
cp "$PEERS_DIR/rust/$host/release/describe" "$PEERS_DIR/bin/"
if [ -z "$free" ]; then
  ours ours_portable ""
  RUSTFLAGS="-C target-cpu=native" cargo build --release --manifest-path "$here/dynibo/Cargo.toml" \
    --target-dir "$PEERS_DIR/dynibo"
  cp "$PEERS_DIR/dynibo/release/dynibo-peer" "$PEERS_DIR/bin/dynibo"
fi

# generate SPEC: the description for the peers, and their C, by both compilers.
generate() {
  local name folder
  name=$(basename "$1" .yaml)
  folder=$PEERS_DIR/robots/$name
  [ "$folder/done" -nt "$1" ] && return
  echo "generating C for $name"
  rm -rf "$folder"
  mkdir -p "$folder"
  "$PEERS_DIR/bin/describe" "$1" "$folder"
  "$PEERS_DIR/bin/bgdyn" ops --json --methods inverse_dynamics,mass_matrix,forward_dynamics "$1" > "$folder/operations.json"
  # CasADi stops at 70,000 instructions: compilers take minutes for more.
  timeout "$patience" "$PEERS_DIR/bin/casadi_codegen" "$folder/$name.flat" "$folder" 70000 || echo "CasADi: no more for $name"
  timeout "$patience" "$PEERS_DIR/bin/cppad_codegen" "$folder/$name.flat" "$folder" || echo "CppADCodeGen: no more for $name"
  local c small
  small=$(awk 'NR > 3 { n += $3 == "floating" ? 6 : 1 } END { print n <= 12 }' "$folder/$name.flat")
  for c in "$folder"/*.c; do
    compile "$c" clang-19 -ffp-contract=fast
    # Long ones take gcc minutes, and lanes are measured for short ones only.
    [ "$small" = 1 ] || continue
    compile "$c" gcc
    case $c in */casadi_*) lanes "$c" ;; esac
  done
  touch "$folder/done"
}

# CasADi's C for vectors of 8 doubles: constants spread over the lanes, arguments taken as given, everything but the
# function itself left out.
lanes() {
  grep -q avx512f /proc/cpuinfo || return 0
  local c=${1%.c}
  sed -E 's/=([-+]?[0-9][0-9.e+-]*);/=all_lanes(\1);/
    s/=(arg\[[0-9]\])\? (arg\[[0-9]\]\[[0-9]+\]) : 0;/=\2;/
    /casadi_real casadi_sq/d; /define casadi_sq/d; /casadi_int_size/d; /casadi_real_size/d
    /f_default_in\(/,/^}/d' "$1" > "$c.lanes"
  timeout "$patience" gcc $fast -mprefer-vector-width=512 -DNDEBUG -fPIC -shared -w -include "$here/cpp/lanes.h" -x c "$c.lanes" \
    -o "$c.lanes.so" -lmvec -lm || echo "no lanes for $1"
}
