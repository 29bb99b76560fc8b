#!/usr/bin/env bash
# Generated C beside generated Rust, both in f32: instructions a call under QEMU, whether the results have the same bits,
# and flash. Writes the table of docs/embedded.md.
set -euo pipefail
cd "$(dirname "$0")"
. ./toolchain.sh
. ../.ci/skip.sh
if ! has arm-none-eabi-gcc; then
  skip "C beside Rust" "there is no arm-none-eabi-gcc" "install gcc-arm-none-eabi and libnewlib-arm-none-eabi"
  exit 0
fi
robots=(scara puma560 panda)
functions=("inverse dynamics" "mass matrix" "forward dynamics" "control step")
export FEATURES=c

out=target/c
mkdir -p "$out"
for cpu in m4f m7; do
  on "$cpu" "$cargo" run -q --release --features c --bin figures | grep -E ';f32;(C|generated);' >"$out/$cpu.txt"
done
for robot in "${robots[@]}"; do
  for how in C generated; do
    ./size.sh m4f "$robot/f32/$how" "${functions[@]}" >>"$out/m4f.txt"
  done
done

# number FILE KIND ROBOT HOW FUNCTION: the second of the numbers of a figure, the only one of a size.
number() { awk -F';' -v k="$2" -v r="$3" -v h="$4" -v f="$5" '$1 == k && $2 == r && $4 == h && $5 == f { print k == "flash" ? $6 : $7 }' "$1"; }
{
  echo "Measured with $("$rustc" --version | cut -d' ' -f1-2) and $(arm-none-eabi-gcc --version | sed -n 1p), \`-O3\`; Rust / C."
  echo
  echo "| robot | function | M4F: instructions | M7: instructions | M4F: flash, bytes |"
  echo "|---|---|---|---|---|"
  for robot in "${robots[@]}"; do
    for function in "${functions[@]}"; do
      row="| $robot | $function |"
      for cell in "m4f figure" "m7 figure" "m4f flash"; do
        read -r cpu kind <<<"$cell"
        rust=$(number "$out/$cpu.txt" "$kind" "$robot" generated "$function")
        c=$(number "$out/$cpu.txt" "$kind" "$robot" C "$function")
        row+=" $rust / $c |"
      done
      echo "$row"
    done
  done
} >"$out/table.md"
# Between its marks in the page.
sed -i -e '/<!-- c: begin -->/,/<!-- c: end -->/{/<!-- c: begin -->/{p;r '"$out/table.md"'
};/<!-- c: end -->/p;d}' ../docs/embedded.md
