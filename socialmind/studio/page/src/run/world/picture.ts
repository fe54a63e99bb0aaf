// From a frame to what the renderer draws.

import { along, NONE, ofNumber, ofWord, read, type Colour } from "../../colours";
import type { Colouring, Column, Frame } from "../frame";
import type { Extent } from "../live.svelte";
import type { Picture, Segments } from "./renderer";

const DISC = 0;
const ARROW = 1;
const SQUARE = 2;
const RING = 3;
const GREEN: Colour = [31, 140, 58];
/** As models name them (society/looks.py), by their numbers in the renderer. */
const SHAPES: Record<string, number> = {
  disc: DISC, arrow: ARROW, square: SQUARE, ring: RING, triangle: 4, diamond: 5, person: 6, animal: 7, house: 8, tree: 9,
};
/** Shapes that turn with who has them; the others stand upright. */
const TURNED = [ARROW, 7];

/** Where agents are, to find the one that is clicked. */
export interface Standing {
  population: string;
  ids: Uint32Array;
  /** x, y, angle, radius and shape of each. */
  numbers: Float32Array;
  from: number;
  count: number;
}

export interface Scene {
  picture: Picture;
  standing: Standing[];
}

export interface Wanted {
  extent: Extent | null;
  networks: Record<string, [string, string]>;
  watched: { population: string; id: number } | null;
  trail: Float32Array;
}

/** What colour a value has: a word's by its place, a number's on the scale. */
function colouring(said: Colouring): (value: number) => Colour {
  const [low, high] = said.range ?? [0, 1];
  const own = said.colours?.map(read);
  if (said.words) return own ? (place) => own[place] ?? NONE : ofWord;
  return own ? (value) => along(own, value, low, high) : (value) => ofNumber(value, low, high);
}

/** The colours of a column, RGBA. */
export function coloured(column: Column, said: Colouring, into: Uint8Array, from: number): void {
  const colourOf = colouring(said);
  for (let row = 0; row < column.length; row += 1) {
    const colour = colourOf(column[row]);
    const at = 4 * (from + row);
    into[at] = colour[0];
    into[at + 1] = colour[1];
    into[at + 2] = colour[2];
    into[at + 3] = 255;
  }
}

class Lines {
  places: number[] = [];
  colours: number[] = [];

  add(ends: ArrayLike<number>, colour: Colour, alpha: number): void {
    for (let place = 0; place < ends.length; place += 1) this.places.push(ends[place]);
    for (let end = 0; end < ends.length / 2; end += 1) this.colours.push(...colour, alpha);
  }

  get segments(): Segments {
    return { places: Float32Array.from(this.places), colours: Uint8Array.from(this.colours) };
  }
}

export function sceneOf(frame: Frame, wanted: Wanted): Scene {
  const { header, columns } = frame;
  const names = Object.keys(header.populations);
  const obstacles = columns.obstacles ?? new Float32Array();
  let count = obstacles.length / 5 + 2;
  for (const name of names) count += 2 * header.populations[name].count;
  const numbers = new Float32Array(5 * count);
  const colours = new Uint8Array(4 * count);
  const standing: Standing[] = [];
  const below = new Lines();
  const above = new Lines();
  let row = 0;
  const add = (x: number, y: number, angle: number, radius: number, shape: number, colour?: Colour, alpha = 255) => {
    numbers.set([x, y, angle, radius, shape], 5 * row);
    if (colour) colours.set([...colour, alpha], 4 * row);
    row += 1;
  };
  for (let at = 0; at < obstacles.length; at += 5) {
    const [x, y, angle, half, round] = obstacles.subarray(at, at + 5);
    add(x, y, angle, half, round ? DISC : SQUARE, GREEN);
  }
  names.forEach((name, number) => {
    const said = header.populations[name];
    const ids = columns[`${name}.id`] as Uint32Array;
    const from = row;
    if (said.kind === "robots") {
      const rows = columns[`${name}.robots`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, angle, radius, emits] = rows.subarray(5 * one, 5 * one + 5);
        const front = [x, y, x + radius * 1.6 * Math.cos(angle), y + radius * 1.6 * Math.sin(angle)];
        add(x, y, angle, radius, DISC, ofWord(number + 1));
        above.add(front, [250, 250, 250], 255);
        if (emits) above.add(circle(x, y, 2 * radius), ofWord(0), 255);
      }
    } else if (said.kind === "objects") {
      const rows = columns[`${name}.objects`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, radius] = rows.subarray(3 * one, 3 * one + 3);
        add(x, y, 0, radius, DISC, ofWord(5 - number));
      }
    } else if (said.kind === "zones") {
      const rows = columns[`${name}.zones`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, angle, half] = rows.subarray(4 * one, 4 * one + 4);
        add(x, y, angle, half, SQUARE, ofWord(4), 110);
      }
    } else if (columns[`${name}.x`]) {
      const [x, y, heading] = ["x", "y", "heading"].map((part) => columns[`${name}.${part}`]);
      const shape = SHAPES[said.shape ?? ""] ?? (heading ? ARROW : DISC);
      const sizes = columns[`${name}.size`];
      const turned = heading && TURNED.includes(shape);
      for (let one = 0; one < said.count; one += 1) {
        const angle = turned ? Math.PI / 2 - (heading[one] * Math.PI) / 180 : 0;
        add(x[one], y[one], angle, sizes ? sizes[one] / 2 : 0.62, shape);
      }
      coloured(columns[`${name}.colour`], said, colours, from);
    }
    standing.push({ population: name, ids, numbers, from, count: row - from });
  });
  if (columns.rays) below.add(columns.rays, NONE, 120);
  if (columns.lines) below.add(columns.lines, NONE, 60);
  for (const [name, ends] of Object.entries(wanted.networks)) addLinks(name, ends, columns, standing, below);
  if (header.plane && header.plane.half_width > 0) above.add(square(header.plane.half_width), GREEN, 255);
  if (wanted.trail.length) above.add(wanted.trail, ofWord(0), 255);
  const seen = wanted.watched && found(standing, wanted.watched.population, wanted.watched.id);
  if (seen) add(seen.x, seen.y, 0, 1.9 * seen.radius, RING, ofWord(1));
  return {
    picture: {
      patches: patchesOf(frame, wanted.extent),
      below: below.segments,
      sprites: { count: row, numbers: numbers.subarray(0, 5 * row), colours: colours.subarray(0, 4 * row) },
      above: above.segments,
    },
    standing,
  };
}

export function found(standing: Standing[], population: string, id: number) {
  const those = standing.find((one) => one.population === population);
  const place = those ? those.ids.indexOf(id) : -1;
  if (!those || place < 0) return null;
  const at = 5 * (those.from + place);
  return { x: those.numbers[at], y: those.numbers[at + 1], radius: those.numbers[at + 3] };
}

/** The agent nearest to a point, if one is there. */
export function clicked(standing: Standing[], x: number, y: number, reach: number) {
  let best: { population: string; id: number } | null = null;
  let least = reach;
  for (const those of standing) {
    for (let one = 0; one < those.count; one += 1) {
      const at = 5 * (those.from + one);
      const away = Math.hypot(those.numbers[at] - x, those.numbers[at + 1] - y) - those.numbers[at + 3];
      if (away < least) {
        least = away;
        best = { population: those.population, id: those.ids[one] };
      }
    }
  }
  return best;
}

function patchesOf(frame: Frame, extent: Extent | null): Picture["patches"] {
  const column = frame.columns.patches;
  if (!column || !frame.header.patches || !extent) return undefined;
  const pixels = new Uint8Array(4 * column.length);
  const said = frame.header.patches;
  const colourOf = colouring(said);
  for (let at = 0; at < column.length; at += 1) {
    const colour = colourOf(column[at]);
    pixels[4 * at] = colour[0];
    pixels[4 * at + 1] = colour[1];
    pixels[4 * at + 2] = colour[2];
    // Pale, so that agents stand out, unless the model says how; a word's first place is the ground itself.
    pixels[4 * at + 3] = said.colours ? 255 : said.words && column[at] === 0 ? 25 : 110;
  }
  return {
    width: extent.width,
    height: extent.height,
    pixels,
    extent: [extent.low_x, extent.low_y, extent.width, extent.height],
  };
}

function addLinks(
  name: string, ends: [string, string], columns: Record<string, Column>, standing: Standing[], lines: Lines,
): void {
  const links = columns[`${name}.links`];
  if (!links) return;
  const places = ends.map((end) => {
    const those = standing.find((one) => one.population === end)!;
    const known = new Map<number, [number, number]>();
    those.ids.forEach((id, one) => {
      const at = 5 * (those.from + one);
      known.set(id, [those.numbers[at], those.numbers[at + 1]]);
    });
    return known;
  });
  for (let at = 0; at < links.length; at += 2) {
    const [one, other] = [places[0].get(links[at]), places[1].get(links[at + 1])];
    if (one && other) lines.add([...one, ...other], NONE, 150);
  }
}

function circle(x: number, y: number, radius: number): number[] {
  const ends: number[] = [];
  for (let step = 0; step < 24; step += 1) {
    for (const at of [step, step + 1]) {
      const angle = (at * Math.PI) / 12;
      ends.push(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
  }
  return ends;
}

function square(half: number): number[] {
  return [-half, -half, half, -half, half, -half, half, half, half, half, -half, half, -half, half, -half, -half];
}
