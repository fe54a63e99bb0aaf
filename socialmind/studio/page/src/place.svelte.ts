// Where in the studio the page is: the word of a room, and what the address says beside it.

class Place {
  word = $state("run");
  query = $state.raw(new URLSearchParams());

  constructor() {
    this.#read();
    addEventListener("hashchange", () => this.#read());
  }

  /** Go to a room; what is said beside it stands in the address, so that it can be kept. */
  go(word: string, query: Record<string, string> = {}): void {
    const said = new URLSearchParams(query).toString();
    location.hash = `/${word}${said && `?${said}`}`;
  }

  #read(): void {
    const [word, query] = location.hash.replace(/^#\/?/, "").split("?");
    this.word = word || "run";
    this.query = new URLSearchParams(query ?? "");
  }
}

export const place = new Place();
