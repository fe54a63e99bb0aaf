// What the room of skills knows: the mind with its past, where it came from, and what is odd about it.

import { asking } from "../ask";
import { Desk } from "../graph/desk.svelte";
import type { Finding } from "../graph/Findings.svelte";
import { positionOf, type Place, type Places, type Position } from "../graph/layout";
import { added, EMPTY, fresh, linkBetween, linked, LISTS, parsedLink, partOf, set, without, type Kind, type Mind, type Module, type Skill } from "./document";
import { placed, type Weights } from "./drawing";

export interface Base {
  file: string;
  sha256: string;
}
type Sent = Omit<Mind, "skills"> & { skills: (Skill & { was: string | null })[] };
interface Opened {
  document: Sent;
  base: Base | null;
  writable: boolean;
}

export const ask = asking("skills");

class Editor extends Desk<Mind, Base> {
  weights = $state.raw<Record<string, Weights>>({});
  masters = $state.raw<string[]>([]);
  /** The names of the files of programs, by the ids of their skills. */
  programs = $state.raw<Record<string, string>>({});
  /** Whether there is more room for a program. */
  wide = $state(false);

  /** Under which names the files of skills lie, by their ids; no undo changes that. */
  #files = new Map<string, string>();
  /** The programs as they are in files, by the ids of their skills. */
  #texts = new Map<string, string | null>();
  #checks = 0;

  constructor() {
    super(EMPTY);
  }

  placed(mind: Mind, put: Places): Places {
    return placed(mind, put);
  }
  protected put(mind: Mind, id: string, position: Position): Mind {
    return set(mind, id, { position });
  }
  has(id: string): boolean {
    return !!(partOf(this.mind, id) || parsedLink(id));
  }

  get mind(): Mind {
    return this.document;
  }
  get part() {
    return this.selected.length === 1 ? partOf(this.mind, this.selected[0]) : null;
  }

  async open(file: string): Promise<void> {
    this.error = this.note = "";
    let found: Opened;
    try {
      found = file ? await ask<Opened>("open", { file }) : { document: { ...EMPTY, skills: [] }, base: null, writable: false };
    } catch (error) {
      this.error = (error as Error).message;
      return;
    }
    const { skills, ...rest } = found.document;
    const mind = { ...rest, skills: skills.map(({ was: _, ...one }) => one) };
    this.#files = new Map(skills.filter((one) => one.was).map((one) => [one.id, one.was!]));
    this.#texts = new Map(mind.skills.map((one) => [one.id, one.program]));
    this.begin(mind, found.base, found.writable);
  }

  async save(file: string, replace = false): Promise<void> {
    this.error = this.note = "";
    const mind = this.mind;
    const how = mind.skills.some((one) => (one.program ?? null) !== (this.#texts.get(one.id) ?? null)) ? "save-with-programs" : "save";
    const found = await ask<{ notes: string[]; base: Base; writable: boolean }>(how, { document: this.#sent(mind), base: this.base, file, replace });
    this.#files = new Map(mind.skills.map((one) => [one.id, one.name]));
    this.#texts = new Map(mind.skills.map((one) => [one.id, one.program]));
    this.saved(mind, found);
    this.checkSoon(0);
  }

  set(id: string, fields: Partial<Module & Skill>, key = ""): void {
    this.change(set(this.mind, id, fields), key && `${id} ${key}`);
  }
  /** Give a part another name, and links with it; returns why it cannot be, or nothing. */
  rename(id: string, name: string): string | void {
    const part = partOf(this.mind, id)!;
    if (!name.trim() || name !== name.trim()) return "a name without blanks at its ends is needed";
    if (/[:#/\\]/.test(name)) return "no name has : # / or \\ in it";
    if ((this.mind[LISTS[part.part]] as Module[]).some((one) => one.id !== id && one.name === name)) return "another one is called so";
    this.set(id, { name }, "name");
  }
  nameMind(name: string): string | void {
    if (!name.trim() || /[:#/\\]/.test(name)) return "a name without : # / or \\ is needed";
    this.change({ ...this.mind, name }, "mind name");
  }
  add(part: Kind, at?: Place): void {
    const id = fresh();
    this.change(added(this.mind, part, id, positionOf(at ?? this.#freePlace(part))));
    this.selected = [id];
  }
  linkable(from: string, to: string): boolean {
    return linkBetween(this.mind, from, to) !== null;
  }
  link(from: string, to: string): void {
    this.change(linked(this.mind, from, to));
  }
  remove(ids: string[]): void {
    this.change(without(this.mind, ids));
    this.selected = [];
  }

  #freePlace(part: Kind): Place {
    const among = this.mind[LISTS[part]].map((one) => this.places.get(one.id)!);
    if (among.length) return { x: among[0].x, y: Math.max(...among.map((one) => one.y)) + 70 };
    return { x: { sensor: 0, variable: 0, skill: 230, actuator: 460 }[part], y: 0 };
  }

  #sent(mind: Mind): Sent {
    return { ...mind, skills: mind.skills.map((one) => ({ ...one, was: this.#files.get(one.id) ?? null })) };
  }
  protected async check(): Promise<void> {
    const number = (this.#checks += 1);
    try {
      const found = await ask<{ findings: Finding[]; weights: Record<string, Weights>; programs: Record<string, string>; masters: string[] }>("check", {
        document: this.#sent(this.mind), base: this.base,
      });
      if (number !== this.#checks) return;
      this.findings = found.findings;
      this.weights = found.weights;
      this.programs = found.programs;
      this.masters = found.masters;
    } catch (error) {
      this.error = (error as Error).message;
    }
  }
}

export const editor = new Editor();
