// SPDX-License-Identifier: Apache-2.0
// Text that is not saved yet, kept by the browser over a reload, and the revision it was made on.

export interface Draft {
  /** 0: the program is new. */
  revision: number;
  text: string;
}

export type Storage = Pick<globalThis.Storage, "getItem" | "setItem" | "removeItem" | "key" | "length">;

const prefix = "trunnion.draft.";

/** A browser's storage holds some 5 million characters; a larger text is kept until the page is closed. */
export const mostKept = 2_000_000;

export class Drafts {
  private readonly open = new Map<string, Draft>();

  constructor(private readonly storage: Storage | undefined) {}

  /** False when only the page itself keeps it, because the browser does not. */
  keep(name: string, draft: Draft): boolean {
    this.open.set(name, draft);
    if (draft.text.length > mostKept || !this.storage) return false;
    try {
      this.storage.setItem(prefix + name, JSON.stringify(draft));
      return true;
    } catch {
      return false;
    }
  }

  of(name: string): Draft | undefined {
    const known = this.open.get(name);
    if (known) return known;
    try {
      const read = JSON.parse(this.storage?.getItem(prefix + name) ?? "null") as Partial<Draft> | null;
      return typeof read?.revision === "number" && typeof read.text === "string" ? { revision: read.revision, text: read.text } : undefined;
    } catch {
      return undefined;
    }
  }

  drop(name: string): void {
    this.open.delete(name);
    try {
      this.storage?.removeItem(prefix + name);
    } catch {
      // It was not kept either.
    }
  }

  /** Names of everything that is not saved, ascending. */
  names(): string[] {
    const names = new Set(this.open.keys());
    for (let i = 0; i < (this.storage?.length ?? 0); ++i) {
      const key = this.storage?.key(i);
      if (key?.startsWith(prefix) && this.of(key.slice(prefix.length))) names.add(key.slice(prefix.length));
    }
    return [...names].sort();
  }
}
