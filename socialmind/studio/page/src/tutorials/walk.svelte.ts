// How far somebody has come in a tutorial: its steps, what is missing, and the mind as it was when a step began.

import { asking } from "../ask";
import { editor as schemes } from "../scheme/editor.svelte";
import { editor as skills } from "../skills/editor.svelte";

export interface Step {
  title: string;
  says: string[];
  hint: string;
  /** Whether what the mind does is shown. */
  shows: boolean;
}
export interface Tutorial {
  word: string;
  title: string;
  about: string;
  /** The room whose editor it is. */
  editor: "mind" | "skills";
  measure: string;
  steps: Step[];
  /** Of schemes: the model that runs with it, and whether it begins with that model's own. */
  model: string;
  population: string;
  begins: boolean;
}
export interface Courses {
  ticks: number[];
  names: string[];
  /** The measure over these ticks, for each name. */
  courses: number[][];
}

/** An editor, as a tutorial needs it. */
interface Desk {
  readonly document: unknown;
  readonly changed: boolean;
  open(one: Tutorial): Promise<void>;
  change(document: never): void;
}
const DESKS: Record<Tutorial["editor"], Desk> = {
  mind: {
    get document() {
      return schemes.scheme;
    },
    get changed() {
      return schemes.changed;
    },
    async open(one) {
      await schemes.open(one.begins ? { model: one.model, population: one.population } : {});
      if (!one.begins) schemes.bear(one.model, one.population);
    },
    change(scheme) {
      schemes.history.settle();
      schemes.change(scheme);
      schemes.selected = [];
    },
  },
  skills: {
    get document() {
      return skills.mind;
    },
    get changed() {
      return skills.changed;
    },
    open: () => skills.open(""),
    change(mind) {
      skills.history.settle();
      skills.change(mind);
      skills.selected = [];
    },
  },
};
export const deskOf = (one: Tutorial): Desk => DESKS[one.editor];

const CHECK_AFTER = 150;
const KEPT = "socialmind first hour";

const ask = asking("first-hour");

class Walk {
  tutorials = $state.raw<Tutorial[]>([]);
  tutorial = $state.raw<Tutorial | null>(null);
  at = $state(0);
  /** Sentences: what is missing at this step; null until it is known. */
  missing = $state.raw<string[] | null>(null);
  courses = $state.raw<Courses | null>(null);
  error = $state("");
  /** Titles of the tutorials that were gone through to their end, by their words. */
  finished = $state.raw<string[]>(JSON.parse(localStorage.getItem(KEPT) ?? "[]"));

  #before = $state.raw<unknown>(null);
  #timer: ReturnType<typeof setTimeout> | undefined;
  #asked = 0;
  #shown = "";

  constructor() {
    ask<Tutorial[]>("").then((found) => (this.tutorials = found), (error) => (this.error = error.message));
  }

  get step(): Step {
    return this.tutorial!.steps[this.at];
  }
  get done(): boolean {
    return this.missing?.length === 0;
  }
  get last(): boolean {
    return this.at === this.tutorial!.steps.length - 1;
  }
  /** What is edited. */
  get document(): unknown {
    return this.tutorial && deskOf(this.tutorial).document;
  }
  /** Whether it is another one than when the step began. */
  get changed(): boolean {
    return this.#before !== null && this.document !== this.#before;
  }

  /** Begin a tutorial; what is in the editor goes. */
  async begin(one: Tutorial): Promise<void> {
    this.error = "";
    await deskOf(one).open(one);
    this.tutorial = one;
    this.#enter(0);
  }
  leave(): void {
    this.tutorial = null;
  }
  /** Go to the next step, if nothing is missing, or to one that was done. */
  go(to: number): void {
    if (to <= this.at || (to === this.at + 1 && this.done)) this.#enter(to);
  }
  /** Take everything back to where the step began; Undo takes that back. */
  startOver(): void {
    deskOf(this.tutorial!).change(this.#before as never);
  }

  #enter(step: number): void {
    this.at = step;
    this.#before = this.document;
    this.missing = this.courses = null;
    this.#shown = "";
    if (this.last) {
      this.finished = [...new Set([...this.finished, this.tutorial!.word])];
      localStorage.setItem(KEPT, JSON.stringify(this.finished));
    }
    this.check(0);
  }

  /** Ask what is missing, a moment after the last change. */
  check(after = CHECK_AFTER): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#ask(), after);
  }
  async #ask(): Promise<void> {
    const tutorial = this.tutorial;
    if (!tutorial) return;
    const number = (this.#asked += 1);
    const asked = { tutorial: tutorial.word, step: this.at, document: this.document };
    try {
      const { missing } = await ask<{ missing: string[] }>("check", asked);
      if (number !== this.#asked) return;
      this.missing = missing;
      this.error = "";
      const said = JSON.stringify([asked.tutorial, asked.document]);
      if (!this.step.shows || missing.length || said === this.#shown) return;
      const courses = await ask<Courses>("show", asked);
      if (number !== this.#asked) return;
      [this.courses, this.#shown] = [courses, said];
    } catch (error) {
      if (number === this.#asked) this.error = (error as Error).message;
    }
  }
}

export const walk = new Walk();
