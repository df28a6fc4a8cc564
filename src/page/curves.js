/* What is drawn beside the box: the history of the gas that is seen, the means so far, the lines of the theories. */
const MD = "#0072B2",
  DSMC = "#C44E00";
const LINES = [
  { colour: "#00785a", dash: "8 4" },
  { colour: "#8e3a9a", dash: "2 3" },
  { colour: "#555555", dash: "10 3 2 3" },
  { colour: "#8a6a00", dash: "5 5" },
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

/* Points of the past, ever fewer of the older ones: a bounded memory. Cooling gases are seen on logarithmic axes. */
class Past {
  constructor(logarithmic) {
    this.rows = [];
    this.gap = 0.02;
    this.logarithmic = logarithmic;
  }
  add(md, dsmc) {
    const of = md || dsmc,
      last = this.rows[this.rows.length - 1];
    if (
      last &&
      (this.logarithmic ? of.time < 1.03 * last.time || of.time <= 0 : of.collisionsPerGrain < last.clock + this.gap)
    )
      return;
    const pick = (s) => (s ? [s.temperature, s.rotationalTemperature] : [NaN, NaN]),
      [T, theta] = pick(md),
      [T2, theta2] = pick(dsmc);
    this.rows.push({ clock: of.collisionsPerGrain, time: of.time, T, theta, T2, theta2 });
    if (this.rows.length > 480) {
      this.rows = this.rows.filter((_, i) => i % 2 === 0);
      this.gap *= 2;
    }
  }
  column(name) {
    return this.rows.map((row) => row[name]);
  }
}

const mean = (part, name) => (part && part[name] && Number.isFinite(part[name].mean) ? part[name].mean : NaN);
const error = (part, name) => (part && part[name] && Number.isFinite(part[name].stderr) ? part[name].stderr : 0);

/* Theories with an answer to one of these quantities, the best known first. */
function theoriesWith(means, names, most = 4) {
  const all = Object.keys(means.theory || {}).filter((name) =>
    names.some((q) => Number.isFinite(mean(means.theory[name], q))),
  );
  const rank = (name) => (FIRST.indexOf(name) + FIRST.length + 1) % (FIRST.length + 1);
  return all.sort((a, b) => rank(a) - rank(b)).slice(0, most);
}
const beyondMark = (means, name) => (means.theories[name] && means.theories[name].beyond ? " †" : "");

function temperatureChart(figure, history, means, values) {
  const cooling = values.flow === "hcs",
    key = cooling ? "time" : "clock",
    x = history.column(key),
    rough = history.rows.some((r) => r.theta > 0 || r.theta2 > 0);
  const line = (name, label, colour, dash, width) => ({ x, y: history.column(name), label, colour, dash, width });
  const series = [line("T", `${t("md")}: T`, MD), line("T2", `${t("dsmc")}: T`, DSMC)];
  if (rough) series.push(line("theta", `${t("md")}: θ`, MD, "4 3"), line("theta2", `${t("dsmc")}: θ`, DSMC, "4 3"));
  if (means && x.length) series.push(...(cooling ? haffLine(means, values, x) : steadyLines(means, x, rough)));
  plot(figure, {
    title: t(rough ? "temperature" : "temperatureOnly"),
    series,
    summary: figureSummary(means, "temperature"),
    x: { label: cooling ? t("time", { unit: "d/v₀" }) : t("collisionsAGrain"), log: cooling },
    y: { log: cooling, range: cooling ? null : [0, 1.12 * highest(series)] },
  });
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
        e = error(part, name);
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
  theoriesWith(means, ["temperature"]).forEach((name, i) => {
    const about = means.theories[name],
      label = name + beyondMark(means, name),
      add = (q, quiet) => {
        const m = mean(means.theory[name], q);
        if (Number.isFinite(m))
          out.push({
            x: across,
            y: [m, m],
            ...LINES[i],
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

/* Haff's law through the theory's rate, which results count in nu = 16/5 sqrt(pi) n d^2 sqrt(T/m) (docs/theory.md). */
function haffLine(means, values, x) {
  const theory = means.theory && means.theory.haff1983,
    rate = mean(theory, "cooling_rate"),
    T0 = mean(theory, "temperature");
  if (!Number.isFinite(rate)) return [];
  const zeta = ((rate * 16) / 5) * Math.sqrt(Math.PI) * ((6 * values.phi) / Math.PI) * Math.sqrt(T0);
  return [
    {
      x,
      y: x.map((time) => T0 / (1 + (zeta * time) / 2) ** 2),
      ...LINES[0],
      width: 1.6,
      label: t("haff") + beyondMark(means, "haff1983"),
      name: "haff1983 temperature",
    },
  ];
}

function velocityChart(figure, means) {
  const series = [],
    curve = (engine, which) =>
      means[engine] && means[engine].curves && means[engine].curves[`velocity_distribution_${which}`];
  let gauss = null;
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ])
    for (const [which, dash] of [
      ["Cx", ""],
      ["Cy", "4 3"],
    ]) {
      const c = curve(engine, which);
      if (!c) continue;
      const numbers = (list) => list.map((v) => (v === null ? NaN : v));
      series.push({
        x: c.x,
        y: numbers(c.value),
        band: numbers(c.stderr).map((v) => v || 0),
        colour,
        dash,
        label: `${engine}: ${c.label.replace("_", "")}`,
        name: `velocities ${engine} ${which}`,
      });
      if (!gauss && c.reference)
        gauss = { x: c.x, y: c.reference.value, colour: "#222222", dash: "1 3", width: 2, label: t("gaussian") };
    }
  if (gauss) series.push(gauss);
  plot(figure, {
    title: t("velocities"),
    series,
    summary: t("velocities"),
    x: { label: t("velocityAxis"), range: [-5, 5] },
    y: { label: t("distributionAxis"), log: true, range: [1e-4, 2] },
  });
}

/* P_xx/p, P_yy/p and P_zz/p from the two differences. */
function stresses(part) {
  const a = mean(part, "N1"),
    b = mean(part, "N2"),
    ea = error(part, "N1"),
    eb = error(part, "N2");
  return {
    y: [1 + (2 * a + b) / 3, 1 + (b - a) / 3, 1 - (a + 2 * b) / 3],
    error: [Math.hypot(2 * ea, eb) / 3, Math.hypot(ea, eb) / 3, Math.hypot(ea, 2 * eb) / 3],
  };
}
function stressChart(figure, means) {
  const series = [],
    add = (part, at, rest) => {
      if (Number.isFinite(mean(part, "N1")))
        series.push({ x: [0, 1, 2].map((i) => i + at), points: true, ...stresses(part), ...rest });
    };
  theoriesWith(means, ["N1"]).forEach((name, i) =>
    add(means.theory[name], 0, { colour: LINES[i].colour, shape: "dash", label: name + beyondMark(means, name) }),
  );
  add(means.md && means.md.results, -0.12, { colour: MD, shape: "circle", label: t("md") });
  add(means.dsmc && means.dsmc.results, 0.12, { colour: DSMC, shape: "square", label: t("dsmc") });
  plot(figure, {
    title: t("stress"),
    series,
    summary: figureSummary(means, "N1"),
    x: { names: ["P_xx/p", "P_yy/p", "P_zz/p"], range: [-0.5, 2.5] },
    y: { range: [0, Math.max(2, 1.12 * highest(series))] },
  });
}

function figureSummary(means, name) {
  if (!means) return t("waiting");
  const parts = ["md", "dsmc"].map((engine) => [
    engine,
    withError(mean(means[engine] && means[engine].results, name), error(means[engine] && means[engine].results, name)),
  ]);
  const theories = theoriesWith(means, [name]).map((one) => [one, number(mean(means.theory[one], name))]);
  return `${name}: ${parts
    .concat(theories)
    .map(([who, what]) => `${who} ${what}`)
    .join("; ")}`;
}
