// ---- the page -------------------------------------------------------------------------------------

// Pixels of a square canvas: as the screen has them, within what a phone can draw.
const pixelsOf = (canvas) =>
  Math.round(clamped(canvas.clientWidth * clamped(devicePixelRatio || 1, 1, 2), 64, 720));

function makePrograms(gl) {
  const screen = ["screen.vert.glsl"], sampling = ["kernel", "surface.glsl"];
  return {
    sphere: makeProgram(gl, screen, [...sampling, "light.glsl", "sphere.glsl"]),
    show: makeProgram(gl, screen, ["show.glsl"]),
    heat: makeProgram(gl, screen, [...sampling, "heat.glsl"]),
    dots: makeProgram(gl, [...sampling, "dots.vert.glsl"], ["dots.glsl"]),
    samples: makeProgram(gl, screen, [...sampling, "samples.glsl"]),
    integral: makeProgram(gl, screen, [...sampling, "integral.glsl"]),
    curve: makeProgram(gl, screen, [...sampling, "curve.glsl"]),
  };
}

function makePage() {
  const gl = openGl(), programs = makePrograms(gl);
  const page = {gl, numbers: tableTexture(gl, readNumbers(textOf("numbers"))), discs: makeDiscs(gl, programs),
                curves: makeCurves(gl, programs), stale: true, says: {}};
  page.spheres = {a: makeSphere(gl, programs, byId("sphere-a")), b: makeSphere(gl, programs, byId("sphere-b"))};
  return page;
}

const surfaceIn = (page, name) => surfaceOf(page.numbers, settings[name]);

function showScale({top, decades}, edge) {
  const colours = RAMPS[theme()].map((colour) => `rgb(${colour.join(",")})`).join(",");
  byId("scale-ramp").style.background = `linear-gradient(to right,${colours})`;
  byId("scale-low").textContent = Number((top * Math.pow(10, -decades)).toPrecision(1));
  byId("scale-high").textContent = top;
  byId("scale-says").textContent = `density per steradian, up to ${edge}° from the mean normal`;
}

// Everything but the spheres.
function drawStill(page) {
  const says = {};
  for (const name of ["a", "b"]) {
    const surface = surfaceIn(page, name);
    says[name] = {samples: measureSamples(page.discs, surface), density: measureDensity(page.discs, surface)};
    showFigures(byId(`figures-${name}`), settings[name], says[name].samples, says[name].density);
  }
  const edge = edgeFor(Math.max(says.a.samples.angle, says.b.samples.angle));
  const scale = scaleOf(says.a.samples, says.b.samples);
  for (const name of ["a", "b"]) drawDisc(page.discs, byId(`disc-${name}`), surfaceIn(page, name), edge, scale);
  showScale(scale, edge);
  drawCurves(page.curves, byId("curves"), page.numbers, Math.min(90, 3 * edge));
  page.says = says;
  page.stale = false;
}

// A fresh picture begins with as many samples as the address asks for; each later frame adds one.
function drawSpheres(page) {
  for (const name of ["a", "b"]) {
    const sphere = page.spheres[name];
    fitSphere(sphere, pixelsOf(sphere.canvas));
    if (sphere.drawn >= ENOUGH) continue;
    const samples = sphere.drawn === 0 ? Math.max(settings.frames, 1) : 1;
    for (let i = 0; i < samples; i++) refineSphere(sphere, surfaceIn(page, name));
    showSphere(sphere);
  }
}

// For tests and programs: what was measured, on the root of the document.
function tell(page) {
  const says = {drawn: page.spheres.a.drawn, error: page.gl.getError()};
  for (const name of ["a", "b"]) {
    const {samples, density} = page.says[name], light = lightOf(page.spheres[name]);
    Object.assign(says, {
      [`${name}_whole`]: density.whole, [`${name}_true_whole`]: density.truth, [`${name}_facing`]: samples.facing,
      [`${name}_facing_to_density`]: samples.facing / density.facing, [`${name}_faults`]: samples.faults,
      [`${name}_off`]: samples.off, [`${name}_kept`]: samples.kept, [`${name}_light`]: light.mean,
      [`${name}_spread`]: light.spread, [`${name}_light_faults`]: light.faults,
    });
  }
  document.documentElement.dataset.measured = JSON.stringify(says);
}

function turnByDragging(page, changed) {
  for (const {canvas} of Object.values(page.spheres)) {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      settings.around = (settings.around - 180 * event.movementX / canvas.clientWidth) % 360;
      changed(true);
    });
  }
}

// What goes wrong is said on the page; without pictures it still has the promises.
function attempt(work) {
  try {
    work();
  } catch (error) {
    byId("trouble").textContent = error instanceof Trouble ? error.message : `Something went wrong: ${error}`;
    byId("trouble").hidden = false;
    document.body.classList.add("without");
  }
}

function run(page) {
  const changed = (spheres) => {
    page.stale = true;
    settings.frames = 0;
    if (spheres) for (const sphere of Object.values(page.spheres)) sphere.drawn = 0;
    writeAddress();
  };
  const frame = () => attempt(() => {
    if (page.gl.isContextLost()) throw new Trouble("The browser took the graphics away; load the page again.");
    if (page.stale) drawStill(page);
    drawSpheres(page);
    requestAnimationFrame(frame);
  });
  listen(changed);
  turnByDragging(page, changed);
  addEventListener("resize", () => { page.stale = true; });
  darkness.addEventListener("change", () => { page.stale = true; });
  addEventListener("hashchange", () => {
    readAddress();
    showSettings();
    changed(true);
  });
  if (settings.frames > 0) {
    drawStill(page);
    drawSpheres(page);
    tell(page);
  }
  requestAnimationFrame(frame);
}

attempt(() => {
  readAddress();
  showSettings();
  run(makePage());
});
