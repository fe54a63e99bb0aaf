// How the nodes of the watched agent's hierarchy went: noted as frames come, or repeated by the program tick by tick.

import type { Live } from "../live.svelte";

const MOST = 2000;
const BACK = 300;

export interface Trace {
  population: string;
  id: number;
  tick: number[];
  values: Record<string, number[]>;
}

export class Traces {
  tick = $state.raw<number[]>([]);
  values: Record<string, number[]> = {};
  #who = "";
  #asked = -1;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** Note what was seen in a frame; where ticks are missing they are asked for, if somebody looks. */
  note(live: Live, looked: boolean): void {
    const seen = live.watched!;
    const who = `${seen.population} ${seen.id}`;
    const now = seen.tick;
    if (who !== this.#who) this.#begin(who);
    const last = this.tick.at(-1);
    if (seen.skills && (last === undefined || now > last)) {
      for (const [name, value] of Object.entries(seen.skills.values)) (this.values[name] ??= []).push(value);
      this.#set([...this.tick, now]);
    } else if (last !== undefined && now < last) this.#keep(this.tick.filter((one) => one <= now).length, 0);
    if (looked && !live.running && this.#asked !== now && (this.tick.length < Math.min(BACK, now) || this.#gaps())) {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => {
        this.#asked = now;
        live.send({ do: "trace", population: seen.population, id: seen.id, ticks: BACK });
      }, 120);
    }
  }

  /** Take what the program has repeated. */
  take(trace: Trace): void {
    if (`${trace.population} ${trace.id}` !== this.#who) return;
    this.values = trace.values;
    this.tick = trace.tick;
  }

  #gaps(): boolean {
    const ticks = this.tick;
    const from = ticks.at(-1)! - BACK;
    return ticks.some((one, place) => place > 0 && one > from && one - ticks[place - 1] > 1);
  }
  #begin(who: string): void {
    this.#who = who;
    this.#asked = -1;
    this.values = {};
    this.tick = [];
  }
  #set(ticks: number[]): void {
    this.tick = ticks;
    if (ticks.length > MOST) this.#keep(ticks.length, MOST / 2);
  }
  #keep(end: number, begin: number): void {
    for (const [name, column] of Object.entries(this.values)) this.values[name] = column.slice(begin, end);
    this.tick = this.tick.slice(begin, end);
  }
}
