// The drawing of a mind: boxes for its parts, in layers from sensors over skills to motors, and links.

import type { Finding } from "../graph/Findings.svelte";
import type { Box, Link } from "../graph/kinds";
import { known, laidOut, type Places } from "../graph/layout";
import { functionOf, linkId, target, type Mind } from "./document";

const HEIGHT = 44;
const WIDE = 170;
const PITCH = 48;
const ROWS = 16;
const COLOURS = { sensor: "#56a3dc", variable: "#d8b400", skill: "#8c8c8c", actuator: "#e0705c" };
const width = (name: string) => Math.max(96, Math.min(210, 30 + 8 * name.length));

/** The ends of links between skills, and from skills to motors. */
function pairs(mind: Mind): [string, string][] {
  return mind.skills.flatMap((skill) =>
    skill.outputs.flatMap((one) => {
      const to = target(mind, one, false);
      return to && !mind.variables.some((each) => each.id === to.id) ? [[skill.id, to.id] as [string, string]] : [];
    }),
  );
}

/** Where boxes stand: where the file says, or the user has put them; else sensors and variables at the left, skills in layers, motors at the right. */
export function placed(mind: Mind, put: Places): Places {
  const read = [...mind.sensors, ...mind.variables];
  const others = [...mind.skills, ...mind.actuators];
  const there = known([...read, ...others], put);
  if (there.size === read.length + others.length) return there;
  const sized = others.map((one) => ({ id: one.id, width: Math.max(WIDE, width(one.name)), height: HEIGHT }));
  const found: Places = new Map();
  for (const [id, at] of laidOut(sized, pairs(mind))) found.set(id, { x: Math.round(0.78 * at.x), y: Math.round(1.15 * at.y) });
  const edge = Math.max(0, ...mind.skills.map((one) => found.get(one.id)!.x)) + WIDE + 60;
  for (const one of mind.actuators) found.set(one.id, { ...found.get(one.id)!, x: edge });
  const middle = others.length ? others.reduce((sum, one) => sum + found.get(one.id)!.y, 0) / others.length : 0;
  const columns = Math.max(1, Math.ceil(read.length / ROWS));
  const rows = Math.ceil(read.length / columns);
  read.forEach((one, place) => {
    const column = Math.floor(place / rows);
    found.set(one.id, { x: 130 * (column - columns) - 60, y: Math.round(middle + PITCH * ((place % rows) - (rows - 1) / 2)) });
  });
  return new Map([...read, ...others].map((one) => [one.id, there.get(one.id) ?? found.get(one.id)!]));
}

export interface Weights {
  size: number;
  had: number | null;
  fits: boolean;
}
export function boxesOf(mind: Mind, places: Places, findings: Finding[], weights: Record<string, Weights>, masters: string[]): Box[] {
  const said = (id: string, wrong: boolean) => findings.filter((one) => one.at === id && one.wrong === wrong).map((one) => one.text);
  const box = (id: string, title: string, line: string, kind: keyof typeof COLOURS): Box => ({
    id, type: "box", position: places.get(id)!, ariaLabel: `${kind} ${title}`,
    data: { title, line, kind: kind === "actuator" ? "plan" : "part", colour: COLOURS[kind], odd: said(id, false), wrong: said(id, true) },
  });
  const sized = (id: string) => (weights[id]?.size ? `, ${weights[id].size} weights` : "");
  return [
    ...mind.sensors.map((one) => box(one.id, one.name, one.kind, "sensor")),
    ...mind.variables.map((one) => box(one.id, one.name, one.kind.replace("VariableModule", "") || "variable", "variable")),
    ...mind.skills.map((one) =>
      box(one.id, one.name, `${masters.includes(one.name) ? "master" : functionOf(one)}${sized(one.id)}`, "skill")),
    ...mind.actuators.map((one) => box(one.id, one.name, one.kind, "actuator")),
  ];
}

/** Links; what is read is drawn pale, but for what is selected. */
export function linksOf(mind: Mind, selected: string[]): Link[] {
  const found = new Map<string, Link>();
  const add = (skill: string, other: string, input: boolean, label: string) => {
    const id = linkId(skill, other, input);
    if (found.has(id)) return;
    const [source, goal] = input ? [other, skill] : [skill, other];
    const lit = [skill, other, id].some((one) => selected.includes(one));
    const read = lit ? "var(--accent)" : "color-mix(in srgb, var(--soft) 40%, transparent)";
    const both = found.has(linkId(skill, other, !input));
    found.set(id, {
      id, type: "link", source, target: goal, ariaLabel: label,
      data: { lane: both ? [1, 2] : [0, 1], colour: input ? read : "#1f8f4d", width: input ? 1.2 : 2.4, end: "arrow", label },
    } as Link);
  };
  for (const skill of mind.skills) {
    for (const one of skill.inputs) {
      const from = target(mind, one, true);
      if (from) add(skill.id, from.id, true, `${skill.name} reads ${from.name}`);
    }
    for (const one of skill.outputs) {
      const to = target(mind, one, false);
      if (to) add(skill.id, to.id, false, `${skill.name} ${one.startsWith("SK") ? "influences" : "commands"} ${to.name}`);
    }
  }
  return [...found.values()];
}
