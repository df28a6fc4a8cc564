/* What is drawn beside the box: the history of the gas that is seen, the means so far, the lines of the theories. */
const MD = "#0072B2",
  DSMC = "#C44E00";
const LINES = [
  { colour: "#00785a", dash: "8 4" },
  { colour: "#8e3a9a", dash: "2 3" },
  { colour: "#555555", dash: "10 3 2 3" },
  { colour: "#8a6a00", dash: "5 5" },
  { colour: "#a3004c", dash: "12 2" },
  { colour: "#2f6f00", dash: "1 4" },
  { colour: "#004c6d", dash: "6 2 1 2 1 2" },
  { colour: "#6b4a3a", dash: "3 6" },
];
/* Which theories are drawn first where there are many. */
const FIRST = [
  "enskog_hermite",
  "gaussian_closure",
  "lun1991",
  "haff1983",
  "huthmann_zippelius1997",
  "garzo_dufty1999",
  "enskog",
  "sela_goldhirsch1998",
  "grad",
];

const COURSES = [
  ["T", "md_temperature"],
  ["theta", "md_rotational_temperature"],
  ["T2", "dsmc_temperature"],
  ["theta2", "dsmc_rotational_temperature"],
];

const mean = (part, name) => (part && part[name] && Number.isFinite(part[name].mean) ? part[name].mean : NaN);
const error = (part, name) => (part && part[name] && Number.isFinite(part[name].stderr) ? part[name].stderr : NaN);

/* Theories with an answer to one of these quantities, the best known first. */
function theoriesWith(means, names) {
  return ranked(
    Object.keys(means.theory || {}).filter((name) => names.some((q) => Number.isFinite(mean(means.theory[name], q)))),
  );
}
function ranked(names) {
  const rank = (name) => (FIRST.indexOf(name) + FIRST.length + 1) % (FIRST.length + 1);
  return [...names].sort((a, b) => rank(a) - rank(b));
}
/* Of those, the ones that are drawn: the first four, or what the student has chosen. */
function chosenTheories(means, names) {
  const all = ranked(names);
  return page.drawnTheories ? all.filter((name) => page.drawnTheories.has(name)) : all.slice(0, 4);
}
/* All that any diagram draws; and how: a theory looks the same in each of them. */
function drawnTheories(means) {
  const cooling = Object.keys((means.cooling && means.cooling.T) || {});
  return ranked([
    ...new Set(
      [theoriesWith(means, ["temperature"]), theoriesWith(means, ["N1"]), cooling].flatMap((names) =>
        chosenTheories(means, names),
      ),
    ),
  ]);
}
const placeOf = (means, name) => drawnTheories(means).indexOf(name);
const lineOf = (means, name) => LINES[placeOf(means, name) % LINES.length];
const MARKS = ["dash", "cross", "plus"];
const beyondMark = (means, name) => (means.theories[name] && means.theories[name].beyond ? " †" : "");

function temperatureChart(figure, history, means, values) {
  const cooling = values.flow === "hcs",
    rough = ["theta", "theta2"].some((name) => history.course(name).y.some((y) => y > 0));
  const line = (name, label, colour, dash) => ({ ...history.course(name), label, colour, dash });
  const drawn = [line("T", `${t("md")}: T`, MD), line("T2", `${t("dsmc")}: T`, DSMC)];
  if (rough) drawn.push(line("theta", `${t("md")}: θ`, MD, "4 3"), line("theta2", `${t("dsmc")}: θ`, DSMC, "4 3"));
  const series = drawn.filter((one) => one.x.length || history instanceof TemperatureHistory),
    x = series.flatMap((one) => one.x).sort((a, b) => a - b);
  if (means && x.length) series.push(...(cooling ? coolingLines(means, x) : steadyLines(means, x, rough)));
  if (history.now > 0) series.push(nowLine(history.now, series));
  plot(figure, {
    title: t(rough ? "temperature" : "temperatureOnly"),
    series,
    summary: figureSummary(means, "temperature"),
    x: { label: history.key === "time" ? t("time", { unit: timeUnit() }) : t("collisionsAGrain"), log: cooling },
    y: { log: cooling, range: cooling ? null : [0, 1.12 * highest(series)] },
  });
}
/* Where a result that is played stands. */
function nowLine(now, series) {
  const good = series.flatMap((s) => s.y).filter(inLog),
    y = good.length ? [Math.min(...good), Math.max(...good)] : [0, 1];
  return { x: [now, now], y, colour: "#222222", dash: "2 3", width: 1.5, label: t("playedNow"), name: "now" };
}
function highest(series) {
  const all = series.flatMap((s) => Array.from(s.y)).filter(Number.isFinite);
  return all.length ? Math.max(...all) || 1 : 1;
}

/* Of a steady flow: means with their errors as bands, theories as lines across. */
function steadyLines(means, x, rough) {
  const across = [x[0], Math.max(x[x.length - 1], x[0] + 0.1)],
    out = [];
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ])
    for (const name of rough ? ["temperature", "rotational_temperature"] : ["temperature"]) {
      const part = means[engine] && means[engine].results,
        m = mean(part, name),
        e = error(part, name) || 0;
      if (Number.isFinite(m))
        out.push({
          x: across,
          y: [m, m],
          band: [e, e],
          colour,
          width: 1,
          name: `mean ${engine} ${name}`,
          label: t("meanOf", { name: engine }),
          quiet: name !== "temperature",
        });
    }
  chosenTheories(means, theoriesWith(means, ["temperature"])).forEach((name) => {
    const about = means.theories[name],
      label = name + beyondMark(means, name),
      add = (q, quiet) => {
        const m = mean(means.theory[name], q);
        if (Number.isFinite(m))
          out.push({
            x: across,
            y: [m, m],
            ...lineOf(means, name),
            width: 1.6,
            label,
            title: about.title,
            quiet,
            name: `${name} ${q}`,
          });
      };
    add("temperature", false);
    if (rough) add("rotational_temperature", true);
  });
  return out;
}

/* Of a line on logarithmic axes the part between two x, with its end there. */
function pieceOf(x, y, from, to) {
  const end = x.findIndex((one) => one > to),
    inside = x.map((_, i) => i).filter((i) => x[i] >= from && x[i] <= to),
    piece = { x: inside.map((i) => x[i]), y: inside.map((i) => y[i]) };
  if (end < 1 || !(y[end] > 0)) return piece;
  const part = Math.log(to / x[end - 1]) / Math.log(x[end] / x[end - 1]);
  piece.x.push(to);
  piece.y.push(y[end - 1] * (y[end] / y[end - 1]) ** part);
  return piece;
}

/* Theories of free cooling, each with its own rate, as far as the gas has come. */
function coolingLines(means, x) {
  const { time, T } = means.cooling,
    shown = x.filter(inLog);
  return chosenTheories(means, Object.keys(T)).map((name) => ({
    ...pieceOf(time, T[name], shown[0] / 1.3, shown[shown.length - 1] * 1.3),
    ...lineOf(means, name),
    width: 1.6,
    label: (name === "haff1983" ? t("haff") : name) + beyondMark(means, name),
    title: means.theories[name].title,
    name: `${name} temperature`,
  }));
}

function velocityChart(figure, means) {
  const series = [],
    /* Cx and Cy, of mixtures those of each species */
    curves = (engine) =>
      Object.entries((means[engine] && means[engine].curves) || {})
        .map(([name, c]) => [c, /^velocity_distribution_(C([xy])(?:_(\d+))?)$/.exec(name)])
        .filter(([, found]) => found);
  let gauss = null;
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ])
    for (const [c, [, which, axis, species]] of curves(engine)) {
      const numbers = (list) => list.map((v) => (v === null ? NaN : v));
      series.push({
        x: c.x,
        y: numbers(c.value),
        band: numbers(c.stderr).map((v) => v || 0),
        colour,
        dash: axis === "x" ? "" : "4 3",
        width: species > 1 ? 1 : 2,
        label: `${engine}: ${c.label.replace(/[_{}]/g, "")}`,
        name: `velocities ${engine} ${which}`,
      });
      if (!gauss && c.reference)
        gauss = { x: c.x, y: c.reference.value, colour: "#222222", dash: "1 3", width: 2, label: t("gaussian") };
    }
  if (gauss) series.push(gauss);
  const measured = [means.md, means.dsmc].some((part) => part && Number.isFinite(mean(part.results, "N1")));
  figure.hidden = !series.length && (measured || !!means.stored); /* not here: between walls it depends on the place */
  plot(figure, {
    title: t("velocities"),
    series,
    summary: t("velocities"),
    x: { label: t("velocityAxis"), range: [-5, 5] },
    y: { label: t("distributionAxis"), log: true, range: [1e-4, 2] },
  });
}

/* N1 and N2, as they are measured and said. */
function stressChart(figure, means) {
  const series = [],
    names = ["N1", "N2"],
    add = (part, at, rest) => {
      if (Number.isFinite(mean(part, "N1")))
        series.push({
          x: names.map((_, i) => i + at),
          y: names.map((name) => mean(part, name)),
          error: names.map((name) => error(part, name)),
          points: true,
          ...rest,
        });
    };
  const theories = chosenTheories(means, theoriesWith(means, ["N1"]));
  theories.forEach((name, i) =>
    add(means.theory[name], (0.36 * (i + 0.5)) / theories.length - 0.18, {
      colour: lineOf(means, name).colour,
      shape: MARKS[placeOf(means, name) % MARKS.length],
      label: name + beyondMark(means, name),
    }),
  );
  add(means.md && means.md.results, -0.26, { colour: MD, shape: "circle", label: t("md") });
  add(means.dsmc && means.dsmc.results, 0.26, { colour: DSMC, shape: "square", label: t("dsmc") });
  const all = series.flatMap((s) => s.y).filter(Number.isFinite);
  plot(figure, {
    title: t("stress"),
    series,
    summary: `${figureSummary(means, "N1")}. ${figureSummary(means, "N2")}`,
    x: { names: ["N1 = (P_xx − P_yy)/p", "N2 = (P_yy − P_zz)/p"], range: [-0.5, 1.5] },
    y: { range: [Math.min(-0.1, 1.2 * Math.min(0, ...all)), Math.max(0.5, 1.2 * Math.max(0, ...all))] },
  });
}

function figureSummary(means, name) {
  if (!means) return t("waiting");
  const parts = ["md", "dsmc"].map((engine) => [
    engine,
    withError(mean(means[engine] && means[engine].results, name), error(means[engine] && means[engine].results, name)),
  ]);
  const theories = chosenTheories(means, theoriesWith(means, [name])).map((one) => [one, number(mean(means.theory[one], name))]);
  return `${name}: ${parts
    .concat(theories)
    .map(([who, what]) => `${who} ${what}`)
    .join("; ")}`;
}
