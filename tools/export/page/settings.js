// ---- settings: controls, and the address of the page ----------------------------------------------

const LIGHTS = ["sky", "studio", "lamp", "white"], MATERIALS = ["gold", "copper", "silver", "red", "black", "glass"];
const LEAST_ALPHA = 0.02;

const settings = {a: 0, b: -1, alpha: [0.2, 0.2], turn: 0, theta: 60, material: "gold", light: "sky", around: 0,
                  whole: false, dots: true, tied: true, median: false, engine: "own", frames: 0};

// A slider goes over equal ratios of alpha.
const alphaAt = (place) => LEAST_ALPHA * Math.pow(1 / LEAST_ALPHA, place);
const placeOf = (alpha) => Math.log(alpha / LEAST_ALPHA) / Math.log(1 / LEAST_ALPHA);
const rounded = (x) => Number(x.toPrecision(3)); // two digits are wider apart than the steps of a slider
const radians = (degrees) => degrees * Math.PI / 180;
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);

// Distributions by name: what stands in the menus.
const choices = new Map([...byId("choice-a").options].map((o) => [o.textContent.toLowerCase(), Number(o.value)]));
const optionOf = (distribution) => [...byId("choice-a").options].find((o) => Number(o.value) === distribution);
if (!optionOf(0)) settings.a = -2; // a page without tables
const nameOf = (distribution) => optionOf(distribution).textContent;

// How settings stand in the address; words that are not understood change nothing.
const number = (low, high) => ({write: String, read: (text, otherwise) =>
  text !== "" && Number.isFinite(Number(text)) ? clamped(Number(text), low, high) : otherwise});
const oneOf = (words) => ({write: String, read: (text, otherwise) => words.includes(text) ? text : otherwise});
const tick = {write: Number, read: (text) => text === "1"};
const menu = {write: nameOf, read: (text, otherwise) => choices.get(text.toLowerCase()) ?? otherwise};
const alphas = {write: String, read: (text, otherwise) => {
  const [x, y = x] = text.split(",");
  return [x, y].map((text, i) => number(LEAST_ALPHA, 1).read(text, otherwise[i]));
}};
const IN_ADDRESS = {a: menu, b: menu, alpha: alphas, turn: number(-90, 90), theta: number(0, 89),
                    around: {...number(-360, 360), write: Math.round}, material: oneOf(MATERIALS), light: oneOf(LIGHTS),
                    median: tick, whole: tick, dots: tick, engine: oneOf(["own", "ggx"]), frames: number(0, 4096)};

function readAddress() {
  for (const [name, text] of new URLSearchParams(location.hash.slice(1)))
    if (name in IN_ADDRESS) settings[name] = IN_ADDRESS[name].read(text, settings[name]);
  settings.tied = settings.alpha[0] === settings.alpha[1];
}

function writeAddress() {
  const text = Object.entries(IN_ADDRESS).filter(([name]) => name !== "frames")
    .map(([name, {write}]) => `${name}=${encodeURIComponent(write(settings[name]))}`).join("&");
  try {
    history.replaceState(null, "", "#" + text.replace(/%2C/g, ","));
  } catch {
    // Some browsers refuse this for a file; then a link keeps no settings.
  }
}

// What has one control: a slider with its degrees beside it, a menu or a tick.
const controls = ["a", "b", "turn", "theta", "material", "light", "tied", "median", "whole", "dots", "engine"]
  .map((name) => [name, byId(name) || byId(`choice-${name}`)]).filter(([, control]) => control);

function showSettings() {
  for (const i of [0, 1]) {
    byId(`alpha-${"xy"[i]}`).value = placeOf(settings.alpha[i]);
    byId(`alpha-${"xy"[i]}-says`).textContent = settings.alpha[i].toPrecision(3);
  }
  for (const [name, control] of controls) {
    control[control.type === "checkbox" ? "checked" : "value"] = settings[name];
    if (control.type === "range") byId(`${name}-says`).textContent = `${settings[name]}°`;
  }
}

// `changed` is called with whether the spheres are to be drawn anew.
function listen(changed) {
  const on = (control, anew, set) => control.addEventListener("input", () => {
    set(control);
    const leads = control.id === "alpha-y" ? 1 : 0;
    if (settings.tied) settings.alpha[1 - leads] = settings.alpha[leads];
    showSettings();
    changed(anew);
  });
  for (const i of [0, 1])
    on(byId(`alpha-${"xy"[i]}`), true, ({value}) => { settings.alpha[i] = rounded(alphaAt(Number(value))); });
  for (const [name, control] of controls)
    on(control, !["theta", "whole", "dots"].includes(name), ({type, checked, value}) => {
      settings[name] = type === "checkbox" ? checked : typeof settings[name] === "number" ? Number(value) : value;
    });
}

// What every shader is told of the surface and the incident direction.
function surfaceOf(distribution) {
  const angle = radians(settings.theta);
  const scale = settings.median ? 1 / Number(optionOf(distribution).dataset.median) : 1;
  return {numbers: [0, tables], distribution, alpha: settings.alpha.map((alpha) => scale * alpha),
          turn: radians(settings.turn), incident: [Math.sin(angle), 0, Math.cos(angle)]};
}
