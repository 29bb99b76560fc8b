# Sourced by run.sh: the peers' packages.
if ! command -v clang++-19 > /dev/null || ! command -v g++ > /dev/null || [ ! -e /usr/include/kdl/tree.hpp ]; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends clang-19 g++ liborocos-kdl-dev libeigen3-dev
fi
venv=$PEERS_DIR/venv
if [ ! -e "$venv/installed" ]; then
  python3 -m venv "$venv"
  "$venv/bin/pip" install -q pin==4.1.0 casadi==3.8.2 cmeel-eigen==3.4.1 mujoco==4.0.0 numpy
  # CppADCodeGen compiles with the CppAD of 2023 only, which Pinocchio's packages do not bring.
  "$venv/bin/pip" install -q --no-deps --target "$PEERS_DIR/cppad" cmeel-cppad==20230000.0
  "$venv/bin/pip" install -q --no-deps --target "$PEERS_DIR/cppadcg" cmeel-cppadcodegen==2.4.3
  mkdir -p "$PEERS_DIR/include/cppad"
  cp -rs "$PEERS_DIR/cppad/cmeel.prefix/include/cppad/." "$PEERS_DIR/include/cppad/"
  ln -sfn "$PEERS_DIR"/cppadcg/cmeel.prefix/include/cppad/cg{.hpp,} "$PEERS_DIR/include/cppad/"
  touch "$venv/installed"
fi
