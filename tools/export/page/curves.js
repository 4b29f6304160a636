// ---- D as curves ----------------------------------------------------------------------------------

const POINTS = 256, DECADES = 6;

function measureCurve(surface, last) {
  use(programs.curve, {...surface, size: [POINTS, 1], last: radians(last)});
  fill(targets.curve);
  return readTarget(targets.curve, 0)[0];
}

// All distributions of the menus: the two chosen in bold, the others thin, in hues and dashes of their own.
const lookOf = (i) => `--hue:${[155, 290, 50, 190, 330, 100][i % 6]};--dash:${["none", "7 3", "2 3"][i / 6 % 3 | 0]}`;

function drawCurves(box, last) {
  const all = [...new Set(choices.values())].map((distribution) => ({distribution,
    values: measureCurve(surfaceOf(distribution), last)}));
  const chosen = all.filter(({distribution}) => distribution === settings.a || distribution === settings.b);
  const highest = Math.max(...chosen.map(({values}) => values.reduce((m, v) => Math.max(m, v), 0)));
  const top = Math.pow(10, Math.ceil(Math.log10(highest) - 0.05)), width = Math.max(box.clientWidth, 320), height = 300;
  const left = 52, right = 12, upper = 10, lower = 34;
  const x = (i) => left + (width - left - right) * i / (POINTS - 1);
  const y = (v) => upper + (height - upper - lower) * clamped(Math.log10(top / Math.max(v, 1e-30)) / DECADES, 0, 1.2);
  const path = (values) => "M" + Array.from(values, (v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join("L");
  const rank = ({distribution}) => (distribution === settings.b) + 2 * (distribution === settings.a);
  const others = all.filter((line) => !chosen.includes(line)).map(({distribution}) => distribution);
  const lines = [...all].sort((p, q) => rank(p) - rank(q)).map((line) =>
    `<path class="line ${["other", "b", "a", "a"][rank(line)]}" style="${lookOf(others.indexOf(line.distribution))}"` +
    ` d="${path(line.values)}"/>`);
  const marks = [];
  for (let i = 0; i <= DECADES; i++) {
    const at = upper + (height - upper - lower) * i / DECADES, power = Math.round(Math.log10(top)) - i;
    marks.push(`<line class="grid" x1="${left}" x2="${width - right}" y1="${at}" y2="${at}"/>` +
      `<text x="${left - 6}" y="${at + 4}" text-anchor="end">10<tspan dy="-5" font-size="9">${power}</tspan></text>`);
  }
  for (let i = 0; i <= 6; i++) {
    const at = x((POINTS - 1) * i / 6);
    marks.push(`<line class="grid" y1="${upper}" y2="${height - lower}" x1="${at}" x2="${at}"/>` +
      `<text x="${at}" y="${height - lower + 18}" text-anchor="${i === 6 ? "end" : "middle"}">` +
      `${Number((last * i / 6).toPrecision(3))}°</text>`);
  }
  box.innerHTML = `<svg viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" role="img"` +
    ` aria-label="D over the angle of the normal"><clipPath id="inside"><rect x="${left}" y="${upper}"` +
    ` width="${width - left - right}" height="${height - upper - lower}"/></clipPath>${marks.join("")}` +
    `<g clip-path="url(#inside)">${lines.join("")}</g></svg><p class="legend"></p>`;
  box.lastChild.append(...legend(others));
}

function legend(others) {
  const keys = [["a", settings.a], ...settings.a === settings.b ? [] : [["b", settings.b]],
                ...others.map((other) => ["other", other])];
  return keys.map(([kind, distribution]) => {
    const entry = document.createElement("span");
    entry.className = `entry ${kind}`;
    entry.style = lookOf(others.indexOf(distribution));
    entry.textContent = nameOf(distribution);
    return entry;
  });
}
