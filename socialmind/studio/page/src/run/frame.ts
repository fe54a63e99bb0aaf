// Frames: a moment of a society as bytes, columns behind a small header (running/frames.py).

export interface Colouring {
  by?: string;
  words?: string[];
  range?: [number, number];
  /** Of the words, or along the range, where the model says how it looks. */
  colours?: string[];
}

export interface PopulationShown extends Colouring {
  count: number;
  kind?: "robots" | "objects" | "zones";
  shape?: string | null;
}

export interface Header {
  tick: number;
  furthest: number;
  running: boolean;
  rate: number;
  populations: Record<string, PopulationShown>;
  patches?: Colouring & { field: string };
  plane?: { half_width: number; over: string | null };
  /** Robots that somebody steers by hand. */
  in_hand?: { population: string; id: number }[];
  watched?: Watched | { gone: string };
  turn?: { number: number; rule: string; population: string | null; id: number | null };
  plots?: PanelShown[];
}

/** What a panel of agents shows; its numbers are columns (running/plots.py). */
export interface PanelShown {
  kind: string;
  population?: string;
  x?: string;
  y?: string;
  words?: string[];
  low?: number;
  high?: number;
}

export type Column = Float32Array | Uint32Array | Uint8Array;

export interface Frame {
  header: Header;
  columns: Record<string, Column>;
}

export interface Influence {
  name: string;
  group: string | null;
  value: number | null;
  participation: number | null;
  acts: boolean;
  contributions: Record<string, number>;
  opens: string[];
}

export interface PlanPart {
  name: string;
  weight: number | null;
  probability: number;
  available: boolean;
  opened_by: string[];
  would_open: string[];
}

export interface Receipt {
  decision_maker: string;
  plans: PlanPart[];
  influences: Influence[];
  choice: string | null;
}

/** Where a hierarchy of skills is drawn; nodes are called "SK:Avoid", "SE:S1", "VA:ROLE", "MO:MotL". */
export interface HierarchyPlan {
  width: number;
  height: number;
  boxes: { name: string; x: number; y: number; width: number; height: number; lines: string[]; flat: boolean }[];
  links: { from: string; to: string; curve: number[] }[];
  readings: { from: string; to: string; curve: number[] }[];
}

/** What the last evaluation of a hierarchy came to: of nodes, and of links by "SKILL OUTPUT". */
export interface Skills {
  values: Record<string, number>;
  sent: Record<string, number>;
  gave: Record<string, number>;
}

export interface Membership {
  group: string;
  instance: number;
  role: string | null;
  participation: number;
  members: number;
  culturons: Record<string, number>;
}

export interface Watched {
  population: string;
  id: number;
  tick: number;
  fields: Record<string, number | string | boolean | null>;
  plan?: string | null;
  cognitons?: Record<string, number | null>;
  links?: { from: string; to: string; kind: string; weight?: number }[];
  groups?: Membership[];
  receipt?: Receipt;
  words?: string[];
  skills?: Skills | null;
}

const TYPES: Record<string, (buffer: ArrayBuffer, at: number, count: number) => Column> = {
  f4: (buffer, at, count) => new Float32Array(buffer, at, count),
  u4: (buffer, at, count) => new Uint32Array(buffer, at, count),
  u1: (buffer, at, count) => new Uint8Array(buffer, at, count),
};

/** Read a frame; the columns are views of it. */
export function decoded(buffer: ArrayBuffer): Frame {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  const { columns: places, ...header } = JSON.parse(text);
  const columns: Record<string, Column> = {};
  for (const [name, place] of Object.entries<{ type: string; shape: number[]; at: number }>(places)) {
    const count = place.shape.reduce((product, side) => product * side, 1);
    columns[name] = TYPES[place.type](buffer, 4 + length + place.at, count);
  }
  return { header, columns };
}
