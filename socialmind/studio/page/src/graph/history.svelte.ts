// Undo and redo without end, over states that are never changed in place.

export class History<T> {
  now = $state.raw() as T;
  #past = $state.raw<T[]>([]);
  #future = $state.raw<T[]>([]);
  #key = "";

  constructor(first: T) {
    this.begin(first);
  }

  get undoable(): boolean {
    return this.#past.length > 0;
  }
  get redoable(): boolean {
    return this.#future.length > 0;
  }

  /** Begin anew; what was before is forgotten. */
  begin(first: T): void {
    this.now = first;
    this.#past = [];
    this.#future = [];
    this.#key = "";
  }

  /** Take a next state. Changes one after another under the same key (typing into a field) are one step. */
  change(next: T, key = ""): void {
    if (next === this.now) return;
    if (!key || key !== this.#key) this.#past = [...this.#past, this.now];
    this.#key = key;
    this.#future = [];
    this.now = next;
  }

  /** Let the next change be a step of its own, whatever its key. */
  settle(): void {
    this.#key = "";
  }

  undo(): void {
    const before = this.#past.at(-1);
    if (before === undefined) return;
    this.#future = [this.now, ...this.#future];
    this.#past = this.#past.slice(0, -1);
    this.now = before;
    this.#key = "";
  }

  redo(): void {
    const [next, ...rest] = this.#future;
    if (next === undefined) return;
    this.#past = [...this.#past, this.now];
    this.#future = rest;
    this.now = next;
    this.#key = "";
  }
}
