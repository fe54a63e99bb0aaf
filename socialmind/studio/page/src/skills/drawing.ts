// The drawing of a mind: boxes for its parts, in layers from sensors over skills to motors, and links.

import type { Finding } from "../graph/Findings.svelte";
import type { Box, Link } from "../graph/kinds";
import { laidOut, type Place } from "../graph/layout";
import { functionOf, linkId, target, type Mind } from "./document";

export type Places = Map<string, Place>;
const HEIGHT = 44;
const COLOURS = { sensor: "#56a3dc", variable: "#d8b400", skill: "#8c8c8c", actuator: "#e0705c" };
const width = (name: string) => Math.max(96, Math.min(210, 30 + 8 * name.length));

function pairs(mind: Mind): [string, string][] {
  const found: [string, string][] = [];
  for (const skill of mind.skills) {
    for (const one of skill.inputs) {
      const from = target(mind, one, true);
      if (from) found.push([from.id, skill.id]);
    }
    for (const one of skill.outputs) {
      const to = target(mind, one, false);
      // A variable is read in the next tick: drawn where it is written, it would make a way back.
      if (to && !mind.variables.some((each) => each.id === to.id)) found.push([skill.id, to.id]);
    }
  }
  return found;
}

/** Where boxes stand: where they were put, else in layers. */
export function placed(mind: Mind, put: Places): Places {
  const all = [...mind.sensors, ...mind.variables, ...mind.skills, ...mind.actuators];
  if (all.every((one) => put.has(one.id))) return put;
  const sized = all.map((one) => ({ id: one.id, width: width(one.name), height: HEIGHT }));
  const found = laidOut(sized, pairs(mind));
  // Motors stand in one column, behind all skills.
  const edge = Math.max(0, ...mind.skills.map((one) => found.get(one.id)!.x + width(one.name)));
  for (const one of mind.actuators) {
    const at = found.get(one.id)!;
    found.set(one.id, { ...at, x: Math.max(at.x, edge + 110) });
  }
  return new Map(all.map((one) => [one.id, put.get(one.id) ?? found.get(one.id)!]));
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
      box(one.id, one.name, `${masters.includes(one.name) ? "master, " : ""}${functionOf(one)}${sized(one.id)}`, "skill")),
    ...mind.actuators.map((one) => box(one.id, one.name, one.kind, "actuator")),
  ];
}

export function linksOf(mind: Mind): Link[] {
  const found = new Map<string, Link>();
  const add = (skill: string, other: string, input: boolean, label: string) => {
    const id = linkId(skill, other, input);
    if (found.has(id)) return;
    const [source, goal] = input ? [other, skill] : [skill, other];
    const both = found.has(linkId(skill, other, !input));
    found.set(id, {
      id, type: "link", source, target: goal, ariaLabel: label,
      data: { lane: both ? [1, 2] : [0, 1], colour: input ? "var(--soft)" : "#1f8f4d", width: input ? 1.2 : 2.4, end: "arrow", label },
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
