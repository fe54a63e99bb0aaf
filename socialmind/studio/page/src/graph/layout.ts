// Places for boxes that have none: in layers along their links (dagre).

import dagre from "@dagrejs/dagre";

export interface Sized {
  id: string;
  width: number;
  height: number;
}
export interface Place {
  x: number;
  y: number;
}
/** Where a document says that a box was put; null for one that is laid out. */
export type Position = [number, number] | null;
/** Of boxes, by their ids. */
export type Places = Map<string, Place>;

export function positionOf({ x, y }: Place): Position {
  return [Math.round(x), Math.round(y)];
}

/** Where boxes stand that have a place: the one that their document says, else the one beside it. */
export function known(boxes: { id: string; position: Position }[], put: Places): Places {
  const found: Places = new Map();
  for (const { id, position } of boxes) {
    const place = position ? { x: position[0], y: position[1] } : put.get(id);
    if (place) found.set(id, place);
  }
  return found;
}

const STEP = 92;

/** The next place, from one downwards, that no other box is nearer to than this wide and this high. */
export function clear(at: Place, taken: Place[], { width, height }: { width: number; height: number }): Place {
  const free = { ...at };
  while (taken.some((one) => Math.abs(one.x - free.x) < width && Math.abs(one.y - free.y) < height)) free.y += STEP;
  return free;
}

/** The upper left corners of boxes, by id, so that links lead from left to right (or down). */
export function laidOut(boxes: Sized[], links: [string, string][], direction: "LR" | "TB" = "LR"): Map<string, Place> {
  const graph = new dagre.graphlib.Graph();
  graph.setGraph({ rankdir: direction, nodesep: 28, ranksep: 150, marginx: 20, marginy: 20 });
  graph.setDefaultEdgeLabel(() => ({}));
  for (const { id, width, height } of boxes) graph.setNode(id, { width, height });
  for (const [from, to] of links) if (from !== to) graph.setEdge(from, to);
  dagre.layout(graph);
  return new Map(
    boxes.map(({ id, width, height }) => {
      const { x, y } = graph.node(id);
      return [id, { x: Math.round(x - width / 2), y: Math.round(y - height / 2) }];
    }),
  );
}
