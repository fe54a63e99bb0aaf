// From keys to commands: what actuators are told while keys are held.

export interface Actuator {
  name: string;
  /** Of the body, for a wheel. */
  side: "left" | "right" | "middle" | "";
}
export type Way = "ahead" | "back" | "left" | "right";

export const KEYS: Record<string, Way> = {
  ArrowUp: "ahead", ArrowDown: "back", ArrowLeft: "left", ArrowRight: "right", w: "ahead", s: "back", a: "left", d: "right",
};
const STANDS = 0.5;

/** The command of each actuator, 0 … 1: wheels by what is held, others as they are set. */
export function commandsOf(actuators: Actuator[], held: Set<Way>, levels: Record<string, number>): number[] {
  const ahead = Number(held.has("ahead")) - Number(held.has("back"));
  const right = Number(held.has("right")) - Number(held.has("left"));
  return actuators.map(({ name, side }) => {
    if (!side) return levels[name] ?? STANDS;
    const turn = side === "left" ? right : side === "right" ? -right : 0;
    // On the spot half as fast as ahead; in a curve the inner wheel is slower, the outer as fast as it can.
    return Math.max(0, Math.min(1, STANDS + 0.5 * ahead + 0.25 * turn * (ahead < 0 ? -1 : 1)));
  });
}
