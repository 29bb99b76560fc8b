# Sourced by the steps of .ci and by firmware/run.sh. A step that cannot be made says so in one line, `SKIPPED: what: why; what to install`, and
# .ci/run lists all of these lines at its end. With CI_STRICT=1 each is a failure.

# skip WHAT WHY HOW: goes on, or ends the script with 1.
skip() {
  local line="SKIPPED: $1: $2; $3"
  echo "$line"
  [ -z "${CI_SKIPPED:-}" ] || echo "$line" >>"$CI_SKIPPED"
  if [ "${CI_STRICT:-}" = 1 ]; then
    echo "CI_STRICT=1: what is skipped is a failure" >&2
    exit 1
  fi
}

has() { command -v "$1" >/dev/null; }

# apt_get PACKAGE…: 0 where they are installed; 1, with the reason in `why`, where apt cannot be used here or has no
# such packages. Where it has them and does not install them, the script ends with 1.
apt_get() {
  local result=0
  # Steps that run beside each other install one after the other.
  ! has flock || { exec 8>"${TMPDIR:-/tmp}/bgdyn_ci_apt" && flock 8; }
  apt_get_alone "$@" || result=$?
  ! has flock || exec 8>&-
  return "$result"
}

apt_get_alone() {
  local sudo=() package said
  has apt-get || { why="there is no apt-get"; return 1; }
  if [ "$(id -u)" != 0 ]; then
    { has sudo && sudo -n true 2>/dev/null; } || { why="apt-get needs root"; return 1; }
    sudo=(sudo -n)
  fi
  "${sudo[@]}" apt-get update -qq -o APT::Update::Error-Mode=any >/dev/null 2>&1 ||
    { why="apt-get update fails: no package server"; return 1; }
  for package in "$@"; do
    apt-cache show "$package" >/dev/null 2>&1 || { why="apt has no package $package"; return 1; }
  done
  said=$("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "$@" 2>&1) ||
    { echo "$said" >&2; echo "FAILED: apt-get install $*" >&2; exit 1; }
}
