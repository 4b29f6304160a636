// ---- settings: controls, and the address of the page ----------------------------------------------

const LIGHTS = ["sky", "studio", "lamp", "white"], MATERIALS = ["gold", "copper", "silver", "red", "black", "glass"];
const LEAST_ALPHA = 0.02;

const settings = {a: 0, b: -1, alpha: [0.2, 0.2], turn: 0, theta: 60, material: "gold", light: "sky", around: 0,
                  whole: false, dots: true, tied: true, median: false, frames: 0};

// A slider goes over equal ratios of alpha.
const alphaAt = (place) => LEAST_ALPHA * Math.pow(1 / LEAST_ALPHA, place);
const placeOf = (alpha) => Math.log(alpha / LEAST_ALPHA) / Math.log(1 / LEAST_ALPHA);
const rounded = (x) => Number(x.toPrecision(3)); // two digits are wider apart than the steps of a slider
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);

// Distributions by name: what stands in the menus.
const choices = new Map([...byId("choice-a").options].map((o) => [o.textContent.toLowerCase(), Number(o.value)]));
const optionOf = (distribution) => [...byId("choice-a").options].find((o) => Number(o.value) === distribution);
const nameOf = (distribution) => optionOf(distribution).textContent;

const numberIn = (text, low, high, otherwise) =>
  text !== "" && Number.isFinite(Number(text)) ? clamped(Number(text), low, high) : otherwise;

// What a link says; words that are not understood change nothing.
const readers = {
  a: (text) => { if (choices.has(text.toLowerCase())) settings.a = choices.get(text.toLowerCase()); },
  b: (text) => { if (choices.has(text.toLowerCase())) settings.b = choices.get(text.toLowerCase()); },
  alpha: (text) => {
    const [x, y] = text.split(",");
    settings.alpha[0] = numberIn(x, LEAST_ALPHA, 1, settings.alpha[0]);
    settings.alpha[1] = y === undefined ? settings.alpha[0] : numberIn(y, LEAST_ALPHA, 1, settings.alpha[1]);
    settings.tied = settings.alpha[0] === settings.alpha[1];
  },
  turn: (text) => { settings.turn = numberIn(text, -90, 90, settings.turn); },
  theta: (text) => { settings.theta = numberIn(text, 0, 89, settings.theta); },
  around: (text) => { settings.around = numberIn(text, -360, 360, settings.around); },
  frames: (text) => { settings.frames = numberIn(text, 0, 4096, 0); },
  material: (text) => { if (MATERIALS.includes(text)) settings.material = text; },
  light: (text) => { if (LIGHTS.includes(text)) settings.light = text; },
  median: (text) => { settings.median = text === "1"; },
  whole: (text) => { settings.whole = text === "1"; },
  dots: (text) => { settings.dots = text !== "0"; },
};

function readAddress() {
  for (const [name, value] of new URLSearchParams(location.hash.slice(1)))
    if (Object.hasOwn(readers, name)) readers[name](value);
}

function writeAddress() {
  const words = [["a", nameOf(settings.a)], ["b", nameOf(settings.b)], ["alpha", settings.alpha.join(",")],
                 ["turn", settings.turn], ["theta", settings.theta], ["around", Math.round(settings.around)],
                 ["material", settings.material], ["light", settings.light],
                 ...["median", "whole", "dots"].map((name) => [name, Number(settings[name])])];
  const text = words.map(([name, value]) => `${name}=${encodeURIComponent(value).replace(/%2C/g, ",")}`).join("&");
  try {
    history.replaceState(null, "", "#" + text);
  } catch {
    // Some browsers refuse this for a file; then a link keeps no settings.
  }
}

function showSettings() {
  for (const [i, axis] of ["x", "y"].entries()) {
    byId(`alpha-${axis}`).value = placeOf(settings.alpha[i]);
    byId(`alpha-${axis}-says`).textContent = settings.alpha[i].toPrecision(3);
  }
  byId("turn").value = settings.turn;
  byId("turn-says").textContent = `${settings.turn}°`;
  byId("theta").value = settings.theta;
  byId("theta-says").textContent = `${settings.theta}°`;
  for (const name of ["material", "light"]) byId(name).value = settings[name];
  for (const name of ["tied", "median", "whole", "dots"]) byId(name).checked = settings[name];
  byId("choice-a").value = settings.a;
  byId("choice-b").value = settings.b;
}

// `changed` is called with whether the spheres are to be drawn anew.
function listen(changed) {
  const on = (id, kind, spheres, set) => byId(id).addEventListener(kind, (event) => {
    set(event.target);
    showSettings();
    changed(spheres);
  });
  for (const i of [0, 1])
    on(`alpha-${"xy"[i]}`, "input", true, (slider) => {
      settings.alpha[i] = rounded(alphaAt(Number(slider.value)));
      if (settings.tied) settings.alpha[1 - i] = settings.alpha[i];
    });
  on("tied", "change", true, (box) => {
    settings.tied = box.checked;
    if (settings.tied) settings.alpha[1] = settings.alpha[0];
  });
  on("median", "change", true, (box) => { settings.median = box.checked; });
  on("turn", "input", true, (slider) => { settings.turn = Number(slider.value); });
  on("theta", "input", false, (slider) => { settings.theta = Number(slider.value); });
  for (const name of ["material", "light"]) on(name, "change", true, (menu) => { settings[name] = menu.value; });
  for (const name of ["whole", "dots"]) on(name, "change", false, (box) => { settings[name] = box.checked; });
  for (const name of ["a", "b"])
    on(`choice-${name}`, "change", true, (menu) => { settings[name] = Number(menu.value); });
}

// What every shader is told of the surface.
function surfaceOf(numbers, distribution) {
  const scale = settings.median ? 1 / Number(optionOf(distribution).dataset.median) : 1;
  return {numbers: [0, numbers], distribution, alpha: settings.alpha.map((alpha) => scale * alpha),
          turn: settings.turn * Math.PI / 180};
}
