// The equations of motion: typeset, as text, as LaTeX.
import katex from "katex";
import "katex/dist/katex.min.css";
import { byId, make, save, stem } from "../dom.js";

let written = null;

const typeset = (latex, displayMode) => {
  const box = make("div");
  box.innerHTML = katex.renderToString(latex, { displayMode, throwOnError: false, maxExpand: Infinity });
  return box;
};

/** Turns `% q_1: rail, m; P_1 in $\mathrm{N}$` to a line of text with formulas. */
const legend = (line) => {
  const words = line.replace(/^% */, "").replace(/\b([qP])_(\w+)/g, (_, letter, index) => `$${letter}_{${index}}$`);
  const parts = words.split("$");
  return make("p", {}, ...parts.map((part, i) => (i % 2 ? make("span", {}, ...typeset(part, false).childNodes) : part)));
};

const typesetAll = (latex) => {
  const lines = latex.split("\n");
  const legends = lines.filter((line) => line.startsWith("%")).map(legend);
  const formulas = latex.match(/\\begin\{align\*\}[^]*?\\end\{align\*\}/g) ?? [];
  return [...legends, ...formulas.map((formula) => typeset(formula, true))];
};

const refresh = () => {
  if (!written) return;
  const form = byId("equations-form").value;
  const shown = form === "set" ? typesetAll(written.answer.latex) : [make("pre", { textContent: written.answer[form] })];
  byId("equations").replaceChildren(...shown);
};

byId("equations-form").addEventListener("change", refresh);
byId("equations-save").addEventListener("click", () => written && save(`${stem(written.file.name)}.tex`, written.answer.latex, "text/plain"));

export const equations = {
  about: (files) => files.mechanism,
  request: (file) => ({ command: "equations", file, limit: Math.max(1, Number(byId("equations-limit").value) || 1) }),
  show: (answer, file) => {
    written = { answer, file };
    refresh();
  },
  /** Calls `again` when another limit is given. */
  watch: (again) => byId("equations-limit").addEventListener("change", again),
};
