// The shapes of agents: how far inside a shape a point lies, from its middle (0, 0) to its edge at 1.

type Shape = (x: number, y: number) => number;

const { abs, hypot, max, min } = Math;

/** Within a triangle that stands upright. */
const upright = (x: number, y: number, half: number, foot: number, top: number) =>
  min(y - foot, (half * (top - y)) / (top - foot) - abs(x));

/** By their names in models (looks.py); those that point go to the right. More than 0 is inside. */
const INSIDE: Record<string, Shape> = {
  disc: (x, y) => 1 - hypot(x, y),
  arrow: (x, y) => min((0.95 - x) * 0.45 - abs(y) * 0.85 + 0.05, x + 0.75 - 0.5 * (0.5 - abs(y))),
  square: (x, y) => 1 - max(abs(x), abs(y)),
  ring: (x, y) => min(1 - hypot(x, y), hypot(x, y) - 0.8),
  triangle: (x, y) => upright(x, y, 0.85, -0.75, 0.95),
  diamond: (x, y) => 0.95 - abs(x) - abs(y),
  person: (x, y) => max(0.4 - hypot(x, y - 0.56), upright(x, y, 0.78, -0.95, 0.8)),
  animal: (x, y) =>
    // From above.
    max(0.55 - hypot(0.72 * x + 0.2, 1.15 * y), 0.3 - hypot(x - 0.68, y), 0.11 - hypot(abs(x + 0.25) - 0.35, abs(y) - 0.55)),
  house: (x, y) => max(min(0.62 - abs(x), min(0.2 - y, y + 0.85)), upright(x, y, 0.95, 0.05, 0.95)),
  tree: (x, y) => max(min(0.14 - abs(x), min(y + 0.98, -y)), upright(x, y, 0.75, -0.5, 0.98)),
};

export const SHAPES = Object.keys(INSIDE);
export const inside: Shape[] = Object.values(INSIDE);
/** How far from its middle anything of a shape is drawn. */
export const REACH = 1.15;

export const shapeOf = (name: string) => SHAPES.indexOf(name);
/** The shape that has no rim, as it is one. */
export const RING = shapeOf("ring");
/** Shapes that turn with who has them; the others stand upright. */
export const TURNED = [shapeOf("arrow"), shapeOf("animal")];
