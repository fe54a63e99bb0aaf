// The world drawn by the processor, pixel by pixel: where there is no graphics card, WebGL takes ten times as long.

import { LEAST, RIM, SOFT, type Drawing, type Packed, type Patches, type Picture, type Segments, type Sprites, type View } from "./drawing";
import { inside, REACH, RING } from "./shapes";

/** Opaque sprites of up to so many pixels from middle to edge are stamped, in steps of a turn, of size and of place. */
const STAMPED = 16;
const TURNS = 64;
const SIZES = 4;
const PLACES = 4;
const MOST_STAMPS = 8192;

/** Pixels of a sprite, three numbers each: how far on it lies, and the shares of 256 of the sprite's colour and of what was there. */
type Stamp = Int32Array;

function smooth(edge: number, at: number): number {
  const along = Math.min(1, Math.max(0, at / edge));
  return along * along * (3 - 2 * along);
}

export class Raster implements Drawing {
  #canvas: HTMLCanvasElement;
  #context: CanvasRenderingContext2D;
  #image = new ImageData(1, 1);
  #pixels = new Uint32Array(1);
  #width = 1;
  #height = 1;
  #stamps = new Map<number, Stamp>();
  /** Pixels that a unit of the world is long, and the place of its origin. */
  #unit = 1;
  #left = 0;
  #top = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#context = canvas.getContext("2d", { alpha: false })!;
  }

  draw(picture: Picture, view: View, ground: Packed): void {
    const { width, height } = this.#canvas;
    if (!width || !height) return;
    if (width !== this.#width || height !== this.#height) {
      this.#image = this.#context.createImageData(width, height);
      this.#pixels = new Uint32Array(this.#image.data.buffer);
      [this.#width, this.#height] = [width, height];
      this.#stamps.clear();
    }
    this.#unit = height / (2 * view.half);
    this.#left = width / 2 - view.x * this.#unit;
    this.#top = height / 2 + view.y * this.#unit;
    this.#pixels.fill(opaque(ground));
    if (picture.patches) this.#drawPatches(picture.patches, ground);
    this.#drawLines(picture.below);
    this.#drawSprites(picture.sprites);
    this.#drawLines(picture.above);
    this.#context.putImageData(this.#image, 0, 0);
  }

  #drawPatches({ values, palette, low_x, low_y, width, height }: Patches, ground: Packed): void {
    const shown = palette.map((one) => opaque(mixed(one, ground, one >>> 24)));
    const rows = places(this.#width, width, (pixel) => (pixel - this.#left) / this.#unit - low_x);
    const columns = places(this.#height, height, (pixel) => (this.#top - pixel) / this.#unit - low_y);
    const pixels = this.#pixels;
    for (let y = 0, at = 0, last = -2; y < this.#height; y += 1, at += this.#width) {
      const column = columns[y];
      if (column === last) pixels.copyWithin(at, at - this.#width, at);
      else if (column >= 0) {
        for (let x = 0; x < this.#width; x += 1) if (rows[x] >= 0) pixels[at + x] = shown[values[rows[x] * height + column]];
      }
      last = column;
    }
  }

  #drawSprites({ count, numbers, colours }: Sprites): void {
    const unit = this.#unit;
    const left = this.#left;
    const top = this.#top;
    const across = this.#width;
    const down = this.#height;
    for (let one = 0; one < count; one += 1) {
      const at = 5 * one;
      const x = left + numbers[at] * unit;
      const y = top - numbers[at + 1] * unit;
      const radius = Math.max(numbers[at + 3] * unit, LEAST);
      const reach = 1.63 * radius + 2; // to the corners
      if (!(x > -reach && x < across + reach && y > -reach && y < down + reach)) continue;
      const whole = x > reach && x < across - reach && y > reach && y < down - reach;
      if (whole && radius <= STAMPED && colours[one] >>> 24 === 255) this.#stamp(x, y, radius, numbers[at + 2], numbers[at + 4], colours[one]);
      else this.#paint(x, y, radius, numbers[at + 2], numbers[at + 4], colours[one]);
    }
  }

  #stamp(x: number, y: number, radius: number, angle: number, shape: number, colour: Packed): void {
    const turn = Math.round((angle / (2 * Math.PI)) * TURNS) & (TURNS - 1);
    const size = Math.round(radius * SIZES);
    const column = Math.floor(x);
    const row = Math.floor(y);
    const right = Math.floor((x - column) * PLACES);
    const under = Math.floor((y - row) * PLACES);
    const key = (((shape * TURNS + turn) * (STAMPED * SIZES + 1) + size) * PLACES + right) * PLACES + under;
    let stamp = this.#stamps.get(key);
    if (!stamp) {
      if (this.#stamps.size > MOST_STAMPS) this.#stamps.clear();
      stamp = this.#made(size / SIZES, (turn / TURNS) * 2 * Math.PI, shape, (right + 0.5) / PLACES, (under + 0.5) / PLACES);
      this.#stamps.set(key, stamp);
    }
    const pixels = this.#pixels;
    const from = row * this.#width + column;
    const odd = colour & 0xff00ff;
    const even = (colour >>> 8) & 0xff;
    for (let part = 0; part < stamp.length; part += 3) {
      const at = from + stamp[part];
      const own = stamp[part + 1];
      const other = stamp[part + 2];
      const there = pixels[at];
      pixels[at] =
        0xff000000 |
        (((Math.imul(odd, own) + Math.imul(there & 0xff00ff, other)) >>> 8) & 0xff00ff) |
        ((Math.imul(even, own) + Math.imul((there >>> 8) & 0xff, other)) & 0xff00);
    }
  }

  /** The stamp of a sprite whose middle lies `right` and `under` within a pixel. */
  #made(radius: number, angle: number, shape: number, right: number, under: number): Stamp {
    const found: number[] = [];
    this.#each(right, under, radius, angle, shape, (x, y, own, shown) => found.push(y * this.#width + x, own, 256 - shown));
    return Int32Array.from(found);
  }

  #paint(x: number, y: number, radius: number, angle: number, shape: number, colour: Packed): void {
    const alpha = (colour >>> 24) / 255;
    const within: [number, number, number, number] = [0, 0, this.#width, this.#height];
    this.#each(x, y, radius, angle, shape, (column, row, own, shown) => {
      const at = row * this.#width + column;
      this.#pixels[at] = laid(colour, own * alpha, this.#pixels[at], 256 - shown * alpha);
    }, within);
  }

  /** Go through the pixels of a sprite: how much each has of its colour, and how much it covers, in parts of 256. */
  #each(
    x: number, y: number, radius: number, angle: number, shape: number,
    does: (x: number, y: number, own: number, shown: number) => void,
    [left, top, right, bottom] = [-Infinity, -Infinity, Infinity, Infinity],
  ): void {
    const [cos, sin] = [Math.cos(angle) / radius, Math.sin(angle) / radius];
    const reach = REACH * radius * (angle ? 1.42 : 1);
    const edge = SOFT / radius;
    const deep = inside[shape];
    for (let row = Math.max(top, Math.floor(y - reach)); row < Math.min(bottom, y + reach); row += 1) {
      const up = y - row - 0.5;
      for (let column = Math.max(left, Math.floor(x - reach)); column < Math.min(right, x + reach); column += 1) {
        const along = column + 0.5 - x;
        const depth = deep(along * cos + up * sin, up * cos - along * sin);
        if (depth <= 0) continue;
        const shown = 256 * smooth(edge, depth);
        const rim = shape === RING ? 1 : smooth(edge, depth - RIM);
        does(column, row, shown * (0.45 + 0.55 * rim), shown);
      }
    }
  }

  #drawLines({ places, colours }: Segments): void {
    for (let one = 0; one < colours.length; one += 1) {
      const [x, y, to_x, to_y] = places.subarray(4 * one, 4 * one + 4);
      this.#line(
        this.#left + x * this.#unit - 0.5, this.#top - y * this.#unit - 0.5,
        this.#left + to_x * this.#unit - 0.5, this.#top - to_y * this.#unit - 0.5, colours[one],
      );
    }
  }

  /** A line, soft at its sides: of two pixels side by side each has as much as the line is near (Wu 1991). */
  #line(x: number, y: number, to_x: number, to_y: number, colour: Packed): void {
    const steep = Math.abs(to_y - y) > Math.abs(to_x - x);
    if (steep) [x, y, to_x, to_y] = [y, x, to_y, to_x];
    if (x > to_x) [x, y, to_x, to_y] = [to_x, to_y, x, y];
    const [along, aside] = steep ? [this.#width, 1] : [1, this.#width];
    const [length, breadth] = steep ? [this.#height, this.#width] : [this.#width, this.#height];
    const slope = to_x > x ? (to_y - y) / (to_x - x) : 0;
    const alpha = (colour >>> 24) / 255;
    const pixels = this.#pixels;
    for (let step = Math.max(0, Math.round(x)); step <= Math.min(length - 1, Math.round(to_x)); step += 1) {
      const middle = y + slope * (step - x);
      const near = Math.floor(middle);
      const share = alpha * (middle - near) * 256;
      const at = step * along + near * aside;
      if (near >= 0 && near < breadth) pixels[at] = laid(colour, 256 * alpha - share, pixels[at], 256 - 256 * alpha + share);
      if (near >= -1 && near < breadth - 1) pixels[at + aside] = laid(colour, share, pixels[at + aside], 256 - share);
    }
  }
}

const opaque = (colour: Packed): Packed => (colour | 0xff000000) >>> 0;

/** A colour on another, opaque; `alpha` of 255. */
function mixed(colour: Packed, ground: Packed, alpha: number): Packed {
  return laid(colour, (256 * alpha) / 255, ground, 256 - (256 * alpha) / 255);
}

/** So many parts of 256 of a colour, and so many of what was there. */
function laid(colour: Packed, own: number, there: Packed, other: number): Packed {
  const odd = ((Math.imul(colour & 0xff00ff, own) + Math.imul(there & 0xff00ff, other)) >>> 8) & 0xff00ff;
  const even = (Math.imul((colour >>> 8) & 0xff, own) + Math.imul((there >>> 8) & 0xff, other)) & 0xff00;
  return 0xff000000 | odd | even;
}

/** For each pixel of a side, which of `count` patches it shows; -1 for none. */
function places(pixels: number, count: number, place: (pixel: number) => number): Int32Array {
  return Int32Array.from({ length: pixels }, (_, pixel) => {
    const at = Math.floor(place(pixel + 0.5));
    return at < 0 || at >= count ? -1 : at;
  });
}
