// A scheme as the editor has it, the same data as `socialmind/studio/schemes/document.py`; and its edits. No document is
// changed in place: each edit returns another one, which undo and redo rest on.

import type { Position } from "../graph/layout";

export type Weights = [string, number][];

export interface Plan {
  id: string;
  name: string;
  position: Position;
  /** Whether the written order of plans names it. */
  listed: boolean;
}
export interface Holder {
  id: string;
  name: string;
  start: number;
  colour: string;
  position: Position;
  influence: Weights;
  reinforcement: Weights;
  conditional: string[];
}
export interface Cogniton extends Holder {
  starting: boolean;
  active_while: string[];
  activated_when: string[];
  deactivated_when: string[];
  type: string | null;
  chance: number;
  inherited: number;
}
export interface Role {
  id: string;
  name: string;
  position: Position;
  culturons: string[];
}
export interface Group {
  id: string;
  name: string;
  position: Position;
  attributes: [string, number][];
  within: [string, string] | null;
  roles: Role[];
  culturons: Holder[];
}
export interface Scheme {
  name: string;
  decision_maker: { name: string; bias: number };
  breeds: string[];
  ordered: boolean;
  plans: Plan[];
  cognitons: Cogniton[];
  groups: Group[];
}

export type LinkKind = "influence" | "conditional" | "reinforcement";
export const KINDS: LinkKind[] = ["influence", "conditional", "reinforcement"];
export const TYPES = ["belief", "need", "percept", "skill", "trait", "meme"];

/** A part of a scheme, and what it is. */
export type Part =
  | { kind: "plan"; one: Plan }
  | { kind: "cogniton"; one: Cogniton }
  | { kind: "group"; one: Group }
  | { kind: "role"; one: Role; group: Group }
  | { kind: "culturon"; one: Holder; group: Group };

export function partOf(scheme: Scheme, id: string): Part | null {
  for (const one of scheme.plans) if (one.id === id) return { kind: "plan", one };
  for (const one of scheme.cognitons) if (one.id === id) return { kind: "cogniton", one };
  for (const group of scheme.groups) {
    if (group.id === id) return { kind: "group", one: group };
    for (const one of group.roles) if (one.id === id) return { kind: "role", one, group };
    for (const one of group.culturons) if (one.id === id) return { kind: "culturon", one, group };
  }
  return null;
}

/** A link by its id: `influence c0 p1`; `role g0r0 g0k0` puts a culturon into a role. */
export interface LinkId {
  kind: LinkKind | "role";
  from: string;
  to: string;
}
export const linkId = (kind: LinkId["kind"], from: string, to: string): string => `${kind} ${from} ${to}`;
export function linkOf(id: string): LinkId | null {
  const [kind, from, to] = id.split(" ");
  return to ? { kind: kind as LinkId["kind"], from, to } : null;
}

export function holdersOf(scheme: Scheme): Holder[] {
  return [...scheme.cognitons, ...scheme.groups.flatMap((group) => group.culturons)];
}

let made = 0;
const page = Math.random().toString(36).slice(2, 7);
const newId = (): string => `n${page}${(made += 1)}`;

/** A name that no other part has yet. */
function free(name: string, parts: { name: string }[]): string {
  const taken = new Set(parts.map((one) => one.name));
  let found = name;
  for (let number = 2; taken.has(found); number += 1) found = `${name} ${number}`;
  return found;
}

type Made = [Scheme, string];
const nothing = { start: 0, colour: "#808080", influence: [] as Weights, reinforcement: [] as Weights, conditional: [] as string[] };

export function withCogniton(scheme: Scheme, position: Position): Made {
  const id = newId();
  const one: Cogniton = {
    id, name: free("cogniton", scheme.cognitons), ...nothing, position, starting: true, active_while: [], activated_when: [],
    deactivated_when: [], type: null, chance: 1, inherited: 1,
  };
  return [{ ...scheme, cognitons: [...scheme.cognitons, one] }, id];
}
export function withPlan(scheme: Scheme, position: Position, name = "plan"): Made {
  const id = newId();
  const one: Plan = { id, name: free(name, scheme.plans), position, listed: true };
  return [{ ...scheme, plans: [...scheme.plans, one] }, id];
}
export function withGroup(scheme: Scheme, position: Position): Made {
  const id = newId();
  const beside: Position = position && [position[0] + 190, position[1]];
  const role: Role = { id: newId(), name: "member", position: beside, culturons: [] };
  const one: Group = { id, name: free("group", scheme.groups), position, attributes: [], within: null, roles: [role], culturons: [] };
  return [{ ...scheme, groups: [...scheme.groups, one] }, id];
}
export function withRole(scheme: Scheme, group: string, position: Position): Made {
  const id = newId();
  const change = (one: Group): Group => ({ ...one, roles: [...one.roles, { id, name: free("role", one.roles), position, culturons: [] }] });
  return [withGroupChanged(scheme, group, change), id];
}
export function withCulturon(scheme: Scheme, role: string, position: Position): Made {
  const id = newId();
  const change = (group: Group): Group => ({
    ...group,
    culturons: [...group.culturons, { id, name: free("culturon", group.culturons), ...nothing, position }],
    roles: group.roles.map((one) => (one.id === role ? { ...one, culturons: [...one.culturons, id] } : one)),
  });
  const group = scheme.groups.find((one) => one.roles.some((each) => each.id === role))!;
  return [withGroupChanged(scheme, group.id, change), id];
}

function withGroupChanged(scheme: Scheme, id: string, change: (one: Group) => Group): Scheme {
  return { ...scheme, groups: scheme.groups.map((one) => (one.id === id ? change(one) : one)) };
}

/** Set fields of a part. */
export function set(scheme: Scheme, id: string, fields: Record<string, unknown>): Scheme {
  const of = <T extends { id: string }>(parts: T[]): T[] => parts.map((one) => (one.id === id ? { ...one, ...fields } : one));
  return {
    ...scheme,
    plans: of(scheme.plans),
    cognitons: of(scheme.cognitons),
    groups: of(scheme.groups).map((one) => ({ ...one, roles: of(one.roles), culturons: of(one.culturons) })),
  };
}

function withHolders(scheme: Scheme, change: <T extends Holder>(one: T) => T): Scheme {
  return {
    ...scheme,
    cognitons: scheme.cognitons.map(change),
    groups: scheme.groups.map((one) => ({ ...one, culturons: one.culturons.map(change) })),
  };
}

/** Set the weight of a link, or make it; a conditional link has none, and `role` puts a culturon into a role. */
export function withLink(scheme: Scheme, { kind, from, to }: LinkId, weight = 1): Scheme {
  if (kind === "role") {
    const change = (one: Role): Role =>
      one.id === from && !one.culturons.includes(to) ? { ...one, culturons: [...one.culturons, to] } : one;
    return { ...scheme, groups: scheme.groups.map((group) => ({ ...group, roles: group.roles.map(change) })) };
  }
  return withHolders(scheme, (one) => {
    if (one.id !== from) return one;
    if (kind === "conditional") return one.conditional.includes(to) ? one : { ...one, conditional: [...one.conditional, to] };
    const links = one[kind];
    const there = links.some(([plan]) => plan === to);
    const next: Weights = there ? links.map(([plan, was]) => [plan, plan === to ? weight : was]) : [...links, [to, weight]];
    return { ...one, [kind]: next };
  });
}

/** Take away parts and links by their ids, and what cannot be without them. */
export function without(scheme: Scheme, ids: string[]): Scheme {
  const gone = new Set(ids);
  const links = ids.map(linkOf).filter((one) => one !== null);
  const cut = new Set(links.map(({ kind, from, to }) => linkId(kind, from, to)));
  const groups = scheme.groups
    .filter((one) => !gone.has(one.id))
    .map((group) => {
      const roles = group.roles
        .filter((one) => !gone.has(one.id))
        .map((one) => ({ ...one, culturons: one.culturons.filter((each) => !gone.has(each) && !cut.has(linkId("role", one.id, each))) }));
      const held = new Set(roles.flatMap((one) => one.culturons));
      return { ...group, roles, culturons: group.culturons.filter((one) => held.has(one.id)) };
    });
  const roles = new Set(groups.flatMap((one) => one.roles.map((each) => each.id)));
  const left: Scheme = {
    ...scheme,
    plans: scheme.plans.filter((one) => !gone.has(one.id)),
    cognitons: scheme.cognitons.filter((one) => !gone.has(one.id)),
    groups: groups.map((one) => (one.within && !roles.has(one.within[1]) ? { ...one, within: null } : one)),
  };
  return withHolders(left, (one) => ({
    ...one,
    influence: one.influence.filter(([plan]) => !gone.has(plan) && !cut.has(linkId("influence", one.id, plan))),
    reinforcement: one.reinforcement.filter(([plan]) => !gone.has(plan) && !cut.has(linkId("reinforcement", one.id, plan))),
    conditional: one.conditional.filter((plan) => !gone.has(plan) && !cut.has(linkId("conditional", one.id, plan))),
  }));
}

/** Let a plan come one earlier or later in the order that decides between equals. */
export function withPlanMoved(scheme: Scheme, id: string, by: -1 | 1): Scheme {
  const plans = scheme.plans.map((one) => ({ ...one, listed: true }));
  const at = plans.findIndex((one) => one.id === id);
  const other = at + by;
  if (other < 0 || other >= plans.length) return scheme;
  [plans[at], plans[other]] = [plans[other], plans[at]];
  return { ...scheme, plans, ordered: true };
}
