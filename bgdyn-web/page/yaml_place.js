// Finds where a cursor is in a YAML text that is being written: the path of keys, the keys beside it, and whether a key
// or a value is due. It reads block and flow collections as far as specs use them, and no text is an error.

/** A mapping or a sequence. `keys`: the keys of a mapping with their scalar values. */
const container = (kind, path, indent) => ({ kind, path, indent, keys: new Map() });

const CURSOR = "\u0001";
const clean = (word) => word.replaceAll(CURSOR, "").trim().replace(/^(["'])(.*)\1$/, "$2");

/**
 * Returns `{ path, keys, due: "key" | "value", key }` for the cursor at `position`: the path of the mapping or sequence
 * that it is in, with "[]" for an item; the key whose value is due.
 */
export const placeAt = (text, position) => {
  const reader = new Reader();
  const marked = text.slice(0, position) + CURSOR + text.slice(position);
  for (const line of marked.split("\n")) reader.line(line);
  return reader.place;
};

class Reader {
  place = null;
  /** Open block collections, from the outside. */
  blocks = [container("mapping", [], 0)];
  /** Open flow collections: `{ … }`, `[ … ]`, with the key that is being read. */
  flows = [];

  line(line) {
    if (this.flows.length > 0) return this.flow(line);
    const hasCursor = line.includes(CURSOR);
    if (!hasCursor && /^\s*(#|$)/.test(line)) return;
    let column = line.search(/[^ ]/);
    let rest = line.slice(column);
    while (/^-( |$|\u0001)/.test(rest)) {
      this.item(column);
      const gap = rest.slice(1).search(/[^ ]/);
      const step = gap < 0 ? 2 : 1 + gap;
      column += step;
      rest = rest.slice(step);
      // The keys of an item stand in the column of its first one.
      this.blocks.at(-1).indent = column;
    }
    if (rest.startsWith("#")) return;
    const found = /^([^\s:#{}[\],"'][^:#{}[\],]*|"[^"]*"|'[^']*'):(?=\s|$|\u0001)(.*)$/.exec(rest);
    if (!found) return this.bare(rest, column);
    const key = clean(found[1]);
    const mapping = this.mapping(column);
    mapping.keys.set(key, null);
    if (found[1].includes(CURSOR)) this.found(mapping, "key", key);
    this.open = { mapping, key, column };
    this.value(found[2]);
  }

  /** Opens an item of a sequence whose dashes are in a column. */
  item(column) {
    const above = this.enclosing(column, true);
    this.blocks.push(container("mapping", [...above, "[]"], column + 1));
  }

  /** Returns the path of what a line in a column belongs to; closes what it leaves. */
  enclosing(column, dash) {
    const open = this.open;
    while (this.blocks.length > 1 && this.blocks.at(-1).indent > column) this.blocks.pop();
    const last = this.blocks.at(-1);
    // A sequence may stand in the column of its key.
    if (open && open.mapping === last && (column > open.column || (dash && column === open.column))) return [...last.path, open.key];
    const key = [...last.keys.keys()].at(-1);
    return dash && key !== undefined ? [...last.path, key] : last.path;
  }

  /** Returns the mapping whose keys stand in a column. */
  mapping(column) {
    const last = this.blocks.at(-1);
    if (last.indent === column) return last;
    if (column > last.indent) {
      const inner = container("mapping", this.enclosing(column, false), column);
      this.blocks.push(inner);
      return inner;
    }
    while (this.blocks.length > 1 && this.blocks.at(-1).indent > column) this.blocks.pop();
    return this.blocks.at(-1);
  }

  /** A line without a key: a word that is being written, or the rest of a long value. */
  bare(rest, column) {
    if (/^[{[]/.test(rest)) {
      const last = this.blocks.at(-1);
      this.open = null;
      return this.flow(rest, last.path);
    }
    if (!rest.includes(CURSOR)) return;
    const last = this.blocks.at(-1);
    const item = last.path.at(-1) === "[]" && last.indent === column && last.keys.size === 0;
    const mapping = this.mapping(column);
    this.found(mapping, item ? "key or value" : "key", clean(rest));
  }

  /** The value after a key of a block. */
  value(text) {
    const { mapping, key } = this.open;
    const start = text.search(/[^ ]/);
    if (start >= 0 && (text[start] === "{" || text[start] === "[")) return this.flow(text, [...mapping.path, key]);
    mapping.keys.set(key, clean(text.replace(/ #.*/, "")));
    if (text.replace(/(^| )#.*/, "").includes(CURSOR)) this.found(mapping, "value", key);
  }

  /** Reads a line of flow collections; `path` is that of the first one. */
  flow(text, path) {
    let word = "";
    const last = () => this.flows.at(-1);
    const pathOfValue = () => {
      const at = last();
      if (!at) return path ?? [];
      return at.kind === "sequence" ? [...at.path, "[]"] : [...at.path, at.key ?? ""];
    };
    const end = () => {
      const at = last();
      if (!at) return;
      const due = at.kind === "mapping" && at.key === null ? "key" : "value";
      if (word.includes(CURSOR)) {
        this.found(at, at.kind === "sequence" ? "key or value" : due, at.kind === "sequence" ? "[]" : due === "key" ? clean(word) : at.key);
      }
      if (at.kind === "mapping" && due === "value") at.keys.set(at.key, clean(word));
      else if (at.kind === "mapping" && clean(word)) at.keys.set(clean(word), null);
      if (at.kind === "mapping") at.key = null;
      word = "";
    };
    let quote = null;
    for (let i = 0; i < text.length; i++) {
      const letter = text[i];
      if (quote) {
        if (letter === quote) quote = null;
        word += letter;
      } else if (letter === '"' || letter === "'") {
        quote = letter;
        word += letter;
      } else if (letter === "#" && (i === 0 || text[i - 1] === " ")) {
        break;
      } else if (letter === "{" || letter === "[") {
        const inner = { ...container(letter === "{" ? "mapping" : "sequence", pathOfValue(), 0), key: null };
        if (word.includes(CURSOR)) end();
        this.flows.push(inner);
        word = "";
      } else if (letter === "}" || letter === "]") {
        end();
        this.flows.pop();
        if (last()?.kind === "mapping") last().keys.set(last().key ?? "", "");
      } else if (letter === "," && last()) {
        end();
      } else if (letter === ":" && last()?.kind === "mapping" && last().key === null && /[\s\u0001]|$/.test(text[i + 1] ?? "")) {
        if (word.includes(CURSOR)) this.found(last(), "key", clean(word));
        last().key = clean(word);
        last().keys.set(last().key, null);
        word = "";
      } else {
        word += letter;
      }
    }
    if (word.includes(CURSOR)) end();
  }

  found(mapping, due, key) {
    this.place ??= { path: mapping.path, keys: mapping.keys, due, key };
  }
}
