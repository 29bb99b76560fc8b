# Sourced by run.sh: installs packages of Python in $PEERS_DIR once.

# venv NAME PACKAGE…: sets $venv, the folder of the environment NAME with these packages.
venv() {
  venv=$PEERS_DIR/$1_venv
  [ -e "$venv/installed" ] && return
  python3 -m venv "$venv"
  "$venv/bin/pip" install -q "${@:2}"
  touch "$venv/installed"
}
