// The world in WebGL2: a texture of patches, sprites for all agents at once, lines.

/** A sprite is a square of four corners; many small ones are points, which cost far less without a graphics card. */
const sprites = (points: boolean) => `#version 300 es
${points ? "" : "in vec2 corner;"} in vec2 place; in float angle; in float size; in vec4 colour; in float shape;
uniform vec2 centre; uniform vec2 scale; uniform float pixel;
flat out vec4 tint; flat out float form; flat out float edge; ${points ? "flat out vec2 turn;" : "out vec2 at;"}
void main() {
  float radius = max(size, 2.5 * pixel);
  vec2 way = vec2(cos(angle), sin(angle));
  tint = colour; form = shape; edge = 1.3 * pixel / radius;
${
  points
    ? `  gl_Position = vec4((place - centre) * scale, 0.0, 1.0);
  gl_PointSize = 2.3 * radius / pixel;
  turn = way;`
    : `  vec2 turned = vec2(corner.x * way.x - corner.y * way.y, corner.x * way.y + corner.y * way.x);
  gl_Position = vec4((place + turned * radius * 1.15 - centre) * scale, 0.0, 1.0);
  at = corner * 1.15;`
}
}`;
const spritePaint = (points: boolean) => `#version 300 es
precision mediump float;
flat in vec4 tint; flat in float form; flat in float edge; ${points ? "flat in vec2 turn;" : "in vec2 at;"} out vec4 paint;
float upright(vec2 at, float half_base, float foot, float top) {  // within a triangle
  return min(at.y - foot, half_base * (top - at.y) / (top - foot) - abs(at.x));
}
void main() {
${
  points
    ? `  vec2 there = vec2(gl_PointCoord.x - 0.5, 0.5 - gl_PointCoord.y) * 2.3;
  vec2 at = vec2(there.x * turn.x + there.y * turn.y, there.y * turn.x - there.x * turn.y);`
    : ""
}
  float inside;
  if (form < 0.5) inside = 1.0 - length(at);                                  // a disc
  else if (form < 1.5) inside = min((0.95 - at.x) * 0.45 - abs(at.y) * 0.85 + 0.05, at.x + 0.75 - 0.5 * (0.5 - abs(at.y)));  // an arrow
  else if (form < 2.5) inside = 1.0 - max(abs(at.x), abs(at.y));              // a square
  else if (form < 3.5) inside = min(1.0 - length(at), length(at) - 0.8);      // a ring
  else if (form < 4.5) inside = upright(at, 0.85, -0.75, 0.95);               // a triangle
  else if (form < 5.5) inside = 0.95 - abs(at.x) - abs(at.y);                 // a diamond
  else if (form < 6.5) inside = max(0.4 - length(at - vec2(0.0, 0.56)), upright(at, 0.78, -0.95, 0.8));  // a person
  else if (form < 7.5) inside = max(max(0.55 - length(at * vec2(0.72, 1.15) + vec2(0.2, 0.0)), 0.3 - length(at - vec2(0.68, 0.0))),
    0.11 - length(vec2(abs(at.x + 0.25) - 0.35, abs(at.y) - 0.55)));          // an animal, from above
  else if (form < 8.5) inside = max(min(0.62 - abs(at.x), min(0.2 - at.y, at.y + 0.85)), upright(at, 0.95, 0.05, 0.95));  // a house
  else inside = max(min(0.14 - abs(at.x), min(at.y + 0.98, -at.y)), upright(at, 0.75, -0.5, 0.98));  // a tree
  float shown = smoothstep(0.0, edge, inside);
  if (shown <= 0.0) discard;
  float rim = form > 2.5 && form < 3.5 ? 1.0 : smoothstep(0.0, edge, inside - 0.12);
  paint = vec4(mix(tint.rgb * 0.45, tint.rgb, rim), tint.a * shown);
}`;
const PATCHES = `#version 300 es
in vec2 corner; uniform vec4 extent; uniform vec2 centre; uniform vec2 scale; out vec2 at;
void main() {
  at = corner * 0.5 + 0.5;
  gl_Position = vec4((extent.xy + at * extent.zw - centre) * scale, 0.0, 1.0);
}`;
const PATCH_PAINT = `#version 300 es
precision mediump float;
in vec2 at; uniform sampler2D patches; out vec4 paint;
void main() { paint = texture(patches, at.yx); }`;
const LINES = `#version 300 es
in vec2 place; in vec4 colour; uniform vec2 centre; uniform vec2 scale; out vec4 tint;
void main() { gl_Position = vec4((place - centre) * scale, 0.0, 1.0); tint = colour; }`;
const LINE_PAINT = `#version 300 es
precision mediump float; in vec4 tint; out vec4 paint; void main() { paint = tint; }`;

const CORNERS = new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]);

export interface View {
  x: number;
  y: number;
  /** Units of the world that half of the canvas's height shows. */
  half: number;
}

/** Sprites: x, y, angle (radians, 0 to the right), radius, shape; and RGBA. */
export interface Sprites {
  count: number;
  numbers: Float32Array;
  colours: Uint8Array;
}

export interface Segments {
  /** x, y of both ends, one after another. */
  places: Float32Array;
  colours: Uint8Array;
}

export interface Picture {
  patches?: { width: number; height: number; pixels: Uint8Array; extent: [number, number, number, number] };
  below: Segments;
  sprites: Sprites;
  above: Segments;
}

/** Up to so many sprites are squares. */
const FEW = 500;
/** Up to so many pixels from its middle to its edge a sprite can be a point, which is cut where its middle is out of sight. */
const POINT = 12;

/** The sprites that are in sight, and how far the largest of them reaches. */
function within(sprites: Sprites, view: View, width: number, height: number): Sprites & { largest: number } {
  const { count, numbers, colours } = sprites;
  const seen = { count: 0, numbers: new Float32Array(5 * count), colours: new Uint8Array(4 * count), largest: 0 };
  const [into, from] = [new Uint32Array(seen.colours.buffer), new Uint32Array(colours.buffer, colours.byteOffset, count)];
  for (let one = 0; one < count; one += 1) {
    const at = 5 * one;
    const reach = 1.63 * numbers[at + 3]; // to the corners
    if (Math.abs(numbers[at] - view.x) > width / 2 + reach || Math.abs(numbers[at + 1] - view.y) > height / 2 + reach) continue;
    for (let part = 0; part < 5; part += 1) seen.numbers[5 * seen.count + part] = numbers[at + part];
    into[seen.count] = from[one];
    seen.largest = Math.max(seen.largest, numbers[at + 3]);
    seen.count += 1;
  }
  return { ...seen, numbers: seen.numbers.subarray(0, 5 * seen.count), colours: seen.colours.subarray(0, 4 * seen.count) };
}

export class Renderer {
  #gl: WebGL2RenderingContext;
  #sprites: WebGLProgram;
  #points: WebGLProgram;
  #patches: WebGLProgram;
  #lines: WebGLProgram;
  #texture: WebGLTexture;
  #corners: WebGLBuffer;
  #numbers: WebGLBuffer;
  #colours: WebGLBuffer;

  constructor(canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("This browser has no WebGL2, which draws the world.");
    this.#gl = gl;
    this.#sprites = this.#program(sprites(false), spritePaint(false));
    this.#points = this.#program(sprites(true), spritePaint(true));
    this.#patches = this.#program(PATCHES, PATCH_PAINT);
    this.#lines = this.#program(LINES, LINE_PAINT);
    this.#texture = gl.createTexture()!;
    this.#corners = gl.createBuffer()!;
    this.#numbers = gl.createBuffer()!;
    this.#colours = gl.createBuffer()!;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#corners);
    gl.bufferData(gl.ARRAY_BUFFER, CORNERS, gl.STATIC_DRAW);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  }

  draw(picture: Picture, view: View, ground: [number, number, number]): void {
    const gl = this.#gl;
    const canvas = gl.canvas as HTMLCanvasElement;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(ground[0] / 255, ground[1] / 255, ground[2] / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const scale: [number, number] = [canvas.height / canvas.width / view.half, 1 / view.half];
    const look = (program: WebGLProgram) => {
      gl.useProgram(program);
      gl.uniform2f(gl.getUniformLocation(program, "centre"), view.x, view.y);
      gl.uniform2f(gl.getUniformLocation(program, "scale"), ...scale);
    };
    if (picture.patches) {
      look(this.#patches);
      this.#drawPatches(picture.patches);
    }
    look(this.#lines);
    this.#drawLines(picture.below);
    const pixel = (2 * view.half) / canvas.height;
    const seen = within(picture.sprites, view, canvas.width * pixel, canvas.height * pixel);
    const points = seen.count > FEW && seen.largest < POINT * pixel;
    const program = points ? this.#points : this.#sprites;
    look(program);
    gl.uniform1f(gl.getUniformLocation(program, "pixel"), pixel);
    this.#drawSprites(seen, program, points);
    look(this.#lines);
    this.#drawLines(picture.above);
  }

  #drawPatches(patches: NonNullable<Picture["patches"]>): void {
    const gl = this.#gl;
    gl.bindTexture(gl.TEXTURE_2D, this.#texture);
    // Patches come column by column: a column of the world is a row of the texture.
    const { width, height, pixels } = patches;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, height, width, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.uniform4f(gl.getUniformLocation(this.#patches, "extent"), ...patches.extent);
    this.#attribute(this.#patches, "corner", this.#corners, 2, 0, 0, 0);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  #drawSprites(sprites: Sprites, program: WebGLProgram, points: boolean): void {
    const gl = this.#gl;
    if (!sprites.count) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#numbers);
    gl.bufferData(gl.ARRAY_BUFFER, sprites.numbers, gl.STREAM_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#colours);
    gl.bufferData(gl.ARRAY_BUFFER, sprites.colours, gl.STREAM_DRAW);
    const each = points ? 0 : 1;
    this.#attribute(program, "place", this.#numbers, 2, 20, 0, each);
    this.#attribute(program, "angle", this.#numbers, 1, 20, 8, each);
    this.#attribute(program, "size", this.#numbers, 1, 20, 12, each);
    this.#attribute(program, "shape", this.#numbers, 1, 20, 16, each);
    this.#attribute(program, "colour", this.#colours, 4, 4, 0, each, true);
    if (points) {
      gl.drawArrays(gl.POINTS, 0, sprites.count);
    } else {
      this.#attribute(program, "corner", this.#corners, 2, 0, 0, 0);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, sprites.count);
    }
  }

  #drawLines(lines: Segments): void {
    const gl = this.#gl;
    if (!lines.places.length) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#numbers);
    gl.bufferData(gl.ARRAY_BUFFER, lines.places, gl.STREAM_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#colours);
    gl.bufferData(gl.ARRAY_BUFFER, lines.colours, gl.STREAM_DRAW);
    this.#attribute(this.#lines, "place", this.#numbers, 2, 8, 0, 0);
    this.#attribute(this.#lines, "colour", this.#colours, 4, 4, 0, 0, true);
    gl.drawArrays(gl.LINES, 0, lines.places.length / 2);
  }

  #attribute(
    program: WebGLProgram, name: string, buffer: WebGLBuffer,
    parts: number, stride: number, offset: number, divisor: number, bytes = false,
  ): void {
    const gl = this.#gl;
    const place = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, parts, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, bytes, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  #program(vertex: string, fragment: string): WebGLProgram {
    const gl = this.#gl;
    const program = gl.createProgram()!;
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) ?? "shader");
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
  }
}
