// The panels of plots below the world: which there are, in which order, and what each shows.

import { studio } from "../studio.svelte";

export interface SeriesPanel {
  key: number;
  kind: "series";
  names: string[];
}
export interface AgentsPanel {
  key: number;
  kind: "histogram" | "scatter";
  population: string;
  x: string;
  y: string;
}
export type Panel = SeriesPanel | AgentsPanel;

export const MOST = 4;

class Panels {
  all = $state<Panel[]>([]);
  #next = 0;

  /** Have what a society can show: its own first series, and no panel of what it has not. */
  fit(series: string[], colourings: Record<string, string[]>): void {
    const kept = this.all.filter((one) =>
      one.kind === "series"
        ? one.names.some((name) => series.includes(name))
        : colourings[one.population]?.includes(one.x) && (one.kind === "histogram" || colourings[one.population].includes(one.y)),
    );
    this.all = kept.length ? kept : [{ key: this.#next++, kind: "series", names: series.slice(0, 2) }];
  }
  add(kind: Panel["kind"]): void {
    const society = studio.society!;
    if (kind === "series") {
      this.all.push({ key: this.#next++, kind, names: society.series.slice(0, 1) });
      return;
    }
    const names = Object.keys(society.colourings).sort((one, other) => minded(other) - minded(one));
    const population = names.find((one) => values(one).length) ?? names[0];
    const [x, y] = values(population);
    this.all.push({ key: this.#next++, kind, population, x: x ?? "one", y: y ?? x ?? "one" });
  }
  remove(panel: Panel): void {
    this.all = this.all.filter((one) => one.key !== panel.key);
  }
  move(panel: Panel, by: -1 | 1): void {
    const at = this.all.findIndex((one) => one.key === panel.key);
    const to = at + by;
    if (to < 0 || to >= this.all.length) return;
    const moved = [...this.all];
    [moved[at], moved[to]] = [moved[to], moved[at]];
    this.all = moved;
  }
}

/** Those with a mind are looked at first. */
function minded(population: string): number {
  const one = studio.model?.populations[population];
  return Number(one?.scheme || one?.skills || false);
}

/** What of a population can be counted and set against another: fields and cognitons. */
export function values(population: string): string[] {
  return (studio.society?.colourings[population] ?? []).filter((one) => /^(field|cogniton) /.test(one));
}

/** What a value is called. */
export function called(value: string): string {
  return value.replace(/^(field|cogniton|role) /, "").replaceAll("_", " ");
}

export const panels = new Panels();
