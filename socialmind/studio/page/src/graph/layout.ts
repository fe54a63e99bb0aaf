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
/** Of boxes, by their ids. */
export type Places = Map<string, Place>;

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
