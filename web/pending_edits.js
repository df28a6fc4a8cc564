/* Pending edits: each builds on the one before, be it in force already or not. */

/* What is asked of the gas by now: the keys set over its scene, those a control is about to change among them; a key as
 * text; and the values that controls build on. What is in force lags behind until the answer. */
const wantedSets = () => ({ ...page.asked.sets, ...page.pending });
function wantedText(key) {
  const wanted = wantedSets()[key];
  return wanted === undefined || wanted === page.sets[key] ? asText(valueOf(page.about.values, key)) : wanted;
}
function wantedValues() {
  const values = { ...page.about.values };
  for (const key of ["species", "gravity"])
    try {
      values[key] = JSON.parse(wantedText(key));
    } catch (e) {
      /* a link's own way to write it: what is in force */
    }
  return values;
}

/* Keys that would cost energy, and what they are in an elastic gas. */
const ELASTIC = { "collision.e": "1", "collision.beta": "-1", "collision.mu": "inf", "collision.law": "constant" };

/* What a flow needs, and others refuse. An elastic gas needs e = 1; the flow that comes after it has again what was
 * there before, or 0.9 where nothing was. */
function changeKey(key, value) {
  const before = wantedText("flow"),
    sets = { [key]: value };
  if (key === "flow")
    Object.assign(sets, {
      thermostat: value === "hss" ? "gaussian" : "none",
      gravity: value === "chute" ? "[0.1, -0.1, 0]" : "[0, 0, 0]",
    });
  if (key === "flow" && value === "equilibrium") {
    if (before !== "equilibrium")
      page.inelastic = Object.fromEntries(Object.keys(ELASTIC).map((one) => [one, wantedText(one)]));
    Object.assign(sets, ELASTIC);
  } else if (key === "flow" && before === "equilibrium") {
    Object.assign(sets, page.inelastic || { "collision.e": "0.9" });
    page.inelastic = null;
  }
  page.pending = { ...page.pending, ...sets };
  clearTimeout(page.changeTimer);
  page.changeTimer = setTimeout(() => start(page.asked.scene, wantedSets()), 120);
}
