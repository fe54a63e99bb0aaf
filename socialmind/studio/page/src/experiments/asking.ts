// What the server says of sweeps (server/sweeps.py).

import { asking } from "../ask";

export interface Listed {
  folder: string;
  model?: string;
  status?: string;
  points?: number;
  columns?: string[];
  created?: string;
  error?: string;
}

export type Row = Record<string, number | string | boolean | null>;

export interface Told {
  model: string;
  status: string;
  error: string | null;
  design: string;
  points: number;
  varied: string[];
  measures: string[];
  ticks: number;
  runs: number;
  done: number;
  counts: Record<string, number>;
  rate: number | null;
  left: number | null;
  failed: Row[];
  latest: Row[];
}

export interface Figures {
  figures: { name: string; caption: string; svg: string }[];
  notes: string[];
}

export const ask = asking("sweeps");

/** Seconds as people say them. */
export function lasting(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}
