/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page: actions of the user, and the calls that they make. */
import { BoxView, CAMERA } from "./box.js";
import { runClock, SPEEDS } from "./clock.js";
import { Controls, wantedValues } from "./controls.js";
import { endPlaying, FRAMES_A_SECOND, goTo, listenForFiles, openFile, played } from "./files.js";
import { again, change, follow, now, openWorkers, ownScene, page, reverse, start } from "./gas.js";
import { ownLanguage, t } from "./i18n.js";
import { lessonOf } from "./lessons.js";
import { linkOf, linkOfPoints, pointsIn, readLink, tidyQuestion } from "./link.js";
import { clearKept, forgetStudent, gather, keepPoint, pointsCsv, pointsText, pointsTexts, shownName, studentsOf, tidyName } from "./points.js";
import { qrSvg } from "./qr.js";
import { boxPicture, curvesCsv, curveSvg, fileName, save } from "./save.js";
import { begin, describe, drawFrame, parts, say, show } from "./show.js";
import { openSound } from "./sound.js";
import { store } from "./state.js";
import { byId } from "./words.js";
import { workers } from "./worker_rpc.js";

function givenScene() {
  const given = JSON.parse(byId("given").textContent);
  return given === null || /^@given@$/.test(given) ? null : given;
}

async function main() {
  const link = readLink(),
    turned = (camera) => store.look({ camera }),
    picked = (grain) => store.look({ grain });
  begin({
    controls: new Controls(byId("control-rows"), change, wantedValues),
    view: new BoxView(byId("box"), turned, picked),
    twin: new BoxView(byId("twin"), turned, picked),
  });
  store.subscribe(show);
  store.dispatch("look", { change: { language: link.language || ownLanguage(), view: link.look.view || "all" } });
  show(store.state, {});
  listen();
  byId("lesson-name").textContent = t("loading");
  try {
    byId("version").textContent = t("version", { version: `${await openWorkers()} @commit@` });
  } catch (e) {
    byId("lesson-name").textContent = t("broken", { why: e.message });
    return;
  }
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) link.look = { playing: false, ...link.look };
  page.given = givenScene();
  await follow(link);
  byId("main").inert = false; /* until now there was no gas that controls could act on */
  runClock(drawFrame);
}

/* ---- Actions of the user ---- */

function play(yes) {
  if (yes && store.state.player && played.at >= store.state.player.frames - 1) played.at = 0;
  store.look({ playing: yes });
}
function step() {
  if (store.state.player) {
    goTo(Math.floor(played.at) + 1);
    return;
  }
  play(false);
  now.step = true;
}
function faster(by) {
  const { player, speed } = store.state,
    next = (all, one) => all[Math.min(all.length - 1, Math.max(0, all.findIndex((x) => x >= one) + by))];
  if (player) store.look({ player: { ...player, rate: next(FRAMES_A_SECOND, player.rate) } });
  else store.look({ speed: next(SPEEDS, speed) });
}
function present() {
  const yes = store.state.view !== "present";
  store.look({ view: yes ? "present" : "all" });
  const done = yes ? document.documentElement.requestFullscreen?.() : document.fullscreenElement && document.exitFullscreen();
  if (done) done.catch(() => {}); /* a page inside another may not enter full screen */
}

const on = (id, what, kind = "click") => byId(id).addEventListener(kind, what);
const KEYS = {
  " ": () => play(!store.state.playing),
  f: present,
  d: () => say(describe()),
  k: () => byId("keep").click(),
};
function listen() {
  on("play", () => play(!store.state.playing));
  on("step", step);
  on("slower", () => faster(-1));
  on("faster", () => faster(1));
  on("restart", () => (store.state.player ? goTo(0) : again()));
  for (const id of ["reseed", "another"]) on(id, () => again({ "run.seed": String(1 + Math.floor(Math.random() * 999999)) }));
  on("reverse", () => reverse().then(() => say(t("reversed"))));
  on("keep", () => {
    keepPoint();
    say(t("kept"));
  });
  on("forget", () => {
    clearKept();
    store.dispatch("forget");
  });
  for (const id of ["present", "leave"]) on(id, present);
  on("describe", () => say(describe()));
  for (const name of ["colour", "quantity", "language"]) on(name, () => store.look({ [name]: byId(name).value }), "change");
  on("chart-kind", () => store.look({ chart: byId("chart-kind").value }), "change");
  for (const name of ["images", "follow", "everything", "arrows"]) on(name, () => store.look({ [name]: byId(name).checked }), "change");
  on("sound", () => {
    if (byId("sound").checked) openSound();
    store.look({ sound: byId("sound").checked });
  }, "change");
  on("pair", () => again({}, { look: { pair: byId("pair").value } }), "change");
  on("grain-number", () => {
    const i = Math.round(byId("grain-number").value);
    store.look({ grain: i >= 1 ? i - 1 : null });
  }, "change");
  on("use-question", () => {
    const question = tidyQuestion(byId("question-text").value);
    store.look({ question, slider: byId("question-slider").value, ...(question ? { lesson: null } : {}) });
    say(question);
  });
  on("use-yaml", () => ownScene(byId("yaml").value));
  on("controls", (e) => e.preventDefault(), "submit");
  for (const button of document.querySelectorAll("[data-move]"))
    button.addEventListener("click", () => parts.view.move(...button.dataset.move.split(" ").map(Number)));
  on("camera-home", () => store.look({ camera: (lessonOf(store.state.lesson) || { camera: CAMERA }).camera }));
  listenForTaking();
  listenForFiles();
  listenForKeys();
  window.addEventListener("hashchange", () => {
    const link = readLink();
    if (link.language) store.look({ language: link.language });
    if (store.state.player) endPlaying();
    follow(link);
  });
  for (const kind of ["resize", "fullscreenchange"])
    window.addEventListener(kind, () => {
      now.fresh = !!now.frame;
    });
  document.addEventListener("fullscreenchange", () => {
    if (!document.fullscreenElement && store.state.view === "present") store.look({ view: "all" });
  });
}

/* Keys act except where the user types, or where a key has a meaning already. */
function listenForKeys() {
  document.addEventListener("keydown", (e) => {
    const typing = e.target.closest("input, textarea, select, button, summary, dialog, a");
    if (typing || e.ctrlKey || e.metaKey || e.altKey) return;
    if (e.key === "Escape" && store.state.view === "present") present();
    if (!KEYS[e.key]) return;
    KEYS[e.key]();
    e.preventDefault();
  });
}

/* ---- Saving ---- */

function listenForTaking() {
  const about = () => store.state.gas.about;
  on("save-png", () => {
    const boxes = [[parts.view, "box"], ...(byId("twin-figure").hidden ? [] : [[parts.twin, "twin"]])];
    for (const [view] of boxes) view.again();
    const ends = ["low", "high"].map((end) => byId(`scale-${end}`).textContent);
    boxPicture(boxes.map(([, id]) => byId(id)), about().title, byId("scale"), ends).toBlob((blob) => graingas.save(fileName(about(), "png"), blob));
  });
  const text = (id, ending, type, make) => on(id, () => graingas.save(fileName(about(), ending), new Blob([make()], { type })));
  text("save-svg", "svg", "image/svg+xml", () => curveSvg(byId("chart"), about().title));
  text("save-points-svg", "points.svg", "image/svg+xml", () => curveSvg(byId("points"), about().title));
  text("save-csv", "csv", "text/csv", () => curvesCsv(store.state.gas.history, store.state.means, about().title));
  text("save-yaml", "yaml", "text/yaml", () => about().yaml);
  on("save-points", () => graingas.save(`graingas-points${store.state.points.every((one) => one.from) ? "" : ownName("-")}.csv`, new Blob([pointsCsv(store.state.points)], { type: "text/csv" })));
  on("share", openSharing);
  for (const [id, kind] of [["mine", "change"], ["me", "input"]]) on(id, showLink, kind);
  on("class", () => {
    byId("gathering-said").textContent = "";
    listStudents();
    byId("gathering").showModal();
  });
  on("take-links", () => {
    const n = gather(pointsIn(byId("links").value));
    byId("gathering-said").textContent = t(n ? "gathered" : "noPointsLink", { n });
    if (n) byId("links").value = "";
    listStudents();
  });
  on("open-tables", () => byId("file").click());
  on("close-gathering", () => byId("gathering").close());
  on("close-sharing", () => byId("sharing").close());
  on("copy-link", async () => {
    byId("link").select();
    try {
      await navigator.clipboard.writeText(byId("link").value);
      byId("link-said").textContent = t("copied");
    } catch (e) {
      byId("link-said").textContent = t("copyYourself");
    }
  });
}
/* A button for each student whose points are here: it removes them. */
function listStudents() {
  const names = studentsOf(store.state.points);
  byId("students-row").hidden = !names.length;
  byId("students").replaceChildren(
    ...names.map((from) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: shownName(from, names) });
      button.addEventListener("click", () => {
        forgetStudent(from);
        listStudents();
      });
      return button;
    }),
  );
}
/* The name that labels the user's own points; nothing without one. */
const ownName = (before) => {
  const name = tidyName(byId("me").value);
  return name ? before + name.replace(/ /g, "-") : "";
};
function openSharing() {
  byId("link-said").textContent = "";
  byId("mine-row").hidden = !pointsTexts(store.state, "").length;
  byId("mine").checked = !byId("mine-row").hidden;
  showLink();
  byId("sharing").showModal();
}
/* Show a link to the experiment, or to points of it. A link to a local file does not help others: they need the
 * file, and the part of the address after #. The QR code of points has that part alone: it can be pasted. */
function showLink() {
  const here = location.protocol === "file:",
    points = byId("mine").checked ? pointsTexts(store.state, byId("me").value) : [],
    address = points.length ? linkOfPoints(store.state, points) : linkOf(store.state),
    link = location.href.split("#")[0] + address;
  byId("me-row").hidden = !byId("mine").checked || !pointsText(store.state, "");
  byId("link").value = link;
  byId("link-words").textContent = t(points.length ? (here ? "linkPointsFile" : "linkPointsWorks") : here ? "linkFile" : "linkWorks");
  byId("qr").replaceChildren(...(here && !points.length ? [] : qrSvg(here ? address : link, t("qrLabel"))));
}

/* For tests, and for users of the console. */
globalThis.graingas = { store, workers, now, parts, start, ownScene, openFile, openSharing, describe, drawFrame, linkOf, played, save };
main();
