// What the canvas shows: boxes and links as data. An editor makes them of its document, whenever that is another one.

import type { Edge, Node } from "@xyflow/svelte";

export type BoxData = {
  title: string;
  /** A second line, smaller. */
  line?: string;
  /** What it is, for its shape: the class of the box. */
  kind: string;
  /** Of the stripe at its side: CSS. */
  colour?: string;
  /** Drawn pale: there, and yet without effect at first. */
  pale?: boolean;
  /** What is odd or wrong about it, in sentences. */
  odd?: string[];
  wrong?: string[];
};

export type LinkData = {
  /** Which of several links between the same two boxes it is, and how many there are. */
  lane: [number, number];
  colour: string;
  /** Pixels. */
  width: number;
  dash?: string;
  /** Ends in an arrow, in a ring, or plainly. */
  end?: "arrow" | "ring" | "none";
  /** How far along it that is said, 0 … 1; the middle unless it says so. */
  at?: number;
  /** Said beside it; a number there can be typed if `type` takes what was typed. */
  text?: string;
  label: string;
  type?: (text: string) => void;
  odd?: string[];
};

export type Box = Node<BoxData>;
export type Link = Edge<LinkData>;
