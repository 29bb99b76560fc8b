// The command bgdyn, natively built, for comparison; files in folders that are removed at the end.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

/** The root of the repository. */
export const root = fileURLToPath(new URL("../../..", import.meta.url));
const command = process.env.BGDYN ?? join(root, process.env.CARGO_TARGET_DIR ?? "target", "debug/bgdyn");

/** Returns what the command prints to stdout. */
export const bgdyn = (...words) => execFileSync(command, words, { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 });

/** Calls `use` with a new folder; returns the texts of the files that it asks for. */
export const written = (names, use) => {
  const folder = mkdtempSync(join(tmpdir(), "bgdyn-page-"));
  try {
    use(folder);
    return names.map((name) => readFileSync(join(folder, name), "utf8"));
  } finally {
    rmSync(folder, { recursive: true });
  }
};
