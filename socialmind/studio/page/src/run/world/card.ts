// What draws a world: a graphics card, or the processor where there is none.

import type { Drawing } from "./drawing";
import { Raster } from "./raster";
import { WebGL } from "./webgl";

let card: boolean | undefined;

/** Whether a graphics card draws WebGL; browsers without one have none, or one that is slower than `Raster`. */
function hasCard(): boolean {
  if (card !== undefined) return card;
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  const said = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl ? String(gl.getParameter(said ? said.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  card = gl !== null && !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  return card;
}

/** Return what draws on a canvas. */
export function drawing(canvas: HTMLCanvasElement): Drawing {
  return hasCard() ? new WebGL(canvas) : new Raster(canvas);
}
