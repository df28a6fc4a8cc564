/* The language that a page begins in where its address names none. */
const ownLanguage = () => Math.max(0, LANGUAGES.indexOf((navigator.language || "en").slice(0, 2)));

/* The state of the page in its address: #scene=...&set=key=value&seed=7. Also read after a question mark. */
function readUrlState() {
  const given = new URLSearchParams(location.hash.length > 1 ? location.hash.slice(1) : location.search.slice(1));
  const pairs = given.getAll("set").map((one) => {
    const at = one.indexOf("=");
    return at < 0 ? [one, ""] : [one.slice(0, at), one.slice(at + 1)];
  });
  if (given.has("seed")) pairs.push(["run.seed", given.get("seed")]);
  const sets = Object.fromEntries(pairs); /* whatever a key is called */
  return { scene: given.get("scene"), sets, lesson: given.get("lesson"), language: given.get("language") };
}

function urlState(state) {
  const to = new URLSearchParams();
  to.set("scene", state.scene);
  for (const [key, value] of Object.entries(state.sets)) if (key !== "run.seed") to.append("set", `${key}=${value}`);
  const given = state.sets["run.seed"],
    seed = given !== undefined ? given : state.about && state.about.values.run.seed;
  if (given !== undefined || Number(seed) <= Number.MAX_SAFE_INTEGER) to.set("seed", seed); /* else in the scene */
  if (state.lesson) to.set("lesson", state.lesson);
  if (language || ownLanguage()) to.set("language", LANGUAGES[language]);
  return `#${to}`;
}

/* Without an entry in the history for each movement of a slider. */
function writeUrlState(state) {
  try {
    history.replaceState(null, "", urlState(state));
  } catch (e) {
    /* an address too long for this browser */
  }
}
