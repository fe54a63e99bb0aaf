// What the page knows of the studio, and how it asks: one socket, found again when it is lost.

import type { Scheme } from "../scheme/document";
import { decoded, type Frame, type Watched } from "./frame";

export interface Parameter {
  name: string;
  kind: "float" | "int" | "bool" | "str";
  default: number | boolean | string;
  unit: string;
  low: number | null;
  high: number | null;
  choices: string[];
  doc: string;
}

export interface ModelOutline {
  name: string;
  /** The name by which it is set up again. */
  source: string;
  about: string;
  ticks: number;
  parameters: Parameter[];
  populations: Record<string, { about: string; scheme: boolean; skills: boolean }>;
}

export interface Extent {
  low_x: number;
  low_y: number;
  width: number;
  height: number;
}

export interface SocietyOutline {
  seed: number;
  world: Extent | null;
  plane: { half_width: number } | null;
  colourings: Record<string, string[]>;
  patches: string[];
  networks: Record<string, [string, string]>;
  series: string[];
  parameters: Record<string, number | boolean | string>;
  /** The schemes of populations as they are now. */
  schemes: Record<string, Scheme>;
  shown: { agents: Record<string, string>; patches: string; networks: string[] };
  history: Record<string, (number | null)[]>;
}

type Command = Record<string, unknown> & { do: string };

class Studio {
  models = $state<string[]>([]);
  model = $state<ModelOutline | null>(null);
  society = $state.raw<SocietyOutline | null>(null);
  frame = $state.raw<Frame | null>(null);
  watched = $state.raw<Watched | null>(null);
  gone = $state("");
  busy = $state("");
  error = $state("");
  note = $state("");
  connected = $state(false);
  running = $state(false);
  tick = $state(0);
  furthest = $state(0);
  rate = $state(0);
  /** The series so far: columns, tick first. Plots are told by `rows`. */
  history: Record<string, (number | null)[]> = { tick: [] };
  rows = $state(0);
  /** How often something was done to the society by hand. */
  changes = $state(0);
  /** Edited schemes that a model is set up with in place of its own, by population. */
  documents = $state.raw<{ model: string; of: Record<string, Scheme> } | null>(null);

  #listeners: ((said: string, rest: Record<string, unknown>) => void)[] = [];
  #socket: WebSocket | null = null;
  #retry = 250;

  start(): void {
    fetch("api/models")
      .then((answer) => answer.json())
      .then((names: string[]) => (this.models = names))
      .catch(() => (this.error = "The list of models could not be read."));
    this.#connect();
  }

  send(command: Command): void {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(command));
  }

  setup(model: string, seed: number, parameters: Record<string, unknown>): void {
    this.error = this.note = "";
    this.watched = null;
    if (this.documents?.model !== model) this.documents = null;
    this.send({ do: "setup", model, seed, parameters, documents: this.documents?.of ?? null });
  }

  /** Let another room hear what is said. */
  listen(hear: (said: string, rest: Record<string, unknown>) => void): void {
    this.#listeners.push(hear);
  }

  watch(population: string, id: number): void {
    this.gone = "";
    this.send({ do: "watch", population, id });
  }

  /** Change a value of the watched agent by hand. */
  edit(part: string, value: number | string | boolean | null): void {
    const { population, id } = this.watched!;
    this.send({ do: "edit", population, id, part, value });
  }

  unwatch(): void {
    this.watched = null;
    this.gone = "";
    this.send({ do: "watch" });
  }

  #connect(): void {
    const place = new URL("live/first", location.href);
    place.protocol = place.protocol.replace("http", "ws");
    const socket = new WebSocket(place);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.connected = true;
      this.#retry = 250;
    };
    socket.onmessage = (event) => {
      if (typeof event.data === "string") this.#hear(JSON.parse(event.data));
      else this.#see(event.data);
    };
    socket.onclose = () => {
      this.connected = false;
      this.running = false;
      setTimeout(() => this.#connect(), this.#retry);
      this.#retry = Math.min(2 * this.#retry, 4000);
    };
    this.#socket = socket;
  }

  #see(buffer: ArrayBuffer): void {
    const frame = decoded(buffer);
    const { tick, furthest, running, rate, watched } = frame.header;
    this.frame = frame;
    Object.assign(this, { tick, furthest, running, rate });
    if (watched && "gone" in watched) {
      this.gone = watched.gone;
    } else if (watched) {
      this.watched = watched;
      this.gone = "";
    }
    // Asked for once this one has been drawn, so that frames never pile up.
    requestAnimationFrame(() => this.send({ do: "seen" }));
  }

  #hear(message: { said: string } & Record<string, never>): void {
    const { said, ...rest } = message as unknown as { said: string } & Record<string, unknown>;
    if (said === "model") {
      this.model = rest as unknown as ModelOutline;
    } else if (said === "society") {
      this.society = rest as unknown as SocietyOutline;
      this.history = this.society.history;
      this.busy = "";
      this.rows += 1;
    } else if (said === "row") {
      this.#note(rest as Record<string, number | null>);
    } else if (said === "forgotten") {
      this.#forget(rest.after as number);
    } else if (said === "changed") {
      if (this.society) Object.assign(this.society, { parameters: rest.parameters, schemes: rest.schemes });
      this.changes += 1;
    } else if (said === "busy") {
      this.busy = rest.text as string;
    } else if (said === "saved") {
      this.busy = "";
      this.note = `Saved in ${rest.folder}`;
    } else if (said === "over") {
      this.note = `The society has stopped: ${rest.why}`;
    } else if (said === "error") {
      this.busy = "";
      this.error = rest.text as string;
    }
    for (const hear of this.#listeners) hear(said, rest);
  }

  #note(row: Record<string, number | null>): void {
    const count = this.history.tick.length;
    for (const [name, value] of Object.entries(row)) {
      const column = (this.history[name] ??= new Array(count).fill(null));
      column.push(value);
    }
    this.rows += 1;
  }

  #forget(after: number): void {
    const kept = this.history.tick.filter((tick) => (tick ?? 0) <= after).length;
    for (const column of Object.values(this.history)) column.length = kept;
    this.rows += 1;
  }
}

export const studio = new Studio();
