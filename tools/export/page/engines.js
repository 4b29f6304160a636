// ---- engines: one pass by tables beside samples ---------------------------------------------------

const CUBE = 128; // texels along a side of the environment
const TAPS = {levels: 8, count: 32};

// Two pictures of a floor under a rectangle of light, and of a sphere in the light around it without its lamp.
const ON_FLOOR = {is_floor: true, light: 4, shine: [4, 3.8, 3.4],
                  eye: [0, -2.6, 1.3], target: [0, 0.7, 0.3], up: [0, 0, 1], wide_angle: 0.5};
const scenes = byId("engines") ? ["area", "sky"].map((name) => ({name, pictures: ["pass", "samples"].map((way) =>
  makePicture(`${name}-${way}`, way === "pass" ? "engines" : "sphere", {is_engine: true,
    ...name === "area" ? ON_FLOOR : {shine: [0, 0, 0], wide_angle: 0.215}}))})) : [];

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
  if (!cube) {
    cube = {texture: gl.createTexture(), buffer: gl.createFramebuffer(), width: CUBE, height: CUBE};
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube.texture);
    gl.texStorage2D(gl.TEXTURE_CUBE_MAP, 1 + Math.log2(CUBE), gl.RGBA16F, CUBE, CUBE);
    gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  }
  for (let face = 0; face < 6; face++) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, cube.buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, cube.texture,
                            0);
    use(programs.cube, {face, light, around: radians(settings.around), size: [CUBE, CUBE]});
    fill(cube);
  }
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube.texture);
  gl.generateMipmap(gl.TEXTURE_CUBE_MAP);
}

function drawEngines() {
  const light = LIGHTS.indexOf(settings.light), alpha = surfaceOf(settings.a).alpha[0];
  const surface = {...surfaceOf(settings.a), alpha: [alpha, alpha], turn: 0, roughness: Math.min(Math.sqrt(alpha), 1)};
  for (const {name, pictures} of scenes) {
    pictures.forEach(fitPicture);
    if (isDone(pictures[0])) continue;
    bakedTables = bakedTables || unpackTables();
    if (pictures[0].drawn === 0 && name === "sky") drawCube(light);
    const from = bakedTables.get(settings.engine === "own" ? settings.a : -1);
    for (const picture of pictures) refinePicture(picture, {...surface, ...from, wide: [5, cube && cube.texture]});
    showDifference(name, pictures);
  }
}

function showDifference(name, pictures) {
  const [pass, light] = pictures.map(lightsOf), lit = light.filter((y, i) => y !== 0 || pass[i] !== 0);
  const error = Math.sqrt(sum(light.map((y, i) => (pass[i] - y) ** 2)) / sum(light.map((y) => y * y)));
  const [passes, samples] = pictures.map((picture, i) => [1 + i, sumsOf(picture).textures[0]]);
  use(programs.difference, {passes, samples, mean: mean(lit), back: Array(3).fill(theme() === "dark" ? 0.1 : 1)});
  fill({width: pictures[0].size, height: pictures[0].size});
  copyTo(byId(`${name}-difference`), pictures[0].size);
  byId(`${name}-says`).textContent = `One pass is off by ${(100 * error).toFixed(1)} %`;
  byId(`${name}-says`).title = "the root of the mean square of the difference, over that of the light";
  pictures.error = error;
}
