// What is drawn of a world, whatever draws it.

export interface View {
  x: number;
  y: number;
  /** Units of the world that half of the canvas's height shows. */
  half: number;
}

/** A colour as four bytes, red first: what a pixel is in memory where the least byte comes first. */
export type Packed = number;

/** x, y, angle (radians, 0 to the right), radius and shape of each; and its colour. */
export interface Sprites {
  count: number;
  numbers: Float32Array;
  colours: Uint32Array;
}

/** x, y of both ends of each; and its colour. */
export interface Segments {
  places: Float32Array;
  colours: Uint32Array;
}

/** Values of patches, column by column from the south-west, and the colour of each value. */
export interface Patches {
  values: Uint8Array;
  palette: Uint32Array;
  low_x: number;
  low_y: number;
  width: number;
  height: number;
}

export interface Picture {
  patches?: Patches;
  below: Segments;
  sprites: Sprites;
  above: Segments;
}

export interface Drawing {
  /** Draw a picture on a ground of one colour; the canvas has the size that it is to have. */
  draw(picture: Picture, view: View, ground: Packed): void;
}

/** A sprite is seen where it is no smaller than so many pixels from its middle. */
export const LEAST = 2.5;
/** How many pixels the edge of a sprite is soft, and how far from the edge its rim goes, of its radius. */
export const SOFT = 1.3;
export const RIM = 0.12;
