// The operations of each generated function.
import { byId, make } from "../dom.js";

const KINDS = [["mul", "×"], ["add", "+ −"], ["div", "÷"], ["sqrt", "√"], ["sincos", "sin, cos"], ["other", "other"]];

const row = (name, counts, formulation) => make("tr", {},
  make("th", { scope: "row", textContent: name }),
  ...KINDS.map(([kind]) => make("td", { textContent: counts[kind] })),
  make("td", { textContent: counts.mul + counts.add, className: "sum" }),
  make("td", { textContent: formulation, className: "words" }));

export const counts = {
  about: (files, active) => files[active],
  request: (file) => ({ command: "counts", file }),
  show: (answer) => {
    const heads = ["function", ...KINDS.map(([, sign]) => sign), "× and + −", "formulation"];
    const table = make("table", {},
      make("caption", { textContent: "What one call of a function of the generated code takes: multiplications, additions, divisions, roots, pairs of sine and cosine." }),
      make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col", textContent: head })))),
      make("tbody", {}, ...answer.order.map((name) => row(name, answer.functions[name], answer.formulations[name]))));
    byId("counts").replaceChildren(table);
  },
};
