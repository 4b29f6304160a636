// ---- WebGL2 ---------------------------------------------------------------------------------------

const byId = (id) => document.getElementById(id);
const textOf = (id) => byId(id).textContent;

// What the kernel is told before its first line: number i of the tables is a texel.
const COLUMNS = 1024;
const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp samplerCube;
uniform sampler2D numbers;
#define VNDF_FETCH(i) texelFetch(numbers, ivec2((i) & ${COLUMNS - 1}, (i) >> 10), 0).r
`;

// One triangle over the whole target.
const SCREEN = `#version 300 es
void main() { gl_Position = vec4(ivec2(gl_VertexID & 1, gl_VertexID >> 1) * 4 - 1, 0.0, 1.0); }`;

class Trouble extends Error {}

let gl; // of a canvas that is never shown: its pictures are copied to those of the page

function openGl() {
  gl = document.createElement("canvas").getContext("webgl2", {antialias: false, alpha: true});
  if (!gl) throw new Trouble("This browser has no WebGL2, which the pictures need.");
  if (!gl.getExtension("EXT_color_buffer_float"))
    throw new Trouble("This browser cannot draw into float textures, which the pictures need.");
}

function makeTexture(format, width, height, values) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
    gl.texParameteri(gl.TEXTURE_2D, name, format === gl.RGBA16F ? gl.LINEAR : gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, format === gl.R32F ? gl.RED : gl.RGBA, gl.FLOAT, values);
  return texture;
}

// Little-endian floats in base64.
function floatsOf(id) {
  const bytes = Uint8Array.from(atob(textOf(id).replace(/\s+/g, "")), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({length: bytes.length / 4}, (_, i) => view.getFloat32(4 * i, true));
}

function tableTexture() {
  const given = floatsOf("numbers"), rows = Math.ceil(given.length / COLUMNS);
  if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE))
    throw new Trouble("These tables are too large for a texture of this browser: make the page with fewer of them.");
  const numbers = new Float32Array(COLUMNS * rows);
  numbers.set(given);
  return makeTexture(gl.R32F, COLUMNS, rows, numbers);
}

// A program of files of the page; those that sample have the kernel before them.
function makeProgram(files) {
  const program = gl.createProgram();
  const complete = (good, log) => {
    if (!good && !gl.isContextLost()) throw new Trouble("This browser refuses a shader of the page: " + log);
  };
  const fragment = HEAD + files.map(textOf).join("\n");
  for (const [kind, text] of [[gl.VERTEX_SHADER, SCREEN], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    complete(gl.getShaderParameter(shader, gl.COMPILE_STATUS), gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  complete(gl.getProgramParameter(program, gl.LINK_STATUS), gl.getProgramInfoLog(program));
  const kinds = new Map();
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const {name, type} = gl.getActiveUniform(program, i);
    kinds.set(name.replace("[0]", ""), [gl.getUniformLocation(program, name), type]);
  }
  return {program, kinds};
}

// Sets the uniforms that the program has; a texture is given as [unit, texture].
function use({program, kinds}, values) {
  gl.useProgram(program);
  for (const [name, value] of Object.entries(values)) {
    if (!kinds.has(name)) continue;
    const [place, kind] = kinds.get(name);
    if (kind === gl.SAMPLER_2D || kind === gl.SAMPLER_CUBE) {
      gl.activeTexture(gl.TEXTURE0 + value[0]);
      gl.bindTexture(kind === gl.SAMPLER_2D ? gl.TEXTURE_2D : gl.TEXTURE_CUBE_MAP, value[1]);
      gl.uniform1i(place, value[0]);
    } else if (kind === gl.INT || kind === gl.BOOL) gl.uniform1i(place, value);
    else if (kind === gl.FLOAT) gl.uniform1f(place, value);
    else if (kind === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
    else gl[`uniform${value.length}f`](place, ...value);
  }
}

// A target of `count` textures of four floats.
function makeTarget(width, height, count) {
  const target = {width, height, textures: [], buffer: gl.createFramebuffer()};
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.buffer);
  for (let i = 0; i < count; i++) {
    target.textures.push(makeTexture(gl.RGBA32F, width, height, null));
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, target.textures[i], 0);
  }
  gl.drawBuffers(target.textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
  return target;
}

// Draws over a whole target; of `size` and without a buffer that is the canvas.
function fill(target) {
  if (!target.buffer && gl.canvas.width !== target.width) gl.canvas.width = gl.canvas.height = target.width;
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.buffer || null);
  gl.viewport(0, 0, target.width, target.height);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

// The four numbers of all pixels: an array of each.
function readTarget(target, which) {
  const count = target.width * target.height, values = new Float32Array(4 * count);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.buffer);
  gl.readBuffer(gl.COLOR_ATTACHMENT0 + which);
  gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, values);
  const planes = [0, 1, 2, 3].map(() => new Float32Array(count));
  for (let i = 0; i < values.length; i++) planes[i & 3][i >> 2] = values[i];
  return planes;
}

const sum = (values) => values.reduce((all, value) => all + value, 0);
const mean = (values) => sum(values) / values.length;

function copyTo(canvas, size) {
  if (canvas.width !== size) canvas.width = canvas.height = size;
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, size, size);
  context.drawImage(gl.canvas, 0, 0);
  return context;
}
