// ---- discs, and the figures beside them -----------------------------------------------------------

const SAMPLES = 128, GRID = 256, DOTS = 700;
const EDGES = [90, 60, 45, 30, 20, 15, 10, 6, 4, 2]; // degrees

// Colours from little to much: those of `vndf plot`, and their like on a dark page.
const RAMPS = {
  light: [[250, 251, 247], [205, 232, 206], [120, 198, 186], [44, 140, 180], [26, 79, 142], [10, 26, 74]],
  dark: [[28, 33, 39], [22, 52, 88], [28, 98, 142], [60, 154, 172], [142, 214, 180], [246, 251, 222]],
};
const MARKS = {
  light: {ink: "#212529", halo: "rgba(255,255,255,.85)", ring: "rgba(73,80,87,.45)", rim: "rgba(73,80,87,.8)"},
  dark: {ink: "#f1f3f5", halo: "rgba(16,19,23,.8)", ring: "rgba(173,181,189,.4)", rim: "rgba(173,181,189,.6)"},
};
const darkness = matchMedia("(prefers-color-scheme: dark)");
const theme = () => darkness.matches ? "dark" : "light";

// What many drawn normals say. Dots are some of them, as if at random: squares times the golden ratio.
function measureSamples(surface) {
  use(programs.samples, {...surface, size: [SAMPLES, SAMPLES]});
  fill(targets.samples);
  const [facing, density, angle, off] = readTarget(targets.samples, 0);
  const [kept, faults, x, y] = readTarget(targets.samples, 1);
  const lean = [Math.cos(surface.turn), Math.sin(surface.turn)], [alpha_x, alpha_y] = surface.alpha;
  const slopes = x.map((dx, i) => Math.hypot((lean[0] * dx + lean[1] * y[i]) / alpha_x,
    (lean[0] * y[i] - lean[1] * dx) / alpha_y) / Math.sqrt(Math.max(1 - dx * dx - y[i] * y[i], 1e-12)));
  const quantile = (values, part) => values.sort()[Math.floor(part * values.length)];
  const dots = Array.from({length: DOTS}, (_, i) => Math.imul(i * i, 0x9E3779B1) >>> 18).map((at) => [x[at], y[at]]);
  return {facing: mean(facing), off: off.reduce((a, b) => Math.max(a, b)), kept: mean(kept), faults: sum(faults), dots,
          slopes, angle: quantile(angle, 0.97) * 180 / Math.PI, high: quantile(density, 0.98), low: quantile(density, 0.02)};
}

// Half of the borders of columns are even, half are quantiles of drawn slopes: a thin ring has columns of its own.
function placeColumns(slopes) {
  const half = GRID / 2, sorted = slopes.sort(), even = Array.from({length: half + 1}, (_, i) => i / half);
  const quantiles = Array.from({length: half}, (_, i) => {
    const part = Math.sin(Math.PI / 2 * i / (half - 1)) ** 2; // closer at both ends
    const odds = Math.cbrt(sorted[Math.floor(part * (sorted.length - 1))]);
    return odds / (1 + odds);
  });
  const borders = [...even, ...quantiles].sort((a, b) => a - b);
  const columns = borders.slice(1).flatMap((end, i) => [(borders[i] + end) / 2, end - borders[i], 0, 0]);
  gl.bindTexture(gl.TEXTURE_2D, targets.columns);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, GRID, 1, gl.RGBA, gl.FLOAT, new Float32Array(columns));
}

// What the density itself says.
function measureDensity(surface, {slopes}) {
  placeColumns(slopes);
  use(programs.integral, {...surface, size: [GRID, GRID], columns: [1, targets.columns]});
  fill(targets.grid);
  const [whole, facing, truth] = readTarget(targets.grid, 0).map(sum);
  return {whole, facing, truth};
}

const edgeFor = (angle) => settings.whole ? 90 : EDGES.filter((edge) => edge >= angle).pop() || 90;

// The least of 1, 2, 5, 10, ... that is x or more.
function roundUp(x) {
  const power = Math.pow(10, Math.floor(Math.log10(x)));
  return Number((power * [1, 2, 5, 10].find((digit) => digit * power >= x * 0.999)).toPrecision(1));
}

// Which densities the colours of both discs show: whole decades.
function scaleOf(...says) {
  const top = roundUp(Math.max(...says.map(({high}) => high))), low = Math.min(...says.map(({low}) => low));
  const decades = clamped(Math.ceil(Math.log10(top / low) + 0.5), 2, 7);
  return {top, decades};
}

function drawDisc(canvas, surface, edge, scale, dots) {
  const size = pixelsOf(canvas), rim = Math.sin(radians(edge) / 2);
  use(programs.heat, {...surface, size: [size, size], rim, ...scale,
                      stops: RAMPS[theme()].flat().map((v) => v / 255)});
  fill({width: size, height: size});
  const context = copyTo(canvas, size);
  if (settings.dots) drawDots(context, dots, size / 2, rim, size / Math.max(canvas.clientWidth, 1));
  drawMarks(context, size, edge);
}

function drawDots(context, dots, half, rim, pixel) {
  context.fillStyle = "#f76707";
  context.strokeStyle = theme() === "dark" ? "#000" : "#fff";
  context.lineWidth = 0.7 * pixel;
  for (const [x, y] of dots) {
    const to = half / (rim * Math.sqrt(2 * (1 + Math.sqrt(Math.max(1 - x * x - y * y, 0)))));
    if (Math.hypot(x, y) * to > half) continue;
    context.beginPath();
    context.arc(half + to * x, half - to * y, 1.65 * pixel, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

// Rings at angles, and where the light comes from.
function drawMarks(context, size, edge) {
  const half = size / 2, rim = Math.sin(radians(edge) / 2), colours = MARKS[theme()];
  const radius = (degrees) => half * Math.sin(radians(degrees) / 2) / rim;
  const label = (text, x, y) => {
    context.strokeText(text, x, y);
    context.fillText(text, x, y);
  };
  const points = 10.5 * size / Math.max(context.canvas.clientWidth, 1);
  context.font = `${points}px ${getComputedStyle(document.documentElement).fontFamily}`;
  context.textAlign = "center";
  context.lineJoin = "round";
  context.lineWidth = points / 12;
  for (const part of [1 / 3, 2 / 3, 1]) {
    context.strokeStyle = part < 1 ? colours.ring : colours.rim;
    context.beginPath();
    context.arc(half, half, radius(edge * part) - context.lineWidth / 2, 0, 2 * Math.PI);
    context.stroke();
  }
  context.lineWidth = points / 3;
  context.strokeStyle = colours.halo;
  context.fillStyle = colours.ink;
  for (const part of [1 / 3, 2 / 3, 1])
    label(`${Number((edge * part).toPrecision(2))}°`, half,
          half - radius(edge * part) + (part < 1 ? points / 3 : 1.3 * points));
  if (settings.theta >= 0.95 * edge) return;
  context.beginPath(); // a spot where the incident direction is
  context.arc(half + radius(settings.theta), half, points / 3, 0, 2 * Math.PI);
  context.stroke();
  context.fill();
  label("ωi", half + radius(settings.theta), half - 0.73 * points);
}

// ---- figures in words -----------------------------------------------------------------------------

const digits = (x, n) => x === 0 ? "0" : Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5 ? x.toExponential(1) : x.toFixed(n);

function showFigures(list, distribution, samples, density) {
  const rows = [
    ["Mean of ωi·ωm, drawn", digits(samples.facing, 4), "over 16 384 drawn normals"],
    ["from the density", digits(density.facing, 4), "an integral over the hemisphere"],
    ["Integral of the density", digits(density.whole, 4), "over the hemisphere: 1 if it is one"],
    ["Normals turned away", digits(samples.faults, 0), "of 16 384 drawn ones"],
    ["Drawn density to pdf", samples.off < 1e-7 ? "same" : `±${samples.off.toExponential(0)}`,
     "the largest relative difference between the density that vndf_sample returns and vndf_pdf: rounding of floats"],
    ["Light kept by one bounce", `${(100 * samples.kept).toFixed(1)} %`, "the mean of G2/G1"],
    ["Promised error", distribution < 0 ? "none: closed form" : `at most ${optionOf(distribution).dataset.tv}`,
     "total variation from the true visible normals, from the certificate"],
  ];
  list.replaceChildren(...rows.flatMap(([what, value, why]) => {
    const name = document.createElement("dt"), says = document.createElement("dd");
    name.textContent = what;
    name.title = why;
    says.textContent = value;
    return [name, says];
  }));
}
