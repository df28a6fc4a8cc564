/* What can be taken along: the picture, the curves, the scene. */
function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  document.getElementById("taken").textContent = t("saved", { name });
}

/* One row a point: which curve, x, value, error (empty: none). */
function curvesCsv(history, means, title) {
  const rows = [["curve", "x_name", "x", "value", "error"]],
    add = (...row) => rows.push(row);
  const axis = history.key === "time" ? "time" : "collisions_per_grain";
  for (const [column, name] of COURSES) {
    const { x, y } = history.course(column);
    x.forEach((at, i) => {
      if (Number.isFinite(y[i])) add(name, axis, at, y[i], "");
    });
  }
  for (const row of history.rows || []) add("time", "collisions_per_grain", row.clock, row.time, "");
  for (const engine of ["md", "dsmc"])
    for (const [name, c] of Object.entries((means && means[engine] && means[engine].curves) || {}))
      c.x.forEach((x, i) => {
        if (c.value[i] !== null)
          add(`${engine}_${name}`, c.x_name, x, c.value[i], c.stderr[i] === null ? "" : c.stderr[i]);
      });
  return `# ${title}\n${rows.map((row) => row.map((one) => (/[",\n]/.test(one) ? `"${String(one).replace(/"/g, '""')}"` : one)).join(",")).join("\n")}\n`;
}
