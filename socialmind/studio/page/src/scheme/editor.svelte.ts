// What the room of schemes knows: the document with its past, where it came from, what is odd about it, and the society
// that runs with it.

import { asking } from "../ask";
import { Desk } from "../graph/desk.svelte";
import type { Finding } from "../graph/Findings.svelte";
import { clear, positionOf, type Place, type Places, type Position } from "../graph/layout";
import { hearers, type Live } from "../run/live.svelte";
import { studio } from "../run/studio.svelte";
import {
  linkOf, partOf, set, withCogniton, withCulturon, withGroup, withLink, without, withPlan, withRole,
  type LinkKind, type Scheme,
} from "./document";
import { placed } from "./drawing";

export interface Base {
  file: string;
  text: string;
  suffix: string;
  sha256: string;
}
/** What can be opened: a file, the scheme of a model's population, or that of the society that runs. */
export interface Source {
  file?: string;
  model?: string;
  population?: string;
  running?: boolean;
}
interface Opened {
  document: Scheme;
  base: Base | null;
  writable: boolean;
}

const EMPTY: Scheme = { name: "scheme", decision_maker: { name: "MaximumWeight", bias: 1 }, breeds: [], ordered: true, plans: [], cognitons: [], groups: [] };

export const ask = asking("schemes");

class Editor extends Desk<Scheme, Base> {
  unruled = $state.raw<string[]>([]);
  /** The decision makers that a scheme may name, as the last check found them. */
  makers = $state.raw<string[]>([]);
  model = $state("");
  population = $state("");
  /** What links are drawn as. */
  drawing = $state<LinkKind>("influence");
  /** Whether changes reach the society that runs. */
  live = $state(false);
  /** Why the running society did not take the last change. */
  unfit = $state("");

  #checks = 0;
  #sent = "";
  #heard = "";
  #begins = false;
  /** The society that changes reach. */
  #world: Live | null = null;
  #token = 1 + Math.floor(Math.random() * 1e9);

  constructor() {
    super(EMPTY);
    hearers.push((live, said, rest) => live === this.#world && this.#hear(said, rest));
  }

  placed(scheme: Scheme, put: Places): Places {
    return placed(scheme, put);
  }
  protected put(scheme: Scheme, id: string, position: Position): Scheme {
    return set(scheme, id, { position });
  }
  has(id: string): boolean {
    return !!(partOf(this.scheme, id) || linkOf(id));
  }

  get scheme(): Scheme {
    return this.document;
  }
  get selectedPart() {
    return this.selected.length === 1 ? partOf(this.scheme, this.selected[0]) : null;
  }

  /** A model as the list has it, by the name that it was set up with. */
  nameOf(source: string): string {
    const listed = source.replaceAll("-", "_");
    return studio.models.includes(listed) ? listed : source;
  }
  /** Whether the society in the room Run is of this model. */
  get runs(): boolean {
    return !!studio.model && this.nameOf(studio.model.source) === this.model && this.population in (studio.society?.schemes ?? {});
  }

  // Opening and saving -------------------------------------------------------------------------

  async open(source: Source): Promise<void> {
    this.error = this.note = this.unfit = "";
    const { running, ...rest } = source;
    const schemes = studio.society?.schemes ?? {};
    const asked = running ? { ...rest, running: schemes[source.population ?? ""] } : rest;
    let found: Opened;
    try {
      found = await ask<Opened>("open", asked);
    } catch (error) {
      this.error = (error as Error).message;
      return;
    }
    const scheme = found.document;
    if (source.model) {
      this.model = source.model;
      this.population = source.population ?? "";
    }
    this.live = !!running;
    this.#world = studio.live;
    this.#sent = JSON.stringify(scheme);
    this.#heard = JSON.stringify(schemes[this.population]);
    this.begin(scheme, found.base, found.writable);
  }

  /** Say for whom the scheme is to be; findings are of that model then. */
  bear(model: string, population: string): void {
    this.model = model;
    this.population = population;
    this.live = false;
    this.checkSoon(0);
  }

  async save(file: string, replace = false): Promise<void> {
    this.error = this.note = "";
    const scheme = this.scheme;
    const found = await ask<{ notes: string[]; base: Base; writable: boolean }>("save", {
      document: scheme, file, replace, base: this.base, model: this.population && this.model, population: this.population,
    });
    this.saved(scheme, found);
  }

  // Editing ------------------------------------------------------------------------------------

  set(id: string, fields: Record<string, unknown>, key = ""): void {
    this.change(set(this.scheme, id, fields), key);
  }
  rename(id: string, name: string): string | void {
    if (name === "") return "a name is needed";
    this.set(id, { name }, `name ${id}`);
  }
  add(kind: "cogniton" | "plan" | "group", at: Place | null = null): void {
    const place = at ?? this.#freePlace(kind);
    const making = { cogniton: withCogniton, plan: withPlan, group: withGroup }[kind];
    const [scheme, id] = making(this.scheme, positionOf(place));
    this.change(scheme);
    this.selected = [id];
  }
  addRole(group: string): void {
    const at = this.places.get(group)!;
    const place = this.#clear({ x: at.x + 190, y: at.y });
    const [scheme, id] = withRole(this.scheme, group, positionOf(place));
    this.change(scheme);
    this.selected = [id];
  }
  addCulturon(role: string): void {
    const at = this.places.get(role)!;
    const place = this.#clear({ x: at.x + 190, y: at.y });
    const [scheme, id] = withCulturon(this.scheme, role, positionOf(place));
    this.change(scheme);
    this.selected = [id];
  }
  link(kind: LinkKind | "role", from: string, to: string, weight = 1, key = ""): void {
    this.change(withLink(this.scheme, { kind, from, to }, weight), key);
  }
  /** Weigh a link by what was typed; what is no number yet changes nothing. */
  weigh(id: string, text: string): void {
    const link = linkOf(id);
    const weight = Number(text);
    if (link && text.trim() !== "" && Number.isFinite(weight)) this.link(link.kind, link.from, link.to, weight, `weight ${id}`);
  }
  /** A plan of a name, which is made if there is none. */
  planCalled(name: string, beside: string): string {
    const known = this.scheme.plans.find((one) => one.name === name);
    if (known) return known.id;
    const at = this.places.get(beside);
    const place = this.#clear(at ? { x: at.x + 300, y: at.y } : this.#freePlace("plan"));
    const [scheme, id] = withPlan(this.scheme, positionOf(place), name);
    this.change(scheme);
    return id;
  }
  remove(ids: string[]): void {
    const known = ids.filter((id) => partOf(this.scheme, id) || linkOf(id)?.kind);
    if (!known.length) return;
    this.change(without(this.scheme, known));
    this.selected = [];
  }
  #freePlace(kind: "cogniton" | "plan" | "group"): Place {
    const same = { group: this.scheme.groups, cogniton: this.scheme.cognitons, plan: this.scheme.plans }[kind];
    const places = same.map((one) => this.places.get(one.id)!);
    if (places.length) return this.#clear({ x: places.at(-1)!.x, y: Math.max(...places.map((one) => one.y)) + 92 });
    return this.#clear({ x: { group: -480, cogniton: 0, plan: 330 }[kind], y: 0 });
  }
  /** The next place below one that no box covers. */
  #clear(at: Place): Place {
    return clear(at, [...this.places.values()], { width: 160, height: 72 });
  }

  // Checking, and the society that runs ----------------------------------------------------------

  protected async check(): Promise<void> {
    const number = (this.#checks += 1);
    const scheme = this.scheme;
    let found: { findings: Finding[]; unruled: string[]; makers: string[] };
    try {
      found = await ask("check", { document: scheme, model: this.population && this.model, population: this.population });
    } catch (error) {
      found = { findings: [{ at: null, wrong: true, text: (error as Error).message }], unruled: [], makers: this.makers };
    }
    if (number !== this.#checks) return;
    ({ findings: this.findings, unruled: this.unruled, makers: this.makers } = found);
    if (this.live && !this.wrong) this.#reach(scheme);
  }
  #reach(scheme: Scheme): void {
    const said = JSON.stringify(scheme);
    if (said === this.#sent) return;
    this.#sent = said;
    this.#world?.send({ do: "rescheme", population: this.population, document: scheme, token: this.#token });
  }
  /** Let changes reach the society that runs, from now on, or no more. */
  setLive(live: boolean): void {
    this.live = live;
    this.#world = studio.live;
    this.unfit = "";
    if (live) this.checkSoon(0);
  }
  /** Set the model up with this scheme. */
  run(): void {
    const same = this.runs;
    const world = (this.#world = studio.live);
    const others = same && world.documents?.model === this.model ? world.documents.of : {};
    world.documents = { model: this.model, of: { ...others, [this.population]: this.scheme } };
    this.#begins = true;
    this.unfit = "";
    this.#sent = JSON.stringify(this.scheme);
    studio.setup(this.model, same ? (studio.society?.seed ?? "0") : "0", same ? (studio.society?.parameters ?? {}) : {});
  }

  #hear(said: string, rest: Record<string, unknown>): void {
    if (said === "society") {
      this.live = this.#begins;
      this.#begins = false;
      this.#heard = JSON.stringify((rest.schemes as Record<string, Scheme>)[this.population]);
    } else if (said === "unfit" && rest.token === this.#token) {
      this.unfit = rest.text as string;
    } else if (said === "changed") {
      const now = JSON.stringify((rest.schemes as Record<string, Scheme>)[this.population]);
      const other = now !== this.#heard;
      this.#heard = now;
      if (rest.token === this.#token) this.unfit = "";
      else if (this.live && other) void this.#takeOver();
    } else if (said === "error") this.#begins = false;
  }
  /** Somebody else changed the running scheme, or the society went back behind a change. */
  async #takeOver(): Promise<void> {
    const running = this.#world?.society?.schemes[this.population];
    const found = await ask<Opened>("open", { model: this.model, population: this.population, running });
    const scheme = this.#drawnAlike(found.document);
    this.#sent = JSON.stringify(scheme);
    this.history.settle();
    this.change(scheme);
    this.selected = [];
  }
  /** A running scheme drawn as the one here: its society is not told of places and colours alone. */
  #drawnAlike(scheme: Scheme): Scheme {
    return [...this.places.keys()].reduce((drawn, id) => {
      const { one } = partOf(this.scheme, id)!;
      return set(drawn, id, "colour" in one ? { position: one.position, colour: one.colour } : { position: one.position });
    }, scheme);
  }
}

export const editor = new Editor();
