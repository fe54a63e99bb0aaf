// A scheme as boxes and links on the canvas.

import type { Box, Link, LinkData } from "../graph/kinds";
import { clear, known, laidOut, type Place, type Places } from "../graph/layout";
import type { Finding } from "../graph/Findings.svelte";
import { holdersOf, linkId, type Holder, type Scheme } from "./document";

const SIZE = { width: 150, height: 48 };

/** Where all boxes stand: where the file says, or the user has put them, or the layout. */
export function placed(scheme: Scheme, put: Places): Places {
  const parts = [...scheme.groups, ...scheme.groups.flatMap((one) => one.roles), ...holdersOf(scheme), ...scheme.plans];
  const found = known(parts, put);
  const left = parts.filter(({ id }) => !found.has(id));
  if (!left.length) return found;
  const links: [string, string][] = [
    ...scheme.groups.flatMap((one) => one.roles.map((role): [string, string] => [one.id, role.id])),
    ...scheme.groups.flatMap((one) => one.roles.flatMap((role) => role.culturons.map((each): [string, string] => [role.id, each]))),
    ...holdersOf(scheme).flatMap((one) =>
      [...one.influence.map(([plan]) => plan), ...one.conditional, ...one.reinforcement.map(([plan]) => plan)].map(
        (plan): [string, string] => [one.id, plan],
      ),
    ),
  ];
  const layout = laidOut(parts.map(({ id }) => ({ id, ...SIZE })), links);
  const { x, y } = shifted(scheme, found, left.map(({ id }) => layout.get(id)!));
  for (const { id } of left) {
    const at = layout.get(id)!;
    found.set(id, clear({ x: at.x + x, y: at.y + y }, [...found.values()], { width: SIZE.width / 2, height: SIZE.height / 2 }));
  }
  return found;
}

/** How far what is laid out is moved: below cognitons and plans where all these have their places, else not at all. */
function shifted(scheme: Scheme, found: Places, laid: Place[]): Place {
  const middle = [...scheme.cognitons, ...scheme.plans].map((one) => found.get(one.id));
  const there = middle.filter((one) => one !== undefined);
  if (!there.length || there.length < middle.length) return { x: 0, y: 0 };
  const bottom = Math.max(...there.map((one) => one.y)) + 90;
  return { x: Math.min(...there.map((one) => one.x)), y: bottom - Math.min(...laid.map((one) => one.y)) };
}

function said(findings: Finding[], id: string): { odd: string[]; wrong: string[] } {
  const here = findings.filter((one) => one.at === id);
  return { odd: here.filter((one) => !one.wrong).map((one) => one.text), wrong: here.filter((one) => one.wrong).map((one) => one.text) };
}

const shown = (number: number): string => String(number).replace("-", "−");

export function boxesOf(scheme: Scheme, places: Places, findings: Finding[], unruled: string[], readOnly = false): Box[] {
  const box = (id: string, kind: string, title: string, line: string, more: Partial<Box["data"]> = {}): Box => ({
    id,
    type: "box",
    position: places.get(id) ?? { x: 0, y: 0 },
    data: { title, kind, line, ...said(findings, id), ...more },
    ariaLabel: [kind, title, line, ...findings.filter((one) => one.at === id).map((one) => one.text)].join(", "),
    draggable: !readOnly,
    domAttributes: { "data-name": title } as never,
  });
  const holder = (one: Holder, kind: string, pale: boolean): Box =>
    box(one.id, kind, one.name, `${"type" in one && one.type ? `${one.type}, ` : ""}${shown(one.start)}${pale ? ", not at birth" : ""}`, { colour: one.colour, pale });
  return [
    ...scheme.groups.map((one) => box(one.id, "group", one.name, "group")),
    ...scheme.groups.flatMap((one) => one.roles.map((role) => box(role.id, "role", role.name, `role of ${one.name}`))),
    ...scheme.groups.flatMap((one) => one.culturons.map((each) => holder(each, "culturon", false))),
    ...scheme.cognitons.map((one) => holder(one, "cogniton", !one.starting)),
    ...scheme.plans.map((one) => box(one.id, "plan", one.name, unruled.includes(one.id) ? "no rule in the model" : "", { pale: unruled.includes(one.id) })),
  ];
}

/** Blue adds, vermilion takes away; grey opens, green feeds back: told apart by the colour-blind, and by dashes. */
const COLOURS = { plus: "var(--plus)", minus: "var(--minus)", opens: "var(--soft)", feeds: "var(--feeds)" };

export function linksOf(scheme: Scheme, findings: Finding[], weigh: (id: string, text: string) => void): Link[] {
  const names = new Map([...scheme.plans, ...holdersOf(scheme)].map((one) => [one.id, one.name]));
  const drawn: Link[] = [];
  const link = (id: string, source: string, target: string, data: Omit<LinkData, "lane">, odd: string): void => {
    drawn.push({
      id, source, target, type: "link", ariaLabel: data.label, selectable: odd !== "", focusable: odd !== "",
      data: { ...data, lane: [0, 1], odd: findings.filter((one) => one.at === odd).map((one) => one.text) },
    });
  };
  for (const group of scheme.groups) {
    for (const role of group.roles) {
      const label = `${role.name} is a role of ${group.name}`;
      link(`of ${group.id} ${role.id}`, group.id, role.id, { colour: "var(--line)", width: 1.5, end: "none", label }, "");
      for (const each of role.culturons) {
        const id = linkId("role", role.id, each);
        const named = `who is ${role.name} is under ${names.get(each)}`;
        link(id, role.id, each, { colour: "var(--soft)", width: 1.2, dash: "2 3", end: "none", label: named }, id);
      }
    }
  }
  for (const one of holdersOf(scheme)) {
    const width = (weight: number): number => 1.2 + Math.min(2.8, Math.log1p(Math.abs(weight)));
    for (const [plan, weight] of one.influence) {
      const id = linkId("influence", one.id, plan);
      const colour = weight < 0 ? COLOURS.minus : COLOURS.plus;
      const label = `influence of ${one.name} on ${names.get(plan)}`;
      link(id, one.id, plan, { colour, width: width(weight), text: String(weight), at: 0.4, label, type: (text) => weigh(id, text) }, id);
    }
    for (const plan of one.conditional) {
      const id = linkId("conditional", one.id, plan);
      link(id, one.id, plan, { colour: COLOURS.opens, width: 1.6, dash: "7 4", end: "ring", label: `${one.name} makes ${names.get(plan)} available` }, id);
    }
    for (const [plan, weight] of one.reinforcement) {
      const id = linkId("reinforcement", one.id, plan);
      const label = `reinforcement of ${one.name} from ${names.get(plan)}`;
      link(id, plan, one.id, { colour: COLOURS.feeds, width: width(weight), dash: "2 4", text: String(weight), at: 0.6, label, type: (text) => weigh(id, text) }, id);
    }
  }
  // Links between the same two boxes lie side by side.
  const between = new Map<string, Link[]>();
  for (const one of drawn) {
    const pair = [one.source, one.target].sort().join(" ");
    between.set(pair, [...(between.get(pair) ?? []), one]);
  }
  for (const several of between.values()) several.forEach((one, place) => (one.data!.lane = [place, several.length]));
  return drawn;
}
