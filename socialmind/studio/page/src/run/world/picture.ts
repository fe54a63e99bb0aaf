// From a frame to what is drawn: patches, what lies below the bodies, the bodies, and what lies above them.

import { NONE, ofWord } from "../../colours";
import type { Column, Frame } from "../frame";
import type { Extent } from "../live.svelte";
import { bodiesOf, GREEN } from "./bodies";
import type { Packed, Patches, Picture, Segments } from "./drawing";
import { packed, palette } from "./palette";
import { RING } from "./shapes";
import { found, type Standing } from "./standing";

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
  const { rows, standing, foot } = bodiesOf(frame, wanted.extent !== null);
  const seen = wanted.watched && found(standing, wanted.watched.population, wanted.watched.id);
  if (seen) rows.add(seen.x, seen.y, 0, 1.9 * seen.radius, RING, packed(ofWord(1)));
  const picture = {
    patches: patchesOf(frame, wanted.extent),
    below: below(frame.columns, wanted.networks, standing),
    sprites: rows.sprites,
    above: above(frame, wanted.trail),
  };
  return { picture, standing, foot };
}

function patchesOf(frame: Frame, extent: Extent | null): Patches | undefined {
  const values = frame.columns.patches as Uint8Array | undefined;
  const said = frame.header.patches;
  if (!values || !said || values.length !== (extent?.width ?? 0) * (extent?.height ?? 0)) return undefined; // of the model before
  // Pale, so that agents stand out, unless the model says how; a word's first place is the ground itself.
  const alpha = (place: number) => (said.colours ? 255 : said.words && place === 0 ? 25 : 110);
  return { values, palette: palette(said, alpha), ...extent! };
}

/** Rays, lines to targets, and links of networks. */
function below(columns: Frame["columns"], networks: Wanted["networks"], standing: Standing[]): Segments {
  const lines = new Lines();
  if (columns.rays) lines.add(columns.rays, packed(NONE, 120));
  if (columns.lines) lines.add(columns.lines, packed(NONE, 60));
  for (const [name, ends] of Object.entries(networks)) addLinks(columns[`${name}.links`], ends, standing, lines);
  return lines.segments;
}

function addLinks(links: Column | undefined, ends: [string, string], standing: Standing[], lines: Lines): void {
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

/** What robots look at and emit, the wall around a plane, and where the watched one has been. */
function above({ header, columns }: Frame, trail: Float32Array): Segments {
  const lines = new Lines();
  for (const [name, said] of Object.entries(header.populations)) if (said.kind === "robots") addMarks(columns[`${name}.robots`], lines);
  if (header.plane && header.plane.half_width > 0) lines.add(square(header.plane.half_width), packed(GREEN));
  if (trail.length) lines.add(trail, packed(ofWord(0)));
  return lines.segments;
}

function addMarks(robots: Column, lines: Lines): void {
  for (let at = 0; at < robots.length; at += 5) {
    const [x, y, angle, radius, emits] = robots.subarray(at, at + 5);
    lines.add([x, y, x + radius * 1.6 * Math.cos(angle), y + radius * 1.6 * Math.sin(angle)], packed([250, 250, 250]));
    if (emits) lines.add(circle(x, y, 2 * radius), packed(ofWord(0)));
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
