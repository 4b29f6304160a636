// ---- engines: one pass by tables beside samples ---------------------------------------------------

const CUBE = 128; // texels along a side of the environment
const TAPS = {levels: 8, count: 32};

// Two pictures each of a scene, which are drawn and shown as spheres are.
const scenes = byId("engines") ? ["area", "sky"].map((name) => ({
  name,
  pictures: ["pass", "samples"].map((way) => ({canvas: byId(`${name}-${way}`), targets: [], drawn: 0, size: 0,
    program: "engines", tells: {is_floor: name === "area", in_one_pass: way === "pass"}})),
})) : [];

let bakedTables; // by distribution: textures, made when they are first needed
let cube;

// The numbers of the tables, for each distribution of the menus: inverse matrices, norms, DFG, taps.
function unpackTables() {
  const numbers = floatsOf("baked"), each = numbers.length / byId("choice-a").options.length;
  const taps = 4 * TAPS.levels * TAPS.count, size = Math.round(Math.sqrt((each - taps) / 10)), n = size * size;
  return new Map([...byId("choice-a").options].map((option, k) => {
    const at = k * each, splits = new Float32Array(4 * n);
    for (let i = 0; i < n; i++) {
      splits.set(numbers.subarray(at + 4 * n + 3 * i, at + 4 * n + 3 * i + 2), 4 * i);
      splits.set(numbers.subarray(at + 7 * n + 3 * i, at + 7 * n + 3 * i + 2), 4 * i + 2);
    }
    return [Number(option.value), {
      table_size: size,
      ltc: [2, makeTexture(gl.RGBA16F, size, size, numbers.subarray(at, at + 4 * n))],
      splits: [3, makeTexture(gl.RGBA16F, size, size, splits)],
      taps: [4, makeTexture(gl.RGBA32F, TAPS.count, TAPS.levels, numbers.subarray(at + 10 * n, at + each))],
    }];
  }));
}

// The light around the sphere, as engines keep it: a cube with mip levels.
function drawCube(light) {
  cube = cube || {texture: gl.createTexture(), buffer: gl.createFramebuffer(), width: CUBE, height: CUBE};
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube.texture);
  for (let face = 0; face < 6; face++)
    gl.texImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, gl.RGBA16F, CUBE, CUBE, 0, gl.RGBA, gl.HALF_FLOAT, null);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  for (let face = 0; face < 6; face++) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, cube.buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, cube.texture, 0);
    use(programs.cube, {face, light, around: settings.around * Math.PI / 180, size: [CUBE, CUBE]});
    fill(cube);
  }
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube.texture);
  gl.generateMipmap(gl.TEXTURE_CUBE_MAP);
}

// Adds so many samples to each pixel, and shows what they say.
function drawEngines(frames) {
  const light = LIGHTS.indexOf(settings.light), alpha = surfaceOf(settings.a).alpha[0];
  const surface = {...surfaceOf(settings.a), alpha: [alpha, alpha], turn: 0, roughness: Math.min(Math.sqrt(alpha), 1)};
  for (const {name, pictures} of scenes) {
    for (const picture of pictures) fitSphere(picture, pixelsOf(picture.canvas));
    if (pictures[0].drawn >= ENOUGH) continue;
    bakedTables = bakedTables || unpackTables();
    if (pictures[0].drawn === 0 && name === "sky") drawCube(light);
    const from = bakedTables.get(settings.engine === "own" ? settings.a : -1);
    for (const picture of pictures) {
      for (let i = 0; i < frames; i++) refineSphere(picture, {...surface, ...from, wide: [5, cube && cube.texture]});
      showSphere(picture);
    }
    showDifference(name, pictures);
  }
}

function differenceOf([pass, samples]) {
  const [a, b] = [pass, samples].map((picture) => readTarget(picture.targets[picture.drawn % 2], 0));
  let off = 0, squares = 0, sum = 0, count = 0;
  for (let i = 0; i < a.length; i += 4) {
    const [x, y] = [a, b].map((v) => (0.2126 * v[i] + 0.7152 * v[i + 1] + 0.0722 * v[i + 2]) / v[i + 3]);
    if (y === 0 && x === 0) continue;
    off += (x - y) * (x - y);
    squares += y * y;
    sum += y;
    count++;
  }
  return {mean: sum / count, error: Math.sqrt(off / squares)};
}

function showDifference(name, pictures) {
  const {mean, error} = differenceOf(pictures), [passes, samples] = pictures.map((p) => [1, p.targets[p.drawn % 2].textures[0]]);
  const canvas = byId(`${name}-difference`), size = pictures[0].size;
  use(programs.difference, {passes, samples: [2, samples[1]], mean, back: Array(3).fill(theme() === "dark" ? 0.1 : 1)});
  fill({width: size, height: size});
  copyTo(canvas, size);
  byId(`${name}-says`).textContent = `One pass is off by ${(100 * error).toFixed(1)} %`;
  byId(`${name}-says`).title = "the root of the mean square of the difference, over that of the light";
  pictures.error = error;
}
