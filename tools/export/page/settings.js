// ---- settings: controls, and the address of the page ----------------------------------------------

const LIGHTS = ["sky", "studio", "lamp", "white"], MATERIALS = ["gold", "copper", "silver", "red", "black", "glass"];
const LEAST_ALPHA = 0.02;

const settings = {a: 0, b: -1, alpha: [0.2, 0.2], turn: 0, theta: 60, material: "gold", light: "sky", around: 0,
                  whole: false, dots: true, tied: true, median: false, engine: "own", frames: 0};

// A slider goes over equal ratios of alpha.
const alphaAt = (place) => LEAST_ALPHA * Math.pow(1 / LEAST_ALPHA, place);
const placeOf = (alpha) => Math.log(alpha / LEAST_ALPHA) / Math.log(1 / LEAST_ALPHA);
const rounded = (x) => Number(x.toPrecision(3)); // two digits are wider apart than the steps of a slider
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);

// Distributions by name: what stands in the menus.
const choices = new Map([...byId("choice-a").options].map((o) => [o.textContent.toLowerCase(), Number(o.value)]));
const optionOf = (distribution) => [...byId("choice-a").options].find((o) => Number(o.value) === distribution);
const nameOf = (distribution) => optionOf(distribution).textContent;

// What a link says; words that are not understood change nothing.
function readAddress() {
  const number = (text, low, high, otherwise) =>
    text !== "" && Number.isFinite(Number(text)) ? clamped(Number(text), low, high) : otherwise;
  const ends = {turn: [-90, 90], theta: [0, 89], around: [-360, 360], frames: [0, 4096]};
  for (const [name, text] of new URLSearchParams(location.hash.slice(1))) {
    if (name in ends) settings[name] = number(text, ...ends[name], settings[name]);
    if ("ab".includes(name) && choices.has(text.toLowerCase())) settings[name] = choices.get(text.toLowerCase());
    if (["median", "whole", "dots"].includes(name)) settings[name] = name === "dots" ? text !== "0" : text === "1";
    if ({material: MATERIALS, light: LIGHTS}[name]?.includes(text)) settings[name] = text;
    if (name === "engine") settings.engine = text === "ggx" ? "-1" : "own";
    if (name === "alpha") {
      const [x, y = x] = text.split(",");
      settings.alpha = [x, y].map((text, i) => number(text, LEAST_ALPHA, 1, settings.alpha[i]));
      settings.tied = settings.alpha[0] === settings.alpha[1];
    }
  }
}

function writeAddress() {
  const {a, b, alpha, turn, theta, around, material, light, median, whole, dots, engine} = settings;
  const words = {a: nameOf(a), b: nameOf(b), alpha: alpha.join(","), turn, theta, around: Math.round(around), material,
                 light, median: Number(median), whole: Number(whole), dots: Number(dots),
                 engine: engine === "own" ? engine : "ggx"};
  const text = Object.entries(words).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");
  try {
    history.replaceState(null, "", "#" + text.replace(/%2C/g, ","));
  } catch {
    // Some browsers refuse this for a file; then a link keeps no settings.
  }
}

function showSettings() {
  for (const i of [0, 1]) {
    byId(`alpha-${"xy"[i]}`).value = placeOf(settings.alpha[i]);
    byId(`alpha-${"xy"[i]}-says`).textContent = settings.alpha[i].toPrecision(3);
  }
  for (const name of ["turn", "theta"]) {
    byId(name).value = settings[name];
    byId(`${name}-says`).textContent = `${settings[name]}°`;
  }
  for (const name of ["material", "light"]) byId(name).value = settings[name];
  if (byId("baked-for")) byId("baked-for").value = settings.engine;
  for (const name of ["tied", "median", "whole", "dots"]) byId(name).checked = settings[name];
  for (const name of ["a", "b"]) byId(`choice-${name}`).value = settings[name];
}

// `changed` is called with whether the spheres are to be drawn anew.
function listen(changed) {
  const on = (id, spheres, set) => byId(id).addEventListener("input", ({target}) => {
    set(target);
    if (settings.tied) settings.alpha[id === "alpha-y" ? 0 : 1] = settings.alpha[id === "alpha-y" ? 1 : 0];
    showSettings();
    changed(spheres);
  });
  for (const i of [0, 1]) {
    on(`alpha-${"xy"[i]}`, true, ({value}) => { settings.alpha[i] = rounded(alphaAt(Number(value))); });
    on(`choice-${"ab"[i]}`, true, ({value}) => { settings["ab"[i]] = Number(value); });
  }
  for (const name of ["tied", "median", "whole", "dots"])
    on(name, name === "tied" || name === "median", ({checked}) => { settings[name] = checked; });
  for (const name of ["turn", "theta"]) on(name, name === "turn", ({value}) => { settings[name] = Number(value); });
  if (byId("baked-for")) on("baked-for", true, ({value}) => { settings.engine = value; });
  for (const name of ["material", "light"]) on(name, true, ({value}) => { settings[name] = value; });
}

// What every shader is told of the surface.
function surfaceOf(distribution) {
  const scale = settings.median ? 1 / Number(optionOf(distribution).dataset.median) : 1;
  return {numbers: [0, tables], distribution, alpha: settings.alpha.map((alpha) => scale * alpha),
          turn: settings.turn * Math.PI / 180};
}
