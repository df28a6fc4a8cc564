/* Which theories are drawn: a box each, of those that say something here. */
function drawableTheories(means) {
  const cooling = Object.keys((means.cooling && means.cooling.T) || {});
  return [...new Set([...theoriesWith(means, ["temperature", "N1"]), ...cooling])];
}

function showTheories(means) {
  const names = ranked(drawableTheories(means)),
    first = new Set(drawnTheories(means));
  byId("theories").hidden = names.length === 0;
  const list = byId("theory-boxes");
  if (list.dataset.names !== names.join()) {
    list.dataset.names = names.join();
    list.replaceChildren(...names.map((name) => theoryBox(name, means)));
  }
  for (const box of list.querySelectorAll("input")) box.checked = first.has(box.value);
}

function theoryBox(name, means) {
  const label = document.createElement("label"),
    box = document.createElement("input");
  box.type = "checkbox";
  box.value = name;
  box.addEventListener("change", () => {
    page.drawnTheories = new Set(
      [...byId("theory-boxes").querySelectorAll("input:checked")].map((checked) => checked.value),
    );
    if (page.means) showMeans(page.means);
  });
  label.append(box, ` ${name}`, cell("small", ` ${means.theories[name].title}`));
  return label;
}
