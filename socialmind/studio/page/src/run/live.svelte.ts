// What the page knows of one society, and how it asks: a socket, found again when it is lost.

import type { Scheme } from "../scheme/document";
import { decoded, type Frame, type Header, type HierarchyPlan, type Watched } from "./frame";
import type { Actuator } from "./steering/steering";
import type { Trace } from "./watcher/traces.svelte";

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
  /** Labels of the model's own buttons, with what they do. */
  buttons: Record<string, string>;
  /** Why no agent's turn can be seen alone; empty where it can. */
  turnless: string;
  populations: Record<string, { about: string; scheme: boolean; skills: boolean }>;
}

export interface Extent {
  low_x: number;
  low_y: number;
  width: number;
  height: number;
}

export interface SocietyOutline {
  seed: string;
  world: Extent | null;
  plane: { half_width: number } | null;
  /** What robots can be told, and the skills to which steering them can be shown. */
  robots: Record<string, { actuators: Actuator[]; skills: string[] }>;
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

/** What a tick has come to, where it is gone through turn by turn. */
export interface Turn {
  rule: string;
  population: string | null;
  id: number | null;
  number: number;
}

export interface Supposed {
  part: string;
  value: unknown;
  choice: string | null;
  before: string | null;
  probabilities: Record<string, number>;
  text: string;
}

export interface Acting {
  attempt: number;
  lesson: string;
  generation: number;
  score: number;
  /** Of an episode at most. */
  ticks: number;
  seed: number;
}

/** What other rooms hear of what is said of societies. */
export const hearers: ((live: Live, said: string, rest: Record<string, unknown>) => void)[] = [];

/** How often a second words and numbers follow a society that runs: they cost more than its picture. */
const TOLD = 10;
/** Rows of the series that are kept; of more each second one goes, as in the program (running/history.py). */
const ROWS = 4000;

/** What is said when a society goes on no longer, or another comes. */
const ENDING = new Set(["society", "over", "error"]);
/** What lets a society stand, whatever it was told before. */
const STANDING = new Set(["setup", "open", "reset", "step", "turn", "go_to"]);

export type Command = Record<string, unknown> & { do: string };

/** A society that runs in a process of the program, under a name that other tabs can look at too. */
export class Live {
  /** Of the process, in the address of its socket. */
  name: string;
  model = $state<ModelOutline | null>(null);
  society = $state.raw<SocietyOutline | null>(null);
  /** What is drawn. */
  frame = $state.raw<Frame | null>(null);
  /** What is said of it in words, which follows it a few times a second. */
  header = $state.raw<Header | null>(null);
  watched = $state.raw<Watched | null>(null);
  gone = $state("");
  /** What would be decided if a value were another, as it is typed. */
  supposed = $state.raw<Supposed | null>(null);
  busy = $state("");
  /** What has to be done before the first tick, and takes a while. */
  preparing = $state("");
  error = $state("");
  note = $state("");
  connected = $state(false);
  running = $state(false);
  tick = $state(0);
  turn = $state.raw<Turn | null>(null);
  furthest = $state(0);
  rate = $state(0);
  /** The series so far: columns, tick first. Plots are told by `rows`. */
  history: Record<string, (number | null)[]> = { tick: [] };
  rows = $state(0);
  /** Where the hierarchies of populations are drawn. */
  plans = $state.raw<Record<string, HierarchyPlan>>({});
  /** How a hierarchy went, as it was last asked for. */
  trace = $state.raw<Trace | null>(null);
  /** What a training has found, if that is what acts here. */
  acting = $state.raw<Acting | null>(null);
  /** How often something was done to the society by hand. */
  changes = $state(0);
  /** Edited schemes that a model is set up with in place of its own, by population. */
  documents = $state.raw<{ model: string; of: Record<string, Scheme> } | null>(null);

  /** Whether it is to run, as it was last told here, until a frame says so too: some are on their way. */
  #wished: boolean | null = null;
  #next: ArrayBuffer | null = null;
  #told = 0;
  #socket: WebSocket | null = null;
  #retry = 250;
  #ended = false;
  #waiting: Command[] = [];

  constructor(name: string) {
    this.name = name;
    this.#connect();
  }

  /** Ask for something; what is asked before the socket is open waits for it. */
  send(command: Command): void {
    if (STANDING.has(command.do)) this.#wished = null;
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(command));
    else if (this.#socket?.readyState === WebSocket.CONNECTING) this.#waiting.push(command);
  }

  /** Show at once that it goes on, or stands, as it has been told. */
  wish(running: boolean): void {
    this.running = this.#wished = running;
  }

  setup(model: string, seed: string, parameters: Record<string, unknown>): void {
    this.error = this.note = "";
    this.watched = null;
    if (this.documents?.model !== model) this.documents = null;
    this.send({ do: "setup", model, seed, parameters, documents: this.documents?.of ?? null });
  }

  /** End the society, unless another tab looks at it. */
  end(): void {
    this.send({ do: "end" });
    this.leave();
  }

  /** Look at it no longer; it goes on. */
  leave(): void {
    this.#ended = true;
    this.#socket?.close();
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

  /** Ask what the watched agent would decide if a value were another. */
  suppose(part: string, value: number): void {
    const { population, id } = this.watched!;
    this.send({ do: "suppose", population, id, part, value });
  }

  unwatch(): void {
    this.watched = null;
    this.gone = "";
    this.send({ do: "watch" });
  }

  #connect(): void {
    const place = new URL(`live/${this.name}`, location.href);
    place.protocol = place.protocol.replace("http", "ws");
    const socket = new WebSocket(place);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.connected = true;
      this.#retry = 250;
      for (const command of this.#waiting.splice(0)) this.send(command);
    };
    socket.onmessage = (event) => {
      if (typeof event.data === "string") this.#hear(JSON.parse(event.data));
      else this.#come(event.data);
    };
    socket.onclose = () => {
      this.connected = this.running = false;
      this.#wished = null;
      if (this.#ended) return;
      setTimeout(() => this.#connect(), this.#retry);
      this.#retry = Math.min(2 * this.#retry, 4000);
    };
    this.#socket = socket;
  }

  /** Take a frame, to be shown when the browser draws. */
  #come(buffer: ArrayBuffer): void {
    if (!this.#next) requestAnimationFrame(() => this.#show());
    this.#next = buffer;
  }

  /** Show what came, and ask for another, which is made while this one is drawn: so at most one waits. */
  #show(): void {
    const frame = decoded(this.#next!);
    this.#next = null;
    this.send({ do: "seen" });
    this.frame = frame;
    const { running, watched } = frame.header;
    if (running === this.#wished) this.#wished = null;
    const other = watched && (watched as Watched).id !== this.watched?.id;
    if (running && this.running && !other && performance.now() < this.#told + 1000 / TOLD) return;
    this.#told = performance.now();
    this.#tell(frame.header);
  }

  #tell(header: Header): void {
    const { tick, furthest, rate, watched, turn } = header;
    const running = this.#wished ?? header.running;
    Object.assign(this, { header, tick, furthest, running, rate, turn: turn ?? null });
    if (watched && "gone" in watched) {
      this.gone = watched.gone;
    } else if (watched) {
      this.watched = watched;
      this.gone = "";
    }
  }

  #hear(message: { said: string } & Record<string, never>): void {
    const { said, ...rest } = message as unknown as { said: string } & Record<string, unknown>;
    if (ENDING.has(said)) this.#wished = null;
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
    } else if (said === "hierarchies") {
      this.plans = rest.plans as Record<string, HierarchyPlan>;
    } else if (said === "trace") {
      this.trace = rest as unknown as Trace;
    } else if (said === "acting") {
      this.acting = rest as unknown as Acting;
    } else if (said === "busy") {
      this.busy = rest.text as string;
    } else if (said === "preparing") {
      this.preparing = rest.text as string;
    } else if (said === "supposed") {
      this.supposed = rest as unknown as Supposed;
    } else if (said === "saved") {
      this.busy = "";
      this.note = `Saved in ${rest.folder}`;
    } else if (said === "over") {
      this.note = `The society has stopped: ${rest.why}`;
    } else if (said === "error") {
      this.busy = "";
      this.error = rest.text as string;
    }
    for (const hear of hearers) hear(this, said, rest);
  }

  #note(row: Record<string, number | null>): void {
    const count = this.history.tick.length;
    for (const [name, value] of Object.entries(row)) {
      const column = (this.history[name] ??= new Array(count).fill(null));
      column.push(value);
    }
    if (count >= ROWS) {
      for (const [name, column] of Object.entries(this.history)) this.history[name] = column.filter((_, at) => at % 2 === 0);
    }
    this.rows += 1;
  }

  #forget(after: number): void {
    const kept = this.history.tick.filter((tick) => (tick ?? 0) <= after).length;
    for (const column of Object.values(this.history)) column.length = kept;
    this.rows += 1;
  }
}
