// Completion in the editor from the JSON Schema of the format.
import { placeAt } from "./yaml_place.js";
import { keysAt, valuesAt } from "./schema_walk.js";

/** Returns a source of completions; `schemaOf()` gives the schema, or null before it is there. */
export const completionSource = (schemaOf) => (context) => {
  const schema = schemaOf();
  if (!schema) return null;
  const word = context.matchBefore(/[\w.-]*/);
  const text = context.state.doc.toString();
  const place = placeAt(text, context.pos);
  if (!place) return null;
  const options = [];
  if (place.due !== "value") options.push(...keyOptions(schema, text, context.pos, place));
  if (place.due !== "key") options.push(...valueOptions(schema, context, word, place));
  if (options.length === 0 || (word.from === word.to && !context.explicit && place.due !== "value")) return null;
  return { from: word.from, options, validFor: /^[\w.-]*$/ };
};

const keyOptions = (schema, text, position, place) => {
  const written = /^\s*:/.test(text.slice(position).split("\n")[0].replace(/^[\w.-]*/, ""));
  const keys = keysAt(schema, place).filter(({ label }) => label === place.key || !place.keys.has(label));
  return keys.map(({ label, info, needed, words }) => ({
    label,
    type: "property",
    detail: words.length > 0 && words.length < 8 ? words.join(" | ") : needed ? "needed" : "",
    info,
    apply: written ? label : `${label}: `,
    boost: needed ? 2 : 0,
  }));
};

const valueOptions = (schema, context, word, place) => {
  const path = place.due === "key or value" ? { ...place, key: "[]" } : place;
  const { words, units } = valuesAt(schema, path);
  const before = context.state.sliceDoc(Math.max(0, word.from - 12), word.from);
  const afterNumber = /\d\s+$/.test(before);
  if (afterNumber) return units.map((label) => ({ label, type: "unit" }));
  return words.map((label) => ({ label, type: "enum" }));
};
