// What an editor of a canvas knows whatever it edits: the document with its past, where boxes stand, where it came from,
// and what is odd about it.

import type { Finding } from "./Findings.svelte";
import { History } from "./history.svelte";
import { positionOf, type Places, type Position } from "./layout";

interface State<Document> {
  document: Document;
  /** Where boxes stand that nobody has put anywhere: they stay there while others come and go. */
  put: Places;
}

const CHECK_AFTER = 150;

export abstract class Desk<Document, Base extends { file: string }> {
  history: History<State<Document>>;
  /** Ids of boxes and links. */
  selected = $state.raw<string[]>([]);
  findings = $state.raw<Finding[]>([]);
  /** What it was opened from, or last saved as. */
  base = $state.raw<Base | null>(null);
  writable = $state(false);
  error = $state("");
  note = $state("");
  /** How often something was opened: the view is fitted then. */
  opened = $state(0);

  /** As it was opened or saved. */
  protected kept = $state.raw() as Document;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(empty: Document) {
    this.history = new History<State<Document>>({ document: empty, put: new Map() });
    this.kept = empty;
    addEventListener("beforeunload", (event) => {
      if (this.changed) event.preventDefault();
    });
  }

  /** Where all boxes of a document stand; those that are nowhere yet are laid out. */
  abstract placed(document: Document, put: Places): Places;
  /** A document with a box elsewhere; one at null is laid out. */
  protected abstract put(document: Document, id: string, position: Position): Document;
  /** Whether there is such a box, or could be such a link. */
  abstract has(id: string): boolean;
  /** Ask what is odd. */
  protected abstract check(): Promise<void>;
  /** Save; throws `Refused` if another file stands there. */
  abstract save(file: string, replace?: boolean): Promise<void>;

  get document(): Document {
    return this.history.now.document;
  }
  get places(): Places {
    return this.placed(this.document, this.history.now.put);
  }
  get changed(): boolean {
    return this.document !== this.kept;
  }
  get wrong(): boolean {
    return this.findings.some((one) => one.wrong);
  }

  /** Edit what was opened. */
  protected begin(document: Document, base: Base | null, writable: boolean): void {
    this.history.begin({ document, put: this.placed(document, new Map()) });
    this.kept = document;
    this.base = base;
    this.writable = writable;
    this.selected = [];
    this.opened += 1;
    this.checkSoon(0);
  }
  /** Note where it was saved. */
  protected saved(document: Document, found: { notes: string[]; base: Base; writable: boolean }): void {
    this.base = found.base;
    this.writable = found.writable;
    this.kept = document;
    this.note = [`Saved in ${found.base.file}`, ...found.notes].join("; ");
  }

  /** Take another document; changes under the same key, one after another, are one step. */
  change(document: Document, key = ""): void {
    this.history.change({ document, put: new Map([...this.places, ...this.history.now.put]) }, key);
    this.checkSoon();
  }
  /** Put boxes elsewhere. */
  move(places: Places): void {
    this.change([...places].reduce((document, [id, place]) => this.put(document, id, positionOf(place)), this.document));
  }
  /** Lay everything out anew. */
  layOut(): void {
    const bare = [...this.places.keys()].reduce((document, id) => this.put(document, id, null), this.document);
    this.move(this.placed(bare, new Map()));
    this.opened += 1;
  }
  undo(): void {
    this.history.undo();
    this.#after();
  }
  redo(): void {
    this.history.redo();
    this.#after();
  }
  #after(): void {
    this.selected = this.selected.filter((id) => this.has(id));
    this.checkSoon(0);
  }

  checkSoon(after = CHECK_AFTER): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.check(), after);
  }
}
