// Whatever stands in a world as sprites: obstacles, bodies on a plane, agents.

import { ofWord, type Colour } from "../../colours";
import type { Column, Frame, PopulationShown } from "../frame";
import type { Packed, Sprites } from "./drawing";
import { packed, palette } from "./palette";
import { shapeOf, TURNED } from "./shapes";
import type { Standing } from "./standing";

const [DISC, ARROW, SQUARE] = ["disc", "arrow", "square"].map(shapeOf);
export const GREEN: Colour = [31, 140, 58];
/** Between agents that have no places. */
const APART = 1.8;
/** How large agents are that do not say it: from their middle. */
const RADIUS = 0.62;
/** How much zones hide of what lies below them, of 255. */
const PALE = 110;

/** Sprites, one after another. */
class Rows {
  count = 0;
  numbers: Float32Array;
  colours: Uint32Array;

  constructor(room: number) {
    this.numbers = new Float32Array(5 * room);
    this.colours = new Uint32Array(room);
  }

  add(x: number, y: number, angle: number, radius: number, shape: number, colour: Packed): void {
    const at = 5 * this.count;
    this.numbers[at] = x;
    this.numbers[at + 1] = y;
    this.numbers[at + 2] = angle;
    this.numbers[at + 3] = radius;
    this.numbers[at + 4] = shape;
    this.colours[this.count] = colour;
    this.count += 1;
  }

  get sprites(): Sprites {
    return { count: this.count, numbers: this.numbers.subarray(0, 5 * this.count), colours: this.colours.subarray(0, this.count) };
  }
}

/** A population of a frame. */
interface Shown {
  name: string;
  /** Its place among the populations. */
  number: number;
  said: PopulationShown;
  columns: Frame["columns"];
  /** What the model says it looks like, if it does. */
  shape: number | undefined;
}

/** All bodies of a frame; agents that have no places, as `anywhere` allows, are laid out in rows down to `foot`. */
export function bodiesOf({ header, columns }: Frame, anywhere: boolean): { rows: Rows; standing: Standing[]; foot: number } {
  const populations = Object.entries(header.populations);
  const obstacles = columns.obstacles ?? new Float32Array();
  const rows = new Rows(populations.reduce((sum, [, said]) => sum + said.count, obstacles.length / 5 + 1)); // one for a ring
  const standing: Standing[] = [];
  let foot = 0;
  addObstacles(obstacles, rows);
  populations.forEach(([name, said], number) => {
    const one: Shown = { name, number, said, columns, shape: said.shape ? shapeOf(said.shape) : undefined };
    const from = rows.count;
    if (said.kind === "robots") addRobots(one, rows);
    else if (said.kind === "objects") addObjects(one, rows);
    else if (said.kind === "zones") addZones(one, rows);
    else foot = addAgents(one, rows, anywhere, foot);
    colour(one, rows, from);
    standing.push({ population: name, ids: columns[`${name}.id`] as Uint32Array, numbers: rows.numbers, from, count: rows.count - from });
  });
  return { rows, standing, foot };
}

function addObstacles(obstacles: Column, rows: Rows): void {
  for (let at = 0; at < obstacles.length; at += 5) {
    const [x, y, angle, half, round] = obstacles.subarray(at, at + 5);
    rows.add(x, y, angle, half, round ? DISC : SQUARE, packed(GREEN));
  }
}

function addRobots({ name, number, columns, shape }: Shown, rows: Rows): void {
  const bodies = columns[`${name}.robots`];
  const turned = shape === undefined || TURNED.includes(shape);
  for (let at = 0; at < bodies.length; at += 5) {
    const [x, y, angle, radius] = bodies.subarray(at, at + 4);
    rows.add(x, y, turned ? angle : 0, radius, shape ?? DISC, packed(ofWord(number + 1)));
  }
}

function addObjects({ name, number, columns, shape }: Shown, rows: Rows): void {
  const bodies = columns[`${name}.objects`];
  for (let at = 0; at < bodies.length; at += 3) {
    const [x, y, radius] = bodies.subarray(at, at + 3);
    rows.add(x, y, 0, radius, shape ?? DISC, packed(ofWord(5 - number)));
  }
}

function addZones({ name, columns, shape }: Shown, rows: Rows): void {
  const bodies = columns[`${name}.zones`];
  for (let at = 0; at < bodies.length; at += 4) {
    const [x, y, angle, half] = bodies.subarray(at, at + 4);
    rows.add(x, y, angle, half, shape ?? SQUARE, packed(ofWord(4), PALE));
  }
}

/** Returns how far down the agents go that have no places. */
function addAgents({ name, said, columns, shape }: Shown, rows: Rows, anywhere: boolean, top: number): number {
  const [heading, sizes] = [columns[`${name}.heading`], columns[`${name}.size`]];
  const placed = anywhere || isPlaced(columns[`${name}.x`], columns[`${name}.y`]);
  const [x, y] = placed ? [columns[`${name}.x`], columns[`${name}.y`]] : lattice(said.count, top);
  const form = shape ?? (heading ? ARROW : DISC);
  const turned = heading && TURNED.includes(form);
  for (let one = 0; one < said.count; one += 1) {
    const angle = turned ? Math.PI / 2 - (heading[one] * Math.PI) / 180 : 0;
    rows.add(x[one], y[one], angle, sizes ? sizes[one] / 2 : RADIUS, form, 0);
  }
  return placed ? top : (y[y.length - 1] ?? top) - 2 * APART;
}

/** Give those from a row on the colours that the frame says, if it says any. */
function colour({ name, said, columns }: Shown, rows: Rows, from: number): void {
  const places = columns[`${name}.colour`];
  if (!places) return;
  const colours = palette(said);
  const alpha = said.kind === "zones" ? (PALE << 24) | 0xffffff : -1;
  for (let one = 0; one < said.count; one += 1) rows.colours[from + one] = colours[places[one]] & alpha;
}

/** Whether agents stand anywhere: in a model without a world all are at 0, 0. */
function isPlaced(x: Column | undefined, y: Column | undefined): boolean {
  return !!x && !!y && (x.length < 2 || x.some((one) => one !== x[0]) || y.some((one) => one !== y[0]));
}

/** Places for agents that have none: rows from left to right, in the order of birth, below `top`. */
function lattice(count: number, top: number): [Float32Array, Float32Array] {
  const across = Math.max(1, Math.ceil(Math.sqrt(count)));
  const [x, y] = [new Float32Array(count), new Float32Array(count)];
  for (let one = 0; one < count; one += 1) {
    x[one] = ((one % across) - (across - 1) / 2) * APART;
    y[one] = top - Math.floor(one / across) * APART;
  }
  return [x, y];
}
