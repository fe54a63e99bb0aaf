// The societies that the page shows: one, or several side by side with one clock.

import { place } from "../place.svelte";
import { Live, type Command } from "./live.svelte";
import type { View } from "./world/drawing";

export const FIRST = "first";
const MOST = 4;

class Studio {
  models = $state<string[]>([]);
  worlds = $state.raw<Live[]>([]);
  /** The one whose parameters and agents are at the sides. */
  live = $state.raw<Live>(undefined!);
  /** Whether worlds of one size that stand side by side show the same part. */
  linked = $state(true);
  /** The part that was last chosen, in which world, and of which size that is. */
  looked = $state.raw<{ view: View; by: Live; size: string } | null>(null);
  #branched = "";
  #pace: number | "turn" | null = 1;

  start(): void {
    fetch("api/models")
      .then((answer) => answer.json())
      .then((names: string[]) => (this.models = names))
      .catch(() => (this.live.error = "The list of models could not be read."));
    this.#read();
    addEventListener("hashchange", () => this.#read());
  }

  get several(): boolean {
    return this.worlds.length > 1;
  }
  get room(): boolean {
    return this.worlds.length < MOST;
  }
  /** Whether all have a society that hears what it is told. */
  get ready(): boolean {
    return this.worlds.every((one) => one.society !== null && !one.busy && one.connected);
  }
  get connected(): boolean {
    return this.live.connected;
  }
  get model() {
    return this.live.model;
  }
  get society() {
    return this.live.society;
  }
  get error(): string {
    return this.worlds.find((one) => one.error)?.error ?? "";
  }
  get note(): string {
    return this.worlds.find((one) => one.note)?.note ?? "";
  }
  dismiss(): void {
    for (const one of this.worlds) one.error = one.note = "";
  }

  /** Ask something of the society that is looked at. */
  send(command: Command): void {
    this.live.send(command);
  }

  goOrPause(): void {
    const running = this.live.running;
    if (!this.several) this.send({ do: running ? "pause" : "go" });
    else if (running) this.all({ do: "pause" });
    else this.send({ do: "go", together: this.worlds.map((one) => one.name), pace: this.#pace === "turn" ? 1 : this.#pace });
    for (const one of this.worlds) one.wish(!running);
  }
  setPace(ticks: number | "turn" | null): void {
    this.#pace = ticks;
    this.all({ do: "pace", ticks });
  }
  /** Ask the same of all: a tick, a place in time. */
  all(command: Command): void {
    for (const one of this.worlds) one.send(command);
  }

  /** Make another society in place of the one that is looked at; the others go back to their start. */
  setup(model: string, seed: string, parameters: Record<string, unknown>): void {
    this.live.setup(model, seed, parameters);
    for (const one of this.worlds) if (one !== this.live) one.send({ do: "go_to", tick: 0 });
  }

  /** Show the same society once more beside this one: from here on they may go different ways. */
  branch(): void {
    const name = `w${crypto.getRandomValues(new Uint32Array(1))[0].toString(36)}`;
    this.send({ do: "branch", into: name });
    this.#branched = name;
    this.#show([...this.worlds.map((one) => one.name), name]);
  }
  close(world: Live): void {
    this.#show(this.worlds.filter((one) => one !== world).map((one) => one.name));
    world.end();
  }

  #show(names: string[]): void {
    place.go("run", { worlds: names.join(",") });
  }

  #looked(name: string): Live {
    const made = new Live(name);
    if (name === this.#branched) made.busy = "repeating the run up to here";
    return made;
  }

  /** Look at the societies that the address names. */
  #read(): void {
    const [word, query] = location.hash.replace(/^#\/?/, "").split("?");
    const said = word === "run" ? new URLSearchParams(query ?? "").get("worlds") : null;
    if (said === null && this.worlds.length) return;
    const names = [...new Set((said ?? FIRST).split(",").filter((one) => /^\w+$/.test(one)))].slice(0, MOST);
    if (!names.length) names.push(FIRST);
    const before = this.worlds;
    this.worlds = names.map((name) => before.find((one) => one.name === name) ?? this.#looked(name));
    for (const one of before) if (!this.worlds.includes(one)) one.leave();
    if (!this.worlds.includes(this.live)) this.live = this.worlds[this.worlds.length - 1];
  }
}

export const studio = new Studio();
