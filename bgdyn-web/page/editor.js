// The editor of a file: YAML with completion, and faults at their place.
import { basicSetup } from "codemirror";
import { autocompletion } from "@codemirror/autocomplete";
import { indentWithTab } from "@codemirror/commands";
import { cpp } from "@codemirror/lang-cpp";
import { rust } from "@codemirror/lang-rust";
import { yaml } from "@codemirror/lang-yaml";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { linter, lintGutter, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState } from "@codemirror/state";
import { EditorView, keymap } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { completionSource } from "./completion.js";

// The colours are those of the page's style: they follow its dark mode.
const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--code-comment)" },
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--code-key)" },
  { tag: [tags.keyword, tags.modifier, tags.controlKeyword], color: "var(--code-word)" },
  { tag: [tags.string, tags.number, tags.bool], color: "var(--code-value)" },
  { tag: [tags.typeName, tags.className], color: "var(--code-type)" },
]);
const looks = [syntaxHighlighting(colours), EditorView.theme({}, { dark: false })];

/**
 * Makes the editor of a file in `parent`, named `label` for screen readers; `changed` is called after each change,
 * `schemaOf()` gives the schema of its format.
 */
export const makeEditor = (parent, label, changed, schemaOf) => new EditorView({
  parent,
  state: EditorState.create({
    extensions: [
      basicSetup,
      keymap.of([indentWithTab]),
      yaml(),
      looks,
      autocompletion({ override: [completionSource(schemaOf)], icons: false }),
      linter(null),
      lintGutter(),
      EditorView.contentAttributes.of({ "aria-label": label, spellcheck: "false" }),
      EditorView.updateListener.of((update) => update.docChanged && changed()),
    ],
  }),
});

/** Replaces the text of an editor. */
export const setText = (editor, text) => editor.dispatch({ changes: { from: 0, to: editor.state.doc.length, insert: text } });

/** Marks findings at their lines and columns. */
export const markFindings = (editor, findings) => {
  const diagnostics = findings.map((finding) => ({
    ...range(editor.state.doc, finding),
    severity: finding.severity === "warning" ? "warning" : "error",
    source: finding.rule,
    message: finding.help ? `${finding.message}\n${finding.help}` : finding.message,
  }));
  editor.dispatch(setDiagnostics(editor.state, diagnostics));
};

/** Puts the cursor at a finding. */
export const goTo = (editor, finding) => {
  const { from } = range(editor.state.doc, finding);
  editor.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
  editor.focus();
};

/** The word at a finding's place; without a place the first line. */
const range = (doc, { line, column }) => {
  const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const from = Math.min(at.from + Math.max(0, utf16(at.text, column - 1)), at.to);
  const word = /^[^\s,:{}[\]]+/.exec(at.text.slice(from - at.from));
  const to = word ? from + word[0].length : at.to;
  return from < to ? { from, to } : { from: at.from, to: at.to };
};

/** Columns count characters, the editor counts units of UTF-16. */
const utf16 = (text, characters) => Array.from(text).slice(0, characters).join("").length;

/** Makes a view of generated code in `parent`; returns a function that shows a text in a language. */
export const makeCodeView = (parent, label) => {
  const language = new Compartment();
  const view = new EditorView({
    parent,
    state: EditorState.create({
      extensions: [
        basicSetup,
        language.of([]),
        looks,
        EditorState.readOnly.of(true),
        EditorView.editable.of(false),
        EditorView.contentAttributes.of({ "aria-label": label, tabindex: "0" }),
      ],
    }),
  });
  return (text, name) => {
    const effects = language.reconfigure(name.endsWith(".rs") ? rust() : cpp());
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text }, effects, scrollIntoView: false });
  };
};
