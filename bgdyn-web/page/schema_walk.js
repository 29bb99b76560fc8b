// Reads a JSON Schema of bgdyn: which keys and values it allows at a path.

/** Returns the schemas that a value may have: references, alternatives and conditions resolved by the keys it has. */
const alternatives = (root, schema, keys) => {
  if (!schema || typeof schema !== "object") return [];
  const inner = (one) => alternatives(root, one, keys);
  if (schema.$ref) return inner(schema.$ref.slice(2).split("/").reduce((at, key) => at?.[key], root));
  const found = [schema];
  for (const part of ["anyOf", "oneOf", "allOf"]) found.push(...(schema[part] ?? []).flatMap(inner));
  if (schema.if) {
    const wanted = Object.entries(schema.if.properties ?? {});
    const needed = schema.if.required ?? [];
    const open = wanted.some(([key]) => !keys.has(key));
    const holds = needed.every((key) => keys.has(key)) && wanted.every(([key, value]) => keys.get(key) === String(value.const));
    if (holds) found.push(...inner(schema.then));
    else if (!open) found.push(...inner(schema.else));
  }
  // Alternatives that differ in the constant of a key: the one that is written remains.
  const misfits = (one) => Object.entries(one.properties ?? {}).some(([key, value]) => value.const !== undefined && keys.get(key) && keys.get(key) !== String(value.const));
  return found.filter((one) => !misfits(one));
};

const step = (root, schemas, key) => schemas.flatMap((one) => {
  if (key === "[]") return one.items ? [one.items] : [];
  if (one.properties?.[key]) return [one.properties[key]];
  return typeof one.additionalProperties === "object" ? [one.additionalProperties] : [];
});

/** Returns the alternatives at a path; `keys` are those of the last mapping, with their values. */
const schemasAt = (root, path, keys) => {
  let schemas = [root];
  for (const key of path) {
    // What stands above is not known here: all of its alternatives count.
    const all = schemas.flatMap((one) => alternatives(root, one, new Map()).concat(conditional(root, one)));
    schemas = step(root, all, key);
  }
  return schemas.flatMap((one) => alternatives(root, one, keys));
};

/** Returns what conditions may add, whichever holds. */
const conditional = (root, schema) => {
  const all = alternatives(root, schema, new Map());
  return all.flatMap((one) => [one.then, one.else]).filter(Boolean).flatMap((one) => alternatives(root, one, new Map()));
};

const unique = (all) => [...new Map(all.map((one) => [one.label, one])).values()];

/** Returns the words that a schema allows: `enum` and `const`. */
const words = (root, schema) =>
  unique(alternatives(root, schema, new Map()).flatMap((one) => one.enum ?? (one.const !== undefined ? [one.const] : [])).map((word) => ({ label: String(word) }))).map((w) => w.label);

/** Returns the keys that may be written at a place: `{ label, info, needed }`. */
export const keysAt = (root, { path, keys }) => {
  const others = new Map(keys);
  const all = schemasAt(root, path, others);
  const needed = new Set(all.flatMap((one) => one.required ?? []));
  const found = all.flatMap((one) => Object.entries(one.properties ?? {}).map(([label, schema]) => {
    const described = [schema, ...alternatives(root, schema, new Map())].find((part) => part.description);
    return { label, info: described?.description ?? "", needed: needed.has(label), words: words(root, schema) };
  }));
  const named = all.flatMap((one) => one.propertyNames?.enum ?? []).map((label) => ({ label, info: "", needed: false, words: [] }));
  return unique([...found, ...named]);
};

/** Returns the values that a key may have: words, and units of quantities. */
export const valuesAt = (root, { path, keys, key }) => {
  const others = new Map(keys);
  others.delete(key);
  const values = step(root, schemasAt(root, path, others), key);
  const all = values.flatMap((one) => alternatives(root, one, new Map()));
  const patterns = all.map((one) => one.pattern).filter(Boolean);
  return { words: [...new Set(values.flatMap((one) => words(root, one)))], units: [...new Set(patterns.flatMap(units))] };
};

/** Returns the units in the pattern of a quantity: `… *(N[*·]m|N|kN)|…`. */
const units = (pattern) => {
  const at = pattern.indexOf("? *(");
  if (at < 0) return [];
  const start = at + 4;
  let depth = 1, end = start;
  while (end < pattern.length && depth > 0) depth += { "(": 1, ")": -1 }[pattern[end++]] ?? 0;
  const inner = pattern.slice(start, end - 1);
  const plain = inner.replace(/\(([^()|]*)\|[^()]*\)/g, "$1").replace(/\[(.)[^\]]*\]/g, "$1").replaceAll("\\", "");
  return plain.split("|");
};
