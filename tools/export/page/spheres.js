// ---- spheres --------------------------------------------------------------------------------------

const ENOUGH = 1024; // samples of a pixel

// Lamps: direction, angle of their edge, radiance; and how bright the picture is.
const LAMPS = [
  {to: [-0.52, 0.62, 0.58], edge: 2.5, shine: [330, 300, 255], exposure: 0.72},
  {to: [0.35, 0.75, 0.55], edge: 9, shine: [18, 17, 16], exposure: 1.05},
  {to: [-0.5, 0.55, 0.65], edge: 1.5, shine: [1900, 1800, 1650], exposure: 0.8},
  {to: [0, 1, 0], edge: 10, shine: [0, 0, 0], exposure: 0.8},
];

// Steps from one sample of a pixel to the next. Those of the normals fill their square most evenly (Roberts 2018).
const STEPS = {
  normal_step: [0.7548776662466927, 0.5698402909980532],
  lamp_step: [Math.SQRT2 % 1, Math.sqrt(3) % 1],
  pixel_step: [Math.sqrt(5) % 1, Math.sqrt(7) % 1],
  base_step: [Math.sqrt(11) % 1, Math.sqrt(13) % 1],
};

function lampNow(light) {
  const {to, edge, shine} = LAMPS[light], length = Math.hypot(...to), angle = settings.around * Math.PI / 180;
  const [x, y, z] = to.map((v) => v / length), c = Math.cos(angle), s = Math.sin(angle);
  return {lamp: [c * x + s * z, y, c * z - s * x, Math.cos(edge * Math.PI / 180)], shine};
}

function fitSphere(sphere, size) {
  if (size === sphere.size) return;
  sphere.targets.forEach(freeTarget);
  sphere.targets = [0, 1].map(() => makeTarget(size, size, 1));
  sphere.size = size;
  sphere.drawn = 0;
}

// One more sample of each pixel of a sphere, or of what an engine makes of one.
function refineSphere(sphere, surface) {
  const {size} = sphere, light = LIGHTS.indexOf(settings.light), n = sphere.drawn;
  const steps = Object.fromEntries(Object.entries(STEPS).map(([name, step]) => [name, step.map((x) => (n * x) % 1)]));
  const from = sphere.targets[n % 2], to = sphere.targets[1 - n % 2];
  use(programs[sphere.program], {...surface, ...sphere.tells, ...lampNow(light), light, material: MATERIALS.indexOf(settings.material),
    around: settings.around * Math.PI / 180, before: [1, from.textures[0]], first: n === 0, size: [size, size],
    ...steps});
  fill(to);
  sphere.drawn = n + 1;
}

function showSphere({canvas, size, targets, drawn}) {
  const exposure = LAMPS[LIGHTS.indexOf(settings.light)].exposure;
  use(programs.show, {sums: [1, targets[drawn % 2].textures[0]], exposure});
  fill({width: size, height: size});
  copyTo(canvas, size);
}

// Mean and spread of the picture's light, and how many of its pixels are no light.
function lightOf(sphere) {
  const sums = readTarget(sphere.targets[sphere.drawn % 2], 0);
  let count = 0, sum = 0, squares = 0, faults = 0;
  for (let i = 0; i < sums.length; i += 4, count++) {
    const y = Math.min((0.2126 * sums[i] + 0.7152 * sums[i + 1] + 0.0722 * sums[i + 2]) / sphere.drawn, 4);
    faults += !(y >= 0);
    sum += y;
    squares += y * y;
  }
  const mean = sum / count;
  return {mean, spread: Math.sqrt(Math.max(squares / count - mean * mean, 0)), faults};
}
