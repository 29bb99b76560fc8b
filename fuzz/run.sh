#!/usr/bin/env bash
# Fuzzes reader, check and importer: fuzz/run.sh [MINUTES], 30 if not given. Begins with the specs, scenes and URDFs
# of the repository. Needs a nightly compiler and cargo-fuzz (`cargo install cargo-fuzz`).
set -euo pipefail
cd "$(dirname "$0")"
mkdir -p corpus/any_text
find .. \( -path ../target -o -path ./target \) -prune -o \( -name '*.yaml' -o -name '*.urdf' \) -size -40k -print |
  while IFS= read -r file; do
    cp "$file" "corpus/any_text/$(sha1sum < "$file" | cut -c1-16)"
  done
cargo +nightly fuzz run any_text --fuzz-dir . -- -max_total_time=$((${1:-30} * 60)) -timeout=10 -max_len=20000 \
  -rss_limit_mb=4096 -dict=words.dict -print_final_stats=1
