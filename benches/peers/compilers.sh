# Sourced after install.sh: how programs and generated C are compiled.
packages=$(echo "$venv"/lib/python3*/site-packages)
mujoco=$packages/mujoco
pinocchio="-isystem $packages/cmeel.prefix/include -isystem $packages/cmeel.prefix/include/eigen3
  -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS
  -DBOOST_FUSION_INVOKE_MAX_ARITY=12"
fast="-O3 -march=native"

# program NAME SOURCE COMPILER OPTIONS: bin/NAME from this C++, where that is newer.
program() {
  local to=$PEERS_DIR/bin/$1 from=$2 compiler=$3
  shift 3
  [ "$to" -nt "$from" ] || "$compiler" -std=c++17 -DNDEBUG "$from" "$@" -o "$to"
}

# What a compiler, or a generator, may take for one function: beyond it, the table has a dash.
patience=${PEERS_PATIENCE:-60}

# compile C COMPILER OPTIONS
compile() {
  local c=$1 compiler=$2
  shift 2
  timeout "$patience" "$compiler" $fast -fno-math-errno -DNDEBUG "$@" -fPIC -shared -w "$c" -o "${c%.c}.$compiler.so" -lm \
    || echo "$compiler gave up $c"
}
