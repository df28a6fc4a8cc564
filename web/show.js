/* Where the answers of the workers are shown: clock, curves, table, words; and the lessons. */
const sheared = () => /usf|shear/.test(page.about.values.flow);
const hasRate = () => sheared() || page.about.values.flow === "couette";
const timeUnit = () => (hasRate() ? "1/γ" : page.about.values.phi === 0 ? "1/(n d² v₀)" : "d/v₀");

function showClock(s) {
  byId("clock").textContent =
    t("clock", {
      c: s.collisionsPerGrain.toFixed(s.collisionsPerGrain < 100 ? 2 : 0),
      t: number(s.time),
      unit: timeUnit(),
      n: s.collisions,
    }) + (sheared() ? t("clockStrain", { s: s.strain.toFixed(2) }) : "");
}

function showEvent(event) {
  byId("event").textContent = event
    ? t("event", {
        a: event.grain[0] + 1,
        b: event.grain[1] + 1,
        g: number(event.normalSpeed, 3),
        unit: hasRate() ? "d γ" : "v₀",
        k: event.k.map((x) => x.toFixed(2)).join(", "),
      })
    : "";
}

function showCharts() {
  temperatureChart(byId("chart-temperature"), page.history, page.means, page.about.values);
  showWarnings();
}

function showMeans(means) {
  page.means = means;
  velocityChart(byId("chart-velocities"), means);
  stressChart(byId("chart-stress"), means);
  fillTable(byId("table"), means, byId("everything").checked);
  fillRanges(byId("ranges"), means);
  showTheories(means);
  const phase = (engine) => {
    const p = means.progress[engine];
    if (!p) return t("phaseNone");
    return p.over ? t("phaseDone") : t(p.averaging ? "phaseAverage" : "phaseWarm", { p: Math.floor(100 * p.fraction) });
  };
  byId("progress").textContent = page.player
    ? t("progressStored", { name: page.player.name })
    : t("progress", { md: phase("md"), dsmc: phase("dsmc") });
  page.changed = true;
}

/* Nothing is known of this gas: what was of another goes. */
function clearMeans() {
  velocityChart(byId("chart-velocities"), {});
  stressChart(byId("chart-stress"), {});
  byId("table").tBodies[0].replaceChildren();
  byId("ranges").replaceChildren();
  byId("theories").hidden = true;
}

const whichFrame = () => ({ k: Math.max(0, page.player.shown) + 1, n: page.player.frames });

/* For those who hear the page: every few seconds what it shows. */
function say() {
  const s = page.frame.md || page.frame.dsmc,
    means = page.means,
    of = (engine) => means[engine] && means[engine].results;
  const both =
    means && Number.isFinite(mean(of("md"), "temperature"))
      ? t("summaryMeans", {
          md: withError(mean(of("md"), "temperature"), error(of("md"), "temperature")),
          dsmc: withError(mean(of("dsmc"), "temperature"), error(of("dsmc"), "temperature")),
        })
      : "";
  byId("summary").textContent = t("summary", {
    title: page.player
      ? t("summaryPlayed", { name: page.player.name, title: page.about.title, ...whichFrame() })
      : page.about.title,
    c: number(s.collisionsPerGrain, 3),
    T: number(s.temperature),
    theta: s.rotationalTemperature > 0 ? t("summaryTheta", { theta: number(s.rotationalTemperature) }) : "",
    means: both,
  });
  byId("box").setAttribute("aria-label", t("boxLabel", { n: s.grains, by: t(`${byId("colour").value}Of`) }));
}

function showScale() {
  const to = byId("scale").getContext("2d");
  for (let i = 0; i < 120; i++) {
    to.fillStyle = rgb(colourAt(i / 119));
    to.fillRect(i, 0, 1, 10);
  }
  byId("scale-text").textContent = t(`scale_${byId("colour").value}`);
}

function showPlaying() {
  const [speed, all] = page.player ? [page.player.rate, FRAMES_A_SECOND] : [page.speed, SPEEDS];
  byId("play").textContent = t(page.playing ? "pause" : "play");
  byId("speed").textContent = t(page.player ? "frameRate" : "speed", { x: speed });
  byId("slower").disabled = speed <= all[0];
  byId("faster").disabled = speed >= all[all.length - 1];
  byId("step").textContent = t(page.player ? "nextFrame" : "step");
  byId("restart").textContent = t(page.player ? "firstFrame" : "restart");
  byId("reseed").hidden = !!page.player;
  if (!page.player && byId("player").contains(document.activeElement)) byId("play").focus(); /* who pressed goes on */
  byId("player").hidden = !page.player;
  byId("colour").querySelector("[value=since]").disabled = !!page.player;
}

function showLanguage() {
  document.documentElement.lang = LANGUAGES[language];
  byId("language").value = LANGUAGES[language];
  for (const one of document.querySelectorAll("[data-t]")) one.textContent = t(one.dataset.t);
  for (const one of document.querySelectorAll("[data-label]")) one.setAttribute("aria-label", t(one.dataset.label));
  byId("transport").setAttribute("aria-label", t("transport"));
  byId("box").setAttribute("aria-label", t("view"));
  page.controls.name();
  showLesson();
  showScale();
  showPlaying();
  if (page.player) byId("frame-number").textContent = t("frameOf", whichFrame());
  if (page.about) {
    page.controls.show(page.about.values);
    page.shownWarnings = null;
    showCharts();
    if (!page.player) writeUrlState(page); /* the address is of the gas that waits */
  }
  if (page.means) showMeans(page.means);
  if (page.frame) say();
}

/* ---- Lessons ---- */

function lessonButtons() {
  for (const lesson of LESSONS) {
    const button = cell("button", "", { type: "button", id: `lesson-${lesson.name}` });
    button.addEventListener("click", () => follow({ scene: null, sets: {}, lesson: lesson.name }));
    byId("lesson-buttons").append(button);
  }
}
function takeLook(lesson) {
  page.speed = SPEEDS.reduce((best, one) =>
    Math.abs(Math.log(one / lesson.speed)) < Math.abs(Math.log(best / lesson.speed)) ? one : best,
  );
  byId("colour").value = lesson.colour;
  showScale();
  showPlaying();
}
function showLesson() {
  for (const [i, lesson] of LESSONS.entries()) {
    const button = byId(`lesson-${lesson.name}`),
      now = page.lesson === lesson.name;
    button.textContent = `${i + 1}. ${lesson.title[language]}`;
    button.setAttribute("aria-pressed", String(now));
    if (!now) continue;
    const [text, question] = byId("lesson-text").children;
    text.textContent = lesson.text[language];
    question.textContent = lesson.question[language];
  }
  byId("lesson-text").hidden = !page.lesson;
}
