// How axes look in all panels.

import type uPlot from "uplot";

/** How often a second plots follow what runs. */
export const REDRAWN = 4;

export function axes(): uPlot.Axis[] {
  const ink = getComputedStyle(document.documentElement).getPropertyValue("color");
  const axis = { stroke: ink, grid: { stroke: "#88888833" }, ticks: { stroke: "#88888866" }, font: "11px system-ui" };
  // As wide as its longest number.
  const wide = (_: uPlot, numbers: string[] | null) => 22 + 6.4 * Math.max(4, ...(numbers ?? []).map((one) => one.length));
  return [{ ...axis, size: 32 }, { ...axis, size: wide }];
}
