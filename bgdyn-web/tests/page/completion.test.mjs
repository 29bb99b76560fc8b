// Where a cursor is in a YAML text, and what the schemas allow there. The schemas are those of the command.
import assert from "node:assert/strict";
import test from "node:test";
import { placeAt } from "../../page/yaml_place.js";
import { keysAt, valuesAt } from "../../page/schema_walk.js";
import { bgdyn } from "./native.mjs";

const mechanism = JSON.parse(bgdyn("schema"));
const scene = JSON.parse(bgdyn("schema", "--scene"));

/** Returns the place at `|`. */
const place = (text) => placeAt(text.replace("|", ""), text.indexOf("|"));
const keys = (schema, text) => keysAt(schema, place(text)).map((key) => key.label);
const values = (schema, text) => valuesAt(schema, place(text));

test("keys of the file, in an empty line and in a word", () => {
  assert.deepEqual(place("format: 1\n|\n").path, []);
  assert.ok(keys(mechanism, "format: 1\nli|\n").includes("links"));
  assert.deepEqual([...place("format: 1\nli|\nframes:\n").keys.keys()].sort(), ["format", "frames"]);
});

test("keys of a link: block, flow, and after other links", () => {
  const link = ["links", "[]"];
  for (const text of [
    "links:\n  - name: a\n    ma|\n",
    "links:\n- name: a\n  ma|\n",
    "links:\n  - ma|\n",
    "links:\n  - name: a\n    joint:\n      type: fixed\n    |\n  - name: b\n",
    "links:\n  - name: a\n    joint: { type: fixed }\n  - { name: b, ma|",
    "links: [{ name: a }, { ma| }]",
  ]) {
    assert.deepEqual(place(text).path, link, text);
    assert.ok(keys(mechanism, text).includes("mass"), text);
  }
});

test("keys of what a link has", () => {
  const joint = ["links", "[]", "joint"];
  for (const text of [
    "links:\n  - name: a\n    joint:\n      |",
    "links:\n  - name: a\n    joint: { |",
    "links:\n  - name: a\n    joint: { name: x,\n      ty|",
    "links:\n  - { name: a, joint: { name: x, | } }",
  ]) {
    assert.deepEqual(place(text).path, joint, text);
    assert.ok(keys(mechanism, text).includes("axis"), text);
  }
});

test("words and units of values", () => {
  const kinds = values(mechanism, "links:\n  - name: a\n    joint: { type: re| }").words;
  assert.ok(kinds.includes("revolute") && kinds.includes("spherical"));
  const masses = values(mechanism, "links:\n  - name: a\n    mass: 1 |").units;
  assert.ok(masses.includes("kg") && masses.includes("g"), masses.join());
  const methods = values(scene, "scene: 1\nintegration: { method: | }").words;
  assert.ok(methods.includes("rk4"));
});

test("an effect has the keys of its type", () => {
  const keysOf = (type) => keys(mechanism, `effects:\n  a: { type: ${type}, | }`);
  assert.ok(keysOf("coulomb").includes("kinetic") && !keysOf("coulomb").includes("stiffness"));
  assert.ok(keysOf("spring").includes("stiffness") && !keysOf("spring").includes("kinetic"));
  assert.ok(values(mechanism, "effects:\n  a: { type: |").words.includes("viscous"));
});

test("no place in a comment, and no text is an error", () => {
  assert.equal(place("# li|"), null);
  for (const text of ["|", "]]}}|", "- - - |", "a: 'b|", "a: {b: [c|", ":|", "\t|", "{a|"]) assert.doesNotThrow(() => place(text), text);
});
