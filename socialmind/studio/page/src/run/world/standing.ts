// Where agents are, to find the one that is watched or clicked.

/** The agents of a population. */
export interface Standing {
  population: string;
  ids: Uint32Array;
  /** x, y, angle, radius and shape of each. */
  numbers: Float32Array;
  from: number;
  count: number;
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
