#!/usr/bin/env bash
# The first minutes with bgdyn, as a new user has them: times of builds from nothing, in a fresh clone of the last commit, beside
# the times that they may take.
#
#   benches/first_minutes.sh [--docs]
#
# Needs a Rust toolchain, and Python 3 with venv for the humanoid, which is left out where Python or its package cannot be had.
# Downloads of crates are not counted. --docs writes docs/first_minutes.md. Ends with 1 where a time is missed. Leave the machine
# alone meanwhile, for about ten minutes.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
docs=${1:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# As for a new user.
unset CARGO_INCREMENTAL CARGO_TARGET_DIR RUSTFLAGS CARGO_BUILD_JOBS
git clone -q "$root" "$work/bgdyn"
commit=$(git -C "$work/bgdyn" rev-parse --short HEAD)
table="| what | asked, s | measured, s |
|---|---|---|
"
missed=0

# now: the time, s.
now() { date +%s.%N; }

# less A B: A − B.
less() { awk "BEGIN { printf \"%.2f\", $1 - $2 }"; }

# row WHAT ASKED SECONDS: a line of the table.
row() {
  local line="| $1 | $2 | $(printf %.1f "$3") |"
  awk "BEGIN { exit !($3 <= $2) }" || { missed=1; line="| $1 | $2 | **$(printf %.1f "$3")** |"; }
  printf '%s\n' "$line"
  table+="$line
"
}

# timed COMMAND…: runs it quietly; `seconds` is how long it took.
timed() {
  local begun
  begun=$(now)
  "$@" >"$work/output" 2>&1 || { cat "$work/output"; exit 1; }
  seconds=$(less "$(now)" "$begun")
}

# shortest: `seconds` is the time of the shortest of three dev builds of the crate, after one that builds what it depends on.
shortest() {
  local least=""
  for k in 0 1 2 3; do
    printf '// %s\n' "$k" >>src/main.rs
    timed cargo build --offline
    [ "$k" -eq 0 ] && continue
    if [ -z "$least" ] || awk "BEGIN { exit !($seconds < $least) }"; then least=$seconds; fi
  done
  seconds=$least
}

# macro SPEC: `seconds` is what a dev build of a crate takes longer with the macro than with its text.
macro() {
  local name text
  name=$(basename "$1" .yaml)
  cp "$1" "specs/$name.yaml"
  "$work/cli/bin/bgdyn" generate "specs/$name.yaml" >src/text.rs 2>"$work/output"
  printf 'include!("text.rs");\nfn main() {}\n' >src/main.rs
  shortest
  text=$seconds
  printf 'bgdyn::bgdyn!("%s.yaml");\nfn main() {}\n' "$name" >src/main.rs
  shortest
  seconds=$(less "$seconds" "$text")
}

cd "$work/bgdyn"
cargo fetch --locked -q
timed cargo run --release -p controllers --example scara
row "the first command of README: \`cargo run --release -p controllers --example scara\`" 60 "$seconds"
# A folder of results of its own: it begins from nothing, too.
timed cargo install --offline --locked --path bgdyn-cli --root "$work/cli" --target-dir "$work/cli_target"
row "the command: \`cargo install --path bgdyn-cli\`" 75 "$seconds"

cargo new -q --vcs none "$work/head"
cd "$work/head"
mkdir specs
cp "$work/bgdyn/examples/first_model/specs/head.yaml" specs
printf 'bgdyn = { path = "../bgdyn" }\n' >>Cargo.toml
cp "$work/bgdyn/Cargo.lock" .
printf 'bgdyn::bgdyn!("head.yaml");\nfn main() {}\n' >src/main.rs
timed cargo build --offline
row "a crate of one's own with a first model ([first_model.md](first_model.md)): \`cargo build\`" 45 "$seconds"
printf 'bgdyn::bgdyn!("head.yaml");\nfn main() { println!("changed"); }\n' >src/main.rs
timed cargo build --offline
again=$seconds
macro "$work/bgdyn/specs/panda.yaml"
row "what the macro adds to such a build for seven axes (\`specs/panda.yaml\`)" 1.0 "$seconds"

if python3 -m venv "$work/venv" 2>"$work/output" &&
  "$work/venv/bin/pip" download -q --disable-pip-version-check --no-deps -d "$work" example-robot-data==6.0.0 2>"$work/output"; then
  python3 -m zipfile -e "$work"/example_robot_data-*.whl "$work/robots"
  urdf=$(find "$work/robots" -name g1_29dof_rev_1_0.urdf)
  "$work/cli/bin/bgdyn" import "$urdf" --base floating -o "$work/g1.yaml" >"$work/output" 2>&1
  macro "$work/g1.yaml"
  row "what it adds for a humanoid with 35 velocities (\`g1_29dof_rev_1_0.urdf\` of example-robot-data 6.0.0)" 8 "$seconds"
else
  echo "skipped: a humanoid. Needs Python 3 with venv, and the package example-robot-data"
fi
machine="$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores; $(rustc --version); $(date +%F), commit \`$commit\`"
page="# The first minutes

Times of builds from nothing, in a fresh clone, with the settings that Cargo comes with. Crates are downloaded before. $machine. Written by

\`\`\`sh
benches/first_minutes.sh --docs
\`\`\`

$table
A time in bold is longer than asked. What the macro adds is a dev build with \`bgdyn!\` less one with its text in place of it, with the functions that a spec has by default, the shortest of three each; the macro itself is not optimised in such builds. A build of the first model after a change of the program, not of the spec, takes $again s.

[Time to compile](compile_time.md) has what each mechanism of \`specs/\` costs."
if [ "$docs" = --docs ]; then
  printf '%s\n' "$page" >"$root/docs/first_minutes.md"
else
  printf '\n%s\n' "$page"
fi
exit "$missed"
