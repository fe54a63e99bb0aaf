// From a frame to what is drawn.

import { NONE, ofShare, ofWord, read, type Colour } from "../../colours";
import type { Colouring, Column, Frame } from "../frame";
import type { Extent } from "../live.svelte";
import type { Packed, Patches, Picture, Segments } from "./drawing";
import { RING, shapeOf, TURNED } from "./shapes";

const [DISC, ARROW, SQUARE] = ["disc", "arrow", "square"].map(shapeOf);
/** Between agents that have no places. */
const APART = 1.8;
const GREEN: Colour = [31, 140, 58];
/** How much zones hide of what lies below them, of 255. */
const PALE = 110;
/** The last place along a scale; `NOTHING` is after it. */
const LAST = 254;
const NOTHING = 255;

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
  /** How far down those go that have no places, from 0. */
  foot: number;
}

export interface Wanted {
  extent: Extent | null;
  networks: Record<string, [string, string]>;
  watched: { population: string; id: number } | null;
  trail: Float32Array;
}

export function packed([red, green, blue]: Colour, alpha = 255): Packed {
  return (red | (green << 8) | (blue << 16) | (alpha << 24)) >>> 0;
}

/** The colour of each place: a word's, or along the scale; `alpha` says how much of what lies below it hides. */
function palette(said: Colouring, alpha: (place: number) => number = () => 255): Uint32Array {
  const own = said.colours?.map(read);
  return Uint32Array.from({ length: NOTHING + 1 }, (_, place) => {
    const word = own ? (own[place] ?? NONE) : ofWord(place);
    const colour = said.words ? word : place === NOTHING ? NONE : ofShare(place / LAST, own);
    return packed(colour, alpha(place));
  });
}

class Lines {
  places: number[] = [];
  colours: number[] = [];

  add(ends: ArrayLike<number>, colour: Packed): void {
    for (let place = 0; place < ends.length; place += 1) this.places.push(ends[place]);
    for (let line = 0; line < ends.length / 4; line += 1) this.colours.push(colour);
  }

  get segments(): Segments {
    return { places: Float32Array.from(this.places), colours: Uint32Array.from(this.colours) };
  }
}

export function sceneOf(frame: Frame, wanted: Wanted): Scene {
  const { header, columns } = frame;
  const names = Object.keys(header.populations);
  const obstacles = columns.obstacles ?? new Float32Array();
  let count = obstacles.length / 5 + 1; // and the ring around who is watched
  for (const name of names) count += header.populations[name].count;
  const numbers = new Float32Array(5 * count);
  const colours = new Uint32Array(count);
  const standing: Standing[] = [];
  let foot = 0; // of the agents without places that are laid out so far
  const below = new Lines();
  const above = new Lines();
  let row = 0;
  const add = (x: number, y: number, angle: number, radius: number, shape: number, colour: Packed) => {
    numbers.set([x, y, angle, radius, shape], 5 * row);
    colours[row] = colour;
    row += 1;
  };
  for (let at = 0; at < obstacles.length; at += 5) {
    const [x, y, angle, half, round] = obstacles.subarray(at, at + 5);
    add(x, y, angle, half, round ? DISC : SQUARE, packed(GREEN));
  }
  names.forEach((name, number) => {
    const said = header.populations[name];
    const ids = columns[`${name}.id`] as Uint32Array;
    const from = row;
    const places = columns[`${name}.colour`];
    const colourOf = places && palette(said);
    const shape = said.shape ? shapeOf(said.shape) : undefined;
    if (said.kind === "robots") {
      const rows = columns[`${name}.robots`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, angle, radius, emits] = rows.subarray(5 * one, 5 * one + 5);
        const front = [x, y, x + radius * 1.6 * Math.cos(angle), y + radius * 1.6 * Math.sin(angle)];
        const turned = shape === undefined || TURNED.includes(shape);
        add(x, y, turned ? angle : 0, radius, shape ?? DISC, packed(ofWord(number + 1)));
        above.add(front, packed([250, 250, 250]));
        if (emits) above.add(circle(x, y, 2 * radius), packed(ofWord(0)));
      }
    } else if (said.kind === "objects") {
      const rows = columns[`${name}.objects`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, radius] = rows.subarray(3 * one, 3 * one + 3);
        add(x, y, 0, radius, shape ?? DISC, packed(ofWord(5 - number)));
      }
    } else if (said.kind === "zones") {
      const rows = columns[`${name}.zones`];
      for (let one = 0; one < said.count; one += 1) {
        const [x, y, angle, half] = rows.subarray(4 * one, 4 * one + 4);
        add(x, y, angle, half, shape ?? SQUARE, packed(ofWord(4), PALE));
      }
    } else {
      const heading = columns[`${name}.heading`];
      const placed = wanted.extent !== null || isPlaced(columns[`${name}.x`], columns[`${name}.y`]);
      const [x, y] = placed ? [columns[`${name}.x`], columns[`${name}.y`]] : lattice(said.count, foot);
      if (!placed) foot = lowest(y, foot) - 2 * APART;
      const form = shape ?? (heading ? ARROW : DISC);
      const sizes = columns[`${name}.size`];
      const turned = heading && TURNED.includes(form);
      for (let one = 0; one < said.count; one += 1) {
        const angle = turned ? Math.PI / 2 - (heading[one] * Math.PI) / 180 : 0;
        const at = 5 * row;
        numbers[at] = x[one];
        numbers[at + 1] = y[one];
        numbers[at + 2] = angle;
        numbers[at + 3] = sizes ? sizes[one] / 2 : 0.62;
        numbers[at + 4] = form;
        row += 1;
      }
    }
    if (colourOf) {
      const alpha = said.kind === "zones" ? (PALE << 24) | 0xffffff : -1;
      for (let one = 0; one < said.count; one += 1) colours[from + one] = colourOf[places[one]] & alpha;
    }
    standing.push({ population: name, ids, numbers, from, count: row - from });
  });
  if (columns.rays) below.add(columns.rays, packed(NONE, 120));
  if (columns.lines) below.add(columns.lines, packed(NONE, 60));
  for (const [name, ends] of Object.entries(wanted.networks)) addLinks(name, ends, columns, standing, below);
  if (header.plane && header.plane.half_width > 0) above.add(square(header.plane.half_width), packed(GREEN));
  if (wanted.trail.length) above.add(wanted.trail, packed(ofWord(0)));
  const seen = wanted.watched && found(standing, wanted.watched.population, wanted.watched.id);
  if (seen) add(seen.x, seen.y, 0, 1.9 * seen.radius, RING, packed(ofWord(1)));
  return {
    picture: {
      patches: patchesOf(frame, wanted.extent),
      below: below.segments,
      sprites: { count: row, numbers: numbers.subarray(0, 5 * row), colours: colours.subarray(0, row) },
      above: above.segments,
    },
    standing,
    foot,
  };
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
/** Whether agents stand anywhere: in a model without a world all are at 0, 0. */
function isPlaced(x: Column | undefined, y: Column | undefined): boolean {
  return !!x && !!y && (x.length < 2 || x.some((one) => one !== x[0]) || y.some((one) => one !== y[0]));
}
const lowest = (y: ArrayLike<number>, otherwise: number) => (y.length ? y[y.length - 1] : otherwise);

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

function patchesOf(frame: Frame, extent: Extent | null): Patches | undefined {
  const values = frame.columns.patches as Uint8Array | undefined;
  const said = frame.header.patches;
  if (!values || !said || values.length !== (extent?.width ?? 0) * (extent?.height ?? 0)) return undefined; // of the model before
  // Pale, so that agents stand out, unless the model says how; a word's first place is the ground itself.
  const alpha = (place: number) => (said.colours ? 255 : said.words && place === 0 ? 25 : 110);
  return { values, palette: palette(said, alpha), ...extent! };
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
    if (one && other) lines.add([...one, ...other], packed(NONE, 150));
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
