# Sourced by the scripts here: finds what builds for the target, and sets `cargo` to it.
target=thumbv7em-none-eabihf
variable=CARGO_TARGET_THUMBV7EM_NONE_EABIHF

if [ -d "$(rustc --print sysroot)/lib/rustlib/$target" ]; then
  cargo=cargo rustc=rustc
elif [ -x /usr/bin/rustc ] && [ -d "$(/usr/bin/rustc --print sysroot)/lib/rustlib/src/rust/library/core" ]; then
  # Debian's compiler comes without the target's library, and with Rust's source: build it.
  cargo=/usr/bin/cargo rustc=/usr/bin/rustc
  export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_UNSTABLE_BUILD_STD=core,panic_abort
  linker=$(compgen -c lld- | grep -E '^lld-[0-9]+$' | sort -V | tail -1)
  export "${variable}_LINKER=${linker:?no lld: apt-get install lld-19, or a newer one}"
  export "CARGO_TARGET_RISCV32IMAFC_UNKNOWN_NONE_ELF_LINKER=$linker"
else
  echo "no toolchain for $target: \`rustup target add $target\`, or on Debian" \
    "\`apt-get install rustc-web cargo-web rust-web-src lld-22\`" >&2
  exit 1
fi

# on CPU COMMAND…: with the flags and the board of m4f (as in .cargo/config.toml) or m7.
on() {
  local cpu=$1
  shift
  case $cpu in
    m4f) "$@" ;;
    m7)
      env "${variable}_RUSTFLAGS=-C target-cpu=cortex-m7" \
        "${variable}_RUNNER=qemu-system-arm -M mps2-an500 -nographic -monitor none -serial none -icount shift=8 -semihosting-config enable=on,target=native -kernel" \
        "$@"
      ;;
  esac
}
