// Small helpers for the document.
export const byId = (id) => document.getElementById(id);

/** Makes an element with properties and children. */
export const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

/** Lets the browser save a text as a file. */
export const save = (name, text, type) => {
  const url = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
};

/** Returns the name of a file without its endings. */
export const stem = (name) => name.split(/[\\/]/).at(-1).split(".")[0];

/** Makes the tabs of a list work by mouse and by arrow keys; `chosen` receives the new tab's id. */
export const connectTabs = (list, chosen) => {
  const tabs = [...list.querySelectorAll('[role="tab"]')];
  const choose = (tab, focus) => {
    for (const one of tabs) {
      const selected = one === tab;
      one.setAttribute("aria-selected", selected);
      one.tabIndex = selected ? 0 : -1;
      byId(one.getAttribute("aria-controls")).hidden = !selected;
    }
    if (focus) tab.focus();
    chosen(tab.id.replace("tab-", ""));
  };
  for (const [i, tab] of tabs.entries()) {
    tab.addEventListener("click", () => choose(tab, false));
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step) choose(tabs[(i + step + tabs.length) % tabs.length], true);
    });
  }
  return (name) => choose(byId(`tab-${name}`), false);
};
