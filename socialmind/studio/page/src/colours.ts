// Colours that the colour-blind tell apart, on light and on dark ground.

export type Colour = [number, number, number];

/** For words: after Okabe and Ito (2008), the yellow darkened so that it is seen on white. */
const WORDS: Colour[] = [
  [0, 114, 178],
  [213, 94, 0],
  [0, 158, 115],
  [204, 121, 167],
  [86, 180, 233],
  [200, 160, 0],
  [120, 120, 120],
  [110, 60, 140],
];
export const NONE: Colour = [150, 150, 150];

/** Viridis at nine places (BSD, van der Walt and Smith); between them colours are mixed. */
const SCALE: Colour[] = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];

export function ofWord(place: number): Colour {
  return place === 255 || place < 0 ? NONE : WORDS[place % WORDS.length];
}

/** A colour written as #rrggbb. */
export function read(text: string): Colour {
  const number = parseInt(text.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/** A colour along a scale of several, from 0 to 1. */
export function ofShare(share: number, scale: Colour[] = SCALE): Colour {
  const at = Math.max(0, Math.min(1, share)) * (scale.length - 1);
  const from = Math.min(Math.floor(at), scale.length - 2);
  return [0, 1, 2].map((part) => Math.round(scale[from][part] + (at - from) * (scale[from + 1][part] - scale[from][part]))) as Colour;
}

export function css([red, green, blue]: Colour): string {
  return `rgb(${red} ${green} ${blue})`;
}

/** A number as people read it. */
export function shown(value: unknown): string {
  if (value === null || value === undefined) return "–";
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e7) return value.toLocaleString("en").replaceAll(",", "\u202f");
  return Number(value.toPrecision(4)).toString().replace("-", "−");
}
