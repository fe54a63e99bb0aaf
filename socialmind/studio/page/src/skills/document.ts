// A mind of skills as a document, in the words of its files, and what can be done to it. Nothing is changed in place.

import type { Position } from "../graph/layout";

export interface Module {
  id: string;
  name: string;
  position: Position;
  /** Its type, as the files say it. */
  kind: string;
  /** What follows in its line. */
  fields: string[];
}
export interface Skill {
  id: string;
  name: string;
  position: Position;
  /** In order: "SE:S1", "SH:S1:5", "VA:ROLE". */
  inputs: string[];
  /** In order: "MO:MotL", "SK:Avoid", "VA:ROLE". */
  outputs: string[];
  function: string;
  lines: string[];
  /** The text of its own program, if it has one. */
  program: string | null;
}
export interface Mind {
  name: string;
  sensors: Module[];
  actuators: Module[];
  variables: Module[];
  skills: Skill[];
}
export type Kind = "sensor" | "actuator" | "variable" | "skill";
export type Part = (Module | Skill) & { part: Kind };

export const EMPTY: Mind = { name: "mind", sensors: [], actuators: [], variables: [], skills: [] };
export const LISTS = { sensor: "sensors", actuator: "actuators", variable: "variables", skill: "skills" } as const;
const KINDS = Object.keys(LISTS) as Kind[];
const INPUTS: Record<string, Kind> = { SE: "sensor", SD: "sensor", SH: "sensor", VA: "variable", VD: "variable", VH: "variable" };
const OUTPUTS: Record<string, Kind> = { MO: "actuator", SK: "skill", VA: "variable" };
export const CODES = { actuator: "MO", skill: "SK", variable: "VA" } as const;

export const NETWORKS: Record<string, string> = {
  BASIC: "perceptron", CNN: "convolution", ELMAN: "Elman network", RNN: "recurrent network", NEAT: "NEAT graph",
  INFLUENCE: "influence network",
};
export const PROGRAM = "hardCoded";
export const SCHEME = "cognitonScheme";
export const VARIABLES: Record<string, { says: string; fields: string[] }> = {
  VariableModule: { says: "keeps what it was last commanded", fields: ["default"] },
  TickWaveSinVariableModule: { says: "a wave whose frequency is commanded", fields: ["default"] },
  CounterVariableModule: { says: "counts commands", fields: ["default", "maximum", "increment", "reset"] },
  SharedVariableModule: { says: "one value for a group", fields: ["default", "group"] },
  RegulatedVariableModule: { says: "a function of your own", fields: ["default", "function"] },
};

let last = 0;
export const fresh = () => `n${Date.now().toString(36)}${(last += 1)}`;

export function partOf(mind: Mind, id: string): Part | null {
  for (const part of KINDS) {
    const one = (mind[LISTS[part]] as (Module | Skill)[]).find((each) => each.id === id);
    if (one) return { ...one, part } as Part;
  }
  return null;
}
export function named(mind: Mind, part: Kind, name: string): Module | Skill | undefined {
  return (mind[LISTS[part]] as (Module | Skill)[]).find((one) => one.name === name);
}

/** The module that an input reads, or an output goes to. */
export function target(mind: Mind, link: string, input: boolean): (Module | Skill) | undefined {
  const [code, name] = link.split(":");
  const part = (input ? INPUTS : OUTPUTS)[code];
  return part && named(mind, part, name);
}
const called = (link: string, kinds: Record<string, Kind>, part: Kind, name: string) => {
  const [code, of] = link.split(":");
  return kinds[code] === part && of === name;
};
const renamed = (link: string, name: string) => {
  const [code, , ...rest] = link.split(":");
  return [code, name, ...rest].join(":");
};

export function set(mind: Mind, id: string, fields: Partial<Module & Skill>): Mind {
  const before = partOf(mind, id);
  if (!before) return mind;
  const list = LISTS[before.part];
  let next = { ...mind, [list]: (mind[list] as Module[]).map((one) => (one.id === id ? { ...one, ...fields } : one)) } as Mind;
  const name = fields.name;
  if (name !== undefined && name !== before.name)
    next = {
      ...next,
      skills: next.skills.map((one) => ({
        ...one,
        inputs: one.inputs.map((link) => (called(link, INPUTS, before.part, before.name) ? renamed(link, name) : link)),
        outputs: one.outputs.map((link) => (called(link, OUTPUTS, before.part, before.name) ? renamed(link, name) : link)),
      })),
    };
  return next;
}

/** A name of a kind that is not there yet. */
function free(mind: Mind, part: Kind, begin: string): string {
  let number = 1;
  while (named(mind, part, `${begin}${number}`)) number += 1;
  return `${begin}${number}`;
}
export function added(mind: Mind, part: Kind, id: string, position: Position): Mind {
  if (part === "skill") {
    const one: Skill = { id, name: free(mind, part, "Skill"), position, inputs: [], outputs: [], function: "neural", lines: ["TYPE:BASIC", "LAYERS:2"], program: null };
    return { ...mind, skills: [...mind.skills, one] };
  }
  const [begin, kind] = { sensor: ["S", "sensor"], actuator: ["Mot", "actuator"], variable: ["VAR", "VariableModule"] }[part];
  const one: Module = { id, name: free(mind, part, begin), position, kind, fields: [] };
  return { ...mind, [LISTS[part]]: [...mind[LISTS[part]], one] };
}

/** The link from one part to another as an output or input of a skill; null if there can be none. */
export function linkBetween(mind: Mind, from: string, to: string): { skill: string; input: boolean; link: string } | null {
  const [a, b] = [partOf(mind, from), partOf(mind, to)];
  if (!a || !b) return null;
  if (a.part === "skill" && b.part !== "sensor")
    return { skill: from, input: false, link: `${CODES[b.part as keyof typeof CODES]}:${b.name}` };
  if (b.part === "skill" && a.part === "sensor") return { skill: to, input: true, link: `SE:${a.name}` };
  if (b.part === "skill" && a.part === "variable") return { skill: to, input: true, link: `VA:${a.name}` };
  return null;
}
export function linked(mind: Mind, from: string, to: string): Mind {
  const made = linkBetween(mind, from, to);
  const skill = made && (partOf(mind, made.skill) as Skill);
  if (!made || !skill) return mind;
  const list = made.input ? "inputs" : "outputs";
  if (skill[list].includes(made.link)) return mind;
  return set(mind, made.skill, { [list]: [...skill[list], made.link] });
}

/** Without parts and links, by their ids; what skills read of a part that goes, or command in it, goes with it. */
export function without(mind: Mind, ids: string[]): Mind {
  let next = mind;
  for (const id of ids) {
    const link = parsedLink(id);
    if (link) {
      const skill = partOf(next, link.skill) as Skill | null;
      const list = link.input ? "inputs" : "outputs";
      if (skill) next = set(next, link.skill, { [list]: skill[list].filter((one) => target(next, one, link.input)?.id !== link.other) });
      continue;
    }
    const part = partOf(next, id);
    if (!part) continue;
    const list = LISTS[part.part];
    next = { ...next, [list]: (next[list] as Module[]).filter((one) => one.id !== id) } as Mind;
    next = {
      ...next,
      skills: next.skills.map((one) => ({
        ...one,
        inputs: one.inputs.filter((link) => !called(link, INPUTS, part.part, part.name)),
        outputs: one.outputs.filter((link) => !called(link, OUTPUTS, part.part, part.name)),
      })),
    };
  }
  return next;
}

/** A link of the drawing: all inputs of a skill from one part, or its output to one. */
export const linkId = (skill: string, other: string, input: boolean) => `${input ? "in" : "out"} ${skill} ${other}`;
export function parsedLink(id: string): { skill: string; other: string; input: boolean } | null {
  const [way, skill, other] = id.split(" ");
  return other && (way === "in" || way === "out") ? { skill, other, input: way === "in" } : null;
}

const RESERVED = new Set(("False None True and as assert async await break class continue def del elif else except finally for from global if import "
  + "in is lambda nonlocal not or pass raise return try while with yield").split(" "));
/** A program to begin with: it takes what the skill reads, and leaves every output in the middle. */
export function begunProgram(skill: Skill): string {
  const name = skill.name.replace(/([a-z0-9])(?=[A-Z])/g, "$1_").toLowerCase().replace(/\W+/g, "_").replace(/^(\d|$)/, "program_$1");
  const read = skill.inputs.map((one) => one.split(":")[1] ?? "");
  const plain = read.every((one, place) => /^[A-Za-z_]\w*$/.test(one) && !RESERVED.has(one) && read.indexOf(one) === place);
  const halves = skill.outputs.map(() => "0.5").join(", ") || "0.5";
  return `def ${RESERVED.has(name) ? `${name}_` : name}(${plain ? read.join(", ") : "inputs"}):\n    return ${halves}\n`;
}

/** The value of a keyword among the lines of a function. */
export function valueOf(lines: string[], keyword: string): string {
  const line = lines.find((one) => one.split(":")[0].toUpperCase() === keyword);
  return line ? line.split(":").slice(1).join(":") : "";
}
export function withValue(lines: string[], keyword: string, value: string): string[] {
  const at = lines.findIndex((one) => one.split(":")[0].toUpperCase() === keyword);
  if (value === "") return lines.filter((_, place) => place !== at);
  if (at < 0) return [...lines, `${keyword}:${value}`];
  return lines.map((one, place) => (place === at ? `${one.split(":")[0]}:${value}` : one));
}
/** What a skill's function is, in a few words. */
export function functionOf(skill: Skill): string {
  if (skill.function === PROGRAM) return `program ${valueOf(skill.lines, "CLASS")}`;
  if (skill.function === SCHEME) return `scheme ${valueOf(skill.lines, "SCHEME")}`;
  return NETWORKS[valueOf(skill.lines, "TYPE") || "BASIC"] ?? "network";
}
