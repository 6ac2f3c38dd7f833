// SPDX-License-Identifier: Apache-2.0
// The text editor (CodeMirror 6). Loaded when a program is opened.
import "./editor.css";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { highlightSelectionMatches, openSearchPanel, search, searchKeymap } from "@codemirror/search";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { getChunks, goToNextChunk, goToPreviousChunk, unifiedMergeView } from "@codemirror/merge";
import { Compartment, EditorState, type Extension, RangeSetBuilder } from "@codemirror/state";
import {
  Decoration, type DecorationSet, drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap,
  lineNumbers, ViewPlugin, type ViewUpdate,
} from "@codemirror/view";
import type { ProgramDialect, ProgramError } from "../contract";
import { explainedAt, tokens } from "./g_code";
import { lineBreak } from "./lines";

const marks = new Map<string, Decoration>();
function markOf(kind: string): Decoration {
  const known = marks.get(kind) ?? Decoration.mark({ class: `nc-${kind}` });
  marks.set(kind, known);
  return known;
}

function colours(view: EditorView, marked: boolean): DecorationSet {
  const builder = new RangeSetBuilder<Decoration>();
  for (const { from, to } of view.visibleRanges)
    for (let at = from; at <= to; ) {
      const line = view.state.doc.lineAt(at);
      for (const token of tokens(line.text, marked)) builder.add(line.from + token.from, line.from + token.to, markOf(token.kind));
      at = line.to + 1;
    }
  return builder.finish();
}

/** Lines stand alone in G code, so only what is seen is coloured. */
const highlighting = (marked: boolean) =>
  ViewPlugin.fromClass(
    class {
      decorations: DecorationSet;
      constructor(view: EditorView) {
        this.decorations = colours(view, marked);
      }
      update(update: ViewUpdate) {
        if (update.docChanged || update.viewportChanged) this.decorations = colours(update.view, marked);
      }
    },
    { decorations: (plugin) => plugin.decorations },
  );

const explanations = hoverTooltip((view, position) => {
  const line = view.state.doc.lineAt(position);
  const found = explainedAt(line.text, position - line.from);
  if (!found) return null;
  return {
    pos: line.from + found.from,
    end: line.from + found.to,
    create: () => {
      const dom = document.createElement("div");
      dom.className = "nc-about";
      dom.textContent = `${found.name}: ${found.about}`;
      return { dom };
    },
  };
});

/** The catalogue has the codes of ISO programs: those of the others are neither marked nor explained. */
const isoCode: Extension = [highlighting(true), explanations];
const otherCode: Extension = highlighting(false);

export interface EditorEvents {
  /** The text has changed. */
  changed(): void;
  /** The cursor is in another line, from 1. */
  line(number: number): void;
}

/** An editor in `place`; its parts are named for screen readers by `label`. */
export class ProgramEditor {
  private readonly view: EditorView;
  private readonly comparison = new Compartment();
  private readonly words = new Compartment();
  private iso = true;
  private lineNumber = 1;

  /** `language`: colours and explanations; those of G code when it is left out. */
  constructor(place: HTMLElement, text: string, label: string, phrases: Record<string, string>, events: EditorEvents, language: Extension = isoCode) {
    const extensions: Extension[] = [
      lineNumbers(), history(), drawSelection(), highlightActiveLine(), highlightActiveLineGutter(), highlightSelectionMatches(),
      lintGutter(), this.words.of(language), search({ top: true }), keymap.of([...searchKeymap, ...historyKeymap, ...defaultKeymap]),
      EditorState.phrases.of(phrases), EditorView.contentAttributes.of({ "aria-label": label, spellcheck: "false", tabindex: "0", "data-test": "program-text" }),
      this.comparison.of([]), EditorState.lineSeparator.of(lineBreak(text)),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) events.changed();
        const line = update.state.doc.lineAt(update.state.selection.main.head).number;
        if (line !== this.lineNumber) events.line((this.lineNumber = line));
      }),
    ];
    this.view = new EditorView({ state: EditorState.create({ doc: text, extensions }), parent: place });
  }

  get text(): string {
    return this.view.state.sliceDoc();
  }
  /** Lines without their ends. */
  lines(): Iterable<string> {
    return this.view.state.doc.iterLines();
  }

  /** Undo takes it back. */
  replace(text: string): void {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  /** Marks the place of an error, or none. A number 0 is not shown. */
  mark(error: ProgramError | undefined): void {
    const found: Diagnostic[] = [];
    const { doc } = this.view.state;
    if (error && error.line >= 1 && error.line <= doc.lines) {
      const line = doc.line(error.line);
      // The column counts characters, the editor UTF-16 units.
      const before = [...line.text].slice(0, Math.max(0, error.column - 1)).join("").length;
      const from = error.column > 0 ? Math.min(line.from + before, line.to) : line.from;
      const token = tokens(line.text).find((one) => line.from + one.from <= from && from < line.from + one.to);
      const to = error.column === 0 ? line.to : token ? line.from + token.to : Math.min(from + 1, line.to);
      found.push({ from, to, severity: "error", message: error.number > 0 ? `${error.number}: ${error.text}` : error.text });
    }
    this.view.dispatch(setDiagnostics(this.view.state, found));
  }

  /** The dialect of the G code. */
  written(dialect: ProgramDialect): void {
    const iso = dialect === "iso";
    if (iso === this.iso) return;
    this.iso = iso;
    this.view.dispatch({ effects: this.words.reconfigure(iso ? isoCode : otherCode) });
  }

  goTo(number: number): void {
    const line = this.view.state.doc.line(Math.min(Math.max(1, number), this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: line.from }, effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
    this.view.focus();
  }

  find(): void {
    openSearchPanel(this.view);
  }

  /** Shows what the text has other than `original`; null ends it. */
  compare(original: string | null): void {
    const shown = original === null ? [] : unifiedMergeView({ original, mergeControls: false, gutter: true, collapseUnchanged: { margin: 3, minSize: 6 } });
    this.view.dispatch({ effects: this.comparison.reconfigure(shown) });
  }
  /** Places that differ. */
  get differences(): number {
    return getChunks(this.view.state)?.chunks.length ?? 0;
  }
  next(): void {
    goToNextChunk(this.view);
    this.view.focus();
  }
  previous(): void {
    goToPreviousChunk(this.view);
    this.view.focus();
  }

  destroy(): void {
    this.view.destroy();
  }
}
