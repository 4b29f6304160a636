// ---- spheres --------------------------------------------------------------------------------------

const ENOUGH = 1024; // samples of a pixel, where the address asks for no other number

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

function lampNow() {
  const {to, edge, shine} = LAMPS[LIGHTS.indexOf(settings.light)], length = Math.hypot(...to);
  const [x, y, z] = to.map((v) => v / length), angle = radians(settings.around);
  const c = Math.cos(angle), s = Math.sin(angle);
  return {lamp: [c * x + s * z, y, c * z - s * x, Math.cos(radians(edge))], shine};
}

// A picture that is refined: `tells` goes to its program beside what all of them are told.
const makePicture = (id, program, tells) =>
  ({canvas: byId(id), program, targets: [], drawn: 0, size: 0,
    tells: {eye: [0, 1.1, 4.9], target: [0, 0, 0], up: [0, 1, 0], wide_angle: 0.245, is_floor: false, is_engine: false,
            ...tells}});

function fitPicture(picture) {
  const size = pixelsOf(picture.canvas);
  if (size === picture.size) return;
  for (const {textures, buffer} of picture.targets) {
    gl.deleteTexture(textures[0]);
    gl.deleteFramebuffer(buffer);
  }
  picture.targets = [0, 1].map(() => makeTarget(size, size, 1));
  picture.size = size;
  picture.drawn = 0;
}

const isDone = ({drawn}) => drawn >= (settings.frames || ENOUGH);

// Adds a sample to each pixel of a picture, or at once all that the address asks for, and shows what they say.
function refinePicture(picture, surface) {
  fitPicture(picture);
  if (isDone(picture)) return;
  const {size, targets, tells} = picture;
  do {
    const n = picture.drawn++;
    const steps = Object.entries(STEPS).map(([name, step]) => [name, step.map((x) => (n * x) % 1)]);
    use(programs[picture.program], {...surface, light: LIGHTS.indexOf(settings.light), ...lampNow(), ...tells,
      material: MATERIALS.indexOf(settings.material), around: radians(settings.around),
      before: [1, targets[n % 2].textures[0]], first: n === 0, size: [size, size], ...Object.fromEntries(steps)});
    fill(targets[1 - n % 2]);
  } while (settings.frames > 0 && !isDone(picture));
  const {exposure} = LAMPS[LIGHTS.indexOf(settings.light)];
  use(programs.show, {sums: [1, sumsOf(picture).textures[0]], exposure});
  fill({width: size, height: size});
  copyTo(picture.canvas, size);
}

const sumsOf = ({targets, drawn}) => targets[drawn % 2];

function lightsOf(picture) {
  const [r, g, b, count] = readTarget(sumsOf(picture), 0);
  return r.map((_, i) => (0.2126 * r[i] + 0.7152 * g[i] + 0.0722 * b[i]) / count[i]);
}

// Mean and spread of the picture's light, and how many of its pixels are no light.
function lightOf(sphere) {
  const lights = lightsOf(sphere).map((y) => Math.min(y, 4)), light = mean(lights);
  return {light, spread: Math.sqrt(mean(lights.map((y) => (y - light) ** 2))),
          light_faults: lights.filter((y) => !(y >= 0)).length};
}
