/* The state of the page in its address: #scene=...&set=key=value&seed=7. Also read after a question mark. */
function readLink() {
  const given = new URLSearchParams(location.hash.length > 1 ? location.hash.slice(1) : location.search.slice(1));
  const sets = {};
  for (const one of given.getAll("set")) {
    const at = one.indexOf("=");
    sets[at < 0 ? one : one.slice(0, at)] = at < 0 ? "" : one.slice(at + 1);
  }
  if (given.has("seed")) sets["run.seed"] = given.get("seed");
  return { scene: given.get("scene"), sets, lesson: given.get("lesson"), language: given.get("language") };
}

function linkOf(state) {
  const to = new URLSearchParams();
  to.set("scene", state.scene);
  for (const [key, value] of Object.entries(state.sets)) if (key !== "run.seed") to.append("set", `${key}=${value}`);
  to.set("seed", state.sets["run.seed"] || "1");
  if (state.lesson) to.set("lesson", state.lesson);
  if (language) to.set("language", LANGUAGES[language]);
  return `#${to}`;
}

/* Without an entry in the history for each movement of a slider. */
function writeLink(state) {
  try {
    history.replaceState(null, "", linkOf(state));
  } catch (e) {
    /* an address too long for this browser */
  }
}
