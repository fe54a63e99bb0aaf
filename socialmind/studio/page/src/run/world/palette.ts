// Colours as pixels have them, and the colour of each place of a column.

import { NONE, ofShare, ofWord, read, type Colour } from "../../colours";
import type { Colouring } from "../frame";
import type { Packed } from "./drawing";

/** The last place along a scale; `NOTHING` is after it. */
const LAST = 254;
const NOTHING = 255;

export function packed([red, green, blue]: Colour, alpha = 255): Packed {
  return (red | (green << 8) | (blue << 16) | (alpha << 24)) >>> 0;
}

/** The colour of each place: a word's, or along the scale; `alpha` says how much of what lies below it hides. */
export function palette(said: Colouring, alpha: (place: number) => number = () => 255): Uint32Array {
  const own = said.colours?.map(read);
  return Uint32Array.from({ length: NOTHING + 1 }, (_, place) => {
    const word = own ? (own[place] ?? NONE) : ofWord(place);
    const colour = said.words ? word : place === NOTHING ? NONE : ofShare(place / LAST, own);
    return packed(colour, alpha(place));
  });
}
