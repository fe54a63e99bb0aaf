// The world drawn by a graphics card: a texture of patches, all sprites at once, lines.

import { LEAST, RIM, SOFT, type Drawing, type Packed, type Patches, type Picture, type Segments, type Sprites, type View } from "./drawing";
import { inside, REACH, RING } from "./shapes";

/** Points across the texture of a shape. */
const FINE = 128;

const SPRITES = `#version 300 es
in vec2 place; in float angle; in float size; in vec4 colour; in float shape;
uniform vec2 centre; uniform vec2 scale; uniform float pixel;
flat out vec4 tint; flat out float form; flat out float edge; out vec2 at;
void main() {
  float radius = max(size, ${LEAST} * pixel);
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 corner = vec2(at.x * cos(angle) - at.y * sin(angle), at.x * sin(angle) + at.y * cos(angle));
  gl_Position = vec4((place + corner * radius * ${REACH} - centre) * scale, 0.0, 1.0);
  tint = colour; form = shape; edge = ${SOFT} * pixel / radius;
}`;
const SPRITE_PAINT = `#version 300 es
precision mediump float; precision mediump sampler2DArray;
flat in vec4 tint; flat in float form; flat in float edge; in vec2 at;
uniform sampler2DArray shapes; out vec4 paint;
void main() {
  float inside = texture(shapes, vec3(at * 0.5 + 0.5, form)).r;
  float shown = smoothstep(0.0, edge, inside);
  if (shown <= 0.0) discard;
  float rim = form == ${RING}.0 ? 1.0 : smoothstep(0.0, edge, inside - ${RIM});
  paint = vec4(mix(tint.rgb * 0.45, tint.rgb, rim), tint.a * shown);
}`;
const PATCHES = `#version 300 es
uniform vec4 extent; uniform vec2 centre; uniform vec2 scale; out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4((extent.xy + at * extent.zw - centre) * scale, 0.0, 1.0);
}`;
const PATCH_PAINT = `#version 300 es
precision mediump float;
in vec2 at; uniform sampler2D patches; out vec4 paint;
void main() { paint = texture(patches, at.yx); }`;
const LINES = `#version 300 es
in vec4 ends; in vec4 colour; uniform vec2 centre; uniform vec2 scale; out vec4 tint;
void main() { gl_Position = vec4(((gl_VertexID == 0 ? ends.xy : ends.zw) - centre) * scale, 0.0, 1.0); tint = colour; }`;
const LINE_PAINT = `#version 300 es
precision mediump float; in vec4 tint; out vec4 paint; void main() { paint = tint; }`;

export class WebGL implements Drawing {
  #gl: WebGL2RenderingContext;
  #sprites: WebGLProgram;
  #patches: WebGLProgram;
  #lines: WebGLProgram;
  #texture: WebGLTexture;
  #numbers: WebGLBuffer;
  #colours: WebGLBuffer;

  constructor(canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true })!;
    this.#gl = gl;
    this.#sprites = this.#program(SPRITES, SPRITE_PAINT);
    this.#patches = this.#program(PATCHES, PATCH_PAINT);
    this.#lines = this.#program(LINES, LINE_PAINT);
    this.#numbers = gl.createBuffer()!;
    this.#colours = gl.createBuffer()!;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.activeTexture(gl.TEXTURE1);
    this.#drawn(gl.TEXTURE_2D_ARRAY, gl.LINEAR);
    gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.R16F, FINE, FINE, inside.length, 0, gl.RED, gl.FLOAT, shapes());
    gl.activeTexture(gl.TEXTURE0);
    this.#texture = this.#drawn(gl.TEXTURE_2D, gl.NEAREST);
  }

  draw(picture: Picture, view: View, ground: Packed): void {
    const gl = this.#gl;
    const { width, height } = gl.canvas;
    gl.viewport(0, 0, width, height);
    gl.clearColor((ground & 255) / 255, ((ground >> 8) & 255) / 255, ((ground >> 16) & 255) / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const look = (program: WebGLProgram) => {
      gl.useProgram(program);
      gl.uniform2f(gl.getUniformLocation(program, "centre"), view.x, view.y);
      gl.uniform2f(gl.getUniformLocation(program, "scale"), height / width / view.half, 1 / view.half);
    };
    if (picture.patches) {
      look(this.#patches);
      this.#drawPatches(picture.patches);
    }
    look(this.#lines);
    this.#drawLines(picture.below);
    look(this.#sprites);
    gl.uniform1f(gl.getUniformLocation(this.#sprites, "pixel"), (2 * view.half) / height);
    gl.uniform1i(gl.getUniformLocation(this.#sprites, "shapes"), 1);
    this.#drawSprites(picture.sprites);
    look(this.#lines);
    this.#drawLines(picture.above);
  }

  #drawPatches({ values, palette, width, height, low_x, low_y }: Patches): void {
    const gl = this.#gl;
    const pixels = Uint32Array.from(values, (value) => palette[value]);
    gl.bindTexture(gl.TEXTURE_2D, this.#texture);
    // Patches come column by column: a column of the world is a row of the texture.
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, height, width, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(pixels.buffer));
    gl.uniform4f(gl.getUniformLocation(this.#patches, "extent"), low_x, low_y, width, height);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  #drawSprites({ count, numbers, colours }: Sprites): void {
    const gl = this.#gl;
    this.#fill(numbers.subarray(0, 5 * count), colours.subarray(0, count));
    this.#attribute(this.#sprites, "place", 2, 20, 0);
    this.#attribute(this.#sprites, "angle", 1, 20, 8);
    this.#attribute(this.#sprites, "size", 1, 20, 12);
    this.#attribute(this.#sprites, "shape", 1, 20, 16);
    this.#colour(this.#sprites);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
  }

  #drawLines({ places, colours }: Segments): void {
    this.#fill(places, colours);
    this.#attribute(this.#lines, "ends", 4, 16, 0);
    this.#colour(this.#lines);
    this.#gl.drawArraysInstanced(this.#gl.LINES, 0, 2, colours.length);
  }

  #fill(numbers: Float32Array, colours: Uint32Array): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#numbers);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STREAM_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#colours);
    gl.bufferData(gl.ARRAY_BUFFER, colours, gl.STREAM_DRAW);
  }

  #attribute(program: WebGLProgram, name: string, parts: number, stride: number, offset: number): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#numbers);
    this.#each(gl.getAttribLocation(program, name), parts, gl.FLOAT, stride, offset);
  }
  #colour(program: WebGLProgram): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#colours);
    this.#each(gl.getAttribLocation(program, "colour"), 4, gl.UNSIGNED_BYTE, 4, 0);
  }
  /** What was bound holds one of these for each that is drawn; bytes are shares of 255. */
  #each(place: number, parts: number, type: number, stride: number, offset: number): void {
    this.#gl.enableVertexAttribArray(place);
    this.#gl.vertexAttribPointer(place, parts, type, type === this.#gl.UNSIGNED_BYTE, stride, offset);
    this.#gl.vertexAttribDivisor(place, 1);
  }

  /** Make a texture that is drawn with this filter, and bind it. */
  #drawn(kind: number, filter: number): WebGLTexture {
    const gl = this.#gl;
    const texture = gl.createTexture()!;
    gl.bindTexture(kind, texture);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(kind, side, filter);
    for (const way of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(kind, way, gl.CLAMP_TO_EDGE);
    return texture;
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

/** How far inside each shape the points of a square lie. */
function shapes(): Float32Array {
  const found = new Float32Array(inside.length * FINE * FINE);
  const side = (place: number) => (2 * (place + 0.5) / FINE - 1) * REACH;
  let at = 0;
  for (const one of inside) {
    for (let row = 0; row < FINE; row += 1) {
      for (let column = 0; column < FINE; column += 1) found[at++] = one(side(column), side(row));
    }
  }
  return found;
}
