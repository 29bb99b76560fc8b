// The generated code.
import { makeCodeView } from "../editor.js";
import { byId, make, save } from "../dom.js";

let written = [];
const showText = makeCodeView(byId("code"), "Generated code");

const chosen = () => written[byId("code-file").selectedIndex] ?? written[0];
const refresh = () => showText(chosen().text, chosen().name);

byId("code-file").addEventListener("change", refresh);
byId("code-save").addEventListener("click", () => written.length > 0 && save(chosen().name, chosen().text, "text/plain"));

export const code = {
  about: (files, active) => files[active],
  request: (file) => ({ command: "code", file, backend: byId("code-backend").value }),
  show: (files) => {
    const before = byId("code-file").selectedIndex;
    written = files;
    byId("code-file").replaceChildren(...files.map((file) => make("option", { textContent: file.name })));
    byId("code-file").selectedIndex = before < files.length ? Math.max(before, 0) : 0;
    refresh();
  },
  /** Calls `again` when another language is chosen. */
  watch: (again) => byId("code-backend").addEventListener("change", again),
};
