// The bond graph, as an image: nothing in it can act in the page.
import { byId, make, save, stem } from "../dom.js";

let drawn = null;

byId("graph-save").addEventListener("click", () => drawn && save(`${stem(drawn.file.name)}.svg`, drawn.svg, "image/svg+xml"));
byId("graph-fit").addEventListener("change", ({ target }) => byId("graph").classList.toggle("fit", target.checked));
byId("graph").classList.add("fit");

export const graph = {
  about: (files, active) => files[active],
  request: (file) => ({ command: "graph", file }),
  show: (svg, file) => {
    if (drawn) URL.revokeObjectURL(drawn.url);
    const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
    drawn = { svg, file, url };
    byId("graph").replaceChildren(make("img", { src: url, alt: `Bond graph of ${file.name}` }));
  },
};
