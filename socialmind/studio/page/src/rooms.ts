// The rooms of the studio, in the order of their tabs; each is a component and a word in the address.

import type { Component } from "svelte";
import Experiments from "./experiments/Experiments.svelte";
import Learning from "./learning/Learning.svelte";
import Run from "./run/Run.svelte";
import Mind from "./scheme/Mind.svelte";
import FirstHour from "./tutorials/FirstHour.svelte";
import Skills from "./skills/Skills.svelte";

export interface Room {
  /** In the address, after #/. */
  word: string;
  title: string;
  component: Component;
}

export const ROOMS: Room[] = [
  { word: "run", title: "Run", component: Run },
  { word: "mind", title: "Mind", component: Mind },
  { word: "skills", title: "Skills", component: Skills },
  { word: "learning", title: "Learning", component: Learning },
  { word: "experiments", title: "Experiments", component: Experiments },
  { word: "first-hour", title: "First hour", component: FirstHour },
];
