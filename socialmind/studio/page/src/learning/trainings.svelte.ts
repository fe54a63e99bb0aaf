// The trainings below the studio's folder: which there are, and how the chosen one goes on. Asked for now and then; what
// is known of its curve already is not sent again.

import { asking, Unanswered } from "../ask";

export type Status = "running" | "stopped" | "elsewhere" | "interrupted" | "failed" | "finished" | "broken";

export interface Summary {
  folder: string;
  status: Status;
  error: string | null;
  model: string | null;
  /** Whether its process is one of the studio's. */
  here: boolean;
  /** Whether a process has it in hand, this program's or another. */
  held?: boolean;
  /** The process that goes on with it, or did when it was killed; null also of old versions. */
  process?: { host: string; pid: number } | null;
  pausing?: boolean;
  /** Whether the studio knows a command that goes on with it. */
  resumable?: boolean;
  /** The command of a study's plan that goes on with it in a terminal. */
  command?: string | null;
  /** Why its last process here ended before its time. */
  failure: string | null;
  attempts?: number;
  finished?: number;
  seed?: string;
  created?: string;
  seconds?: number;
}

export interface Result {
  attempt: number;
  lesson: string;
  cycle: number;
  score: number;
  deviation: number;
  generation: number;
}

export interface Told extends Summary {
  lessons: { name: string; skills: string[]; master: string; optimiser: string; generations: number }[];
  now: {
    attempt: number; lesson: string; generation: number; of: number | null;
    best: number; mean: number; best_so_far: number;
  } | null;
  left: number | null;
  ticks_a_second: number | null;
  results: Result[];
}

export const COLUMNS = { best: "best of each generation", best_so_far: "best so far", mean: "mean of each generation",
  validated: "on the worlds of validation" } as const;
export type Column = keyof typeof COLUMNS;
type Values = (number | null)[];
type Part = { attempt: number; lesson: string; cycle: number; generation: number[] } & Partial<Record<Column, Values>>;

const ask = asking("learning");
const OFTEN = 1000;
const SELDOM = 3000;

export class Trainings {
  home = $state("");
  all = $state.raw<Summary[] | null>(null);
  models = $state.raw<string[]>([]);
  told = $state.raw<Told | null>(null);
  error = $state("");
  /** The curve: by lesson, by attempt, the columns. `version` tells of new rows. */
  curve = new Map<string, Map<number, Partial<Record<Column, Values>>>>();
  version = $state(0);

  #folder = "";
  #known: number[] = [];
  #timers: ReturnType<typeof setTimeout>[] = [];
  #ended = false;

  begin(): () => void {
    this.#often(() => this.#list(), () => SELDOM);
    this.#often(() => this.#follow(), () => (this.told?.status === "running" || this.told?.here ? OFTEN : SELDOM));
    return () => {
      this.#ended = true;
      this.#timers.forEach(clearTimeout);
    };
  }

  get folder(): string {
    return this.#folder;
  }
  choose(folder: string): void {
    if (folder === this.#folder) return;
    this.#folder = folder;
    this.#forget();
    this.told = null;
    void this.#follow();
  }

  async start(options: Record<string, unknown>): Promise<string> {
    const said = await this.#ask("begin", options);
    await this.#list();
    return said?.folder ?? "";
  }
  async pause(): Promise<void> {
    await this.#ask("pause", { folder: this.#folder });
    await this.#follow();
  }
  async resume(): Promise<void> {
    await this.#ask("resume", { folder: this.#folder });
    await this.#follow();
  }

  #often(what: () => Promise<void>, every: () => number): void {
    const place = this.#timers.length++;
    const again = () => {
      if (this.#ended) return;
      void what().finally(() => (this.#timers[place] = setTimeout(again, every())));
    };
    again();
  }
  #forget(): void {
    this.#known = [];
    this.curve = new Map();
    this.version += 1;
  }

  async #list(): Promise<void> {
    const said = await this.#ask("");
    if (!said) return;
    this.home = said.home;
    this.all = said.trainings;
    this.models = said.models;
  }

  async #follow(): Promise<void> {
    const folder = this.#folder;
    if (!folder) return;
    const query = new URLSearchParams({ folder, known: this.#known.join(",") });
    const said = await this.#ask(`training?${query}`);
    if (!said || folder !== this.#folder) return;
    const { curve, ...told } = said;
    this.told = told;
    for (const part of (curve ?? []) as Part[]) this.#add(part);
    if (curve?.length) this.version += 1;
  }

  #add(part: Part): void {
    const lesson = this.curve.get(part.lesson) ?? new Map<number, Partial<Record<Column, Values>>>();
    this.curve.set(part.lesson, lesson);
    const columns = lesson.get(part.attempt) ?? {};
    lesson.set(part.attempt, columns);
    for (const name of Object.keys(COLUMNS) as Column[])
      if (part[name]) columns[name] = [...(columns[name] ?? []), ...part[name]];
    while (this.#known.length < part.attempt) this.#known.push(0);
    this.#known[part.attempt - 1] += part.generation.length;
  }

  /** Ask; null where that was refused, which is said, or while the program does not answer. */
  async #ask(what: string, asked?: Record<string, unknown>): Promise<any> {
    if (asked) this.error = "";
    try {
      return await ask(what, asked);
    } catch (error) {
      if (asked || !(error instanceof Unanswered)) this.error = (error as Error).message;
      return null;
    }
  }
}

/** A time as hours, minutes and seconds. */
export function clock(seconds: number): string {
  const all = Math.max(0, Math.round(seconds));
  const [hours, minutes, rest] = [Math.floor(all / 3600), Math.floor(all / 60) % 60, all % 60];
  return `${hours}:${String(minutes).padStart(2, "0")}:${String(rest).padStart(2, "0")}`;
}

/** How a training stands, in words. */
export function standing(one: Summary): string {
  if (one.pausing) return "pausing";
  if (one.here && one.status !== "running") return "starting";
  const words: Record<Status, string> = { running: "goes on", stopped: "was killed", elsewhere: "elsewhere?", interrupted: "paused", failed: "failed",
    finished: "finished", broken: "broken" };
  return words[one.status];
}
