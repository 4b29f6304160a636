// ---- the page -------------------------------------------------------------------------------------

let tables, programs, targets;
const spheres = ["a", "b"].map((name) => ({name, ...makePicture(`sphere-${name}`, "sphere", {})}));
let says = {}; // what was measured
let stale = true;

// Pixels of a square canvas: as the screen has them, within what a phone can draw.
const pixelsOf = (canvas) =>
  Math.round(clamped(canvas.clientWidth * clamped(devicePixelRatio || 1, 1, 2), 64, 720));

function makePage() {
  openGl();
  const sampling = ["kernel", "surface.glsl"], lit = [...sampling, "light.glsl"], drawn = [...lit, "pixels.glsl"];
  const before = {show: [], heat: sampling, samples: sampling, integral: sampling, curve: sampling, sphere: drawn,
                  ...scenes.length > 0 ? {engines: drawn, cube: lit, difference: []} : {}};
  programs = {};
  for (const [name, files] of Object.entries(before)) programs[name] = makeProgram([...files, `${name}.glsl`]);
  targets = {samples: makeTarget(SAMPLES, SAMPLES, 2), grid: makeTarget(GRID, GRID, 1),
             curve: makeTarget(POINTS, 1, 1), columns: makeTexture(gl.RGBA32F, GRID, 1, null)};
  tables = tableTexture();
}

function showScale({top, decades}, edge) {
  const colours = RAMPS[theme()].map((colour) => `rgb(${colour.join(",")})`).join(",");
  byId("scale-ramp").style.background = `linear-gradient(to right,${colours})`;
  byId("scale-low").textContent = Number((top * Math.pow(10, -decades)).toPrecision(1));
  byId("scale-high").textContent = top;
  byId("scale-says").textContent = `density per steradian, up to ${edge}° from the mean normal`;
}

// Everything but the spheres.
function drawStill() {
  says = {};
  for (const {name} of spheres) {
    const surface = surfaceOf(settings[name]);
    const samples = measureSamples(surface);
    says[name] = {samples, density: measureDensity(surface, samples)};
    showFigures(byId(`figures-${name}`), settings[name], says[name].samples, says[name].density);
  }
  const edge = edgeFor(Math.max(says.a.samples.angle, says.b.samples.angle));
  const scale = scaleOf(says.a.samples, says.b.samples);
  for (const {name} of spheres)
    drawDisc(byId(`disc-${name}`), surfaceOf(settings[name]), edge, scale, says[name].samples.dots);
  showScale(scale, edge);
  drawCurves(byId("curves"), Math.min(90, 3 * edge));
  stale = false;
}

// For tests and programs: what was measured, on the root of the document.
function tell() {
  const all = {drawn: spheres[0].drawn, error: gl.getError()};
  for (const sphere of spheres) {
    const {samples: {facing, faults, off, kept}, density} = says[sphere.name];
    const told = {...density, facing_to_density: facing / density.facing, faults, off, kept, ...lightOf(sphere)};
    for (const [what, value] of Object.entries(told)) all[`${sphere.name}_${what}`] = value;
  }
  for (const {name, pictures} of scenes) all[`${name}_error`] = pictures.error;
  document.documentElement.dataset.measured = JSON.stringify(all);
}

function turnByDragging(changed) {
  for (const {canvas} of spheres) {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      settings.around = (settings.around - 180 * event.movementX / canvas.clientWidth) % 360;
      changed(true);
    });
  }
}

// What goes wrong is said on the page.
function attempt(work) {
  try {
    work();
  } catch (error) {
    byId("trouble").textContent = error instanceof Trouble ? error.message : `Something went wrong: ${error}`;
    byId("trouble").hidden = false;
    document.body.classList.add("without");
  }
}

function run() {
  const changed = (anew) => {
    stale = true;
    settings.frames = 0;
    if (anew) for (const picture of [...spheres, ...scenes.flatMap(({pictures}) => pictures)]) picture.drawn = 0;
    writeAddress();
  };
  const draw = () => {
    if (gl.isContextLost()) throw new Trouble("The browser took the graphics away; load the page again.");
    if (stale) drawStill();
    for (const sphere of spheres) refinePicture(sphere, surfaceOf(settings[sphere.name]));
    drawEngines();
  };
  const frame = () => attempt(() => { // without work once all is drawn, or a headless browser may never end
    draw();
    requestAnimationFrame(frame);
  });
  listen(changed);
  turnByDragging(changed);
  addEventListener("resize", () => { stale = true; });
  darkness.addEventListener("change", () => { stale = true; });
  addEventListener("hashchange", () => {
    readAddress();
    showSettings();
    changed(true);
  });
  if (settings.frames > 0) {
    draw();
    tell();
  }
  requestAnimationFrame(frame);
}

attempt(() => {
  readAddress();
  showSettings();
  makePage();
  run();
});
