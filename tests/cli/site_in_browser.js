// SPDX-License-Identifier: GPL-3.0-or-later
/* Open pages of the site in headless Chromium, from the disk: node site_in_browser.js FILE... prints a line of JSON for
 * each page with what a reader would see. */
"use strict";
const { Browser } = require("../web/chromium.js");

/* Messages of the console, failed loads, what scrolls sideways, where the contents are, and the theme after a click. */
const SEEN = `(() => {
  const toc = document.querySelector(".toc-drawer .toc-tree, .toc-tree"), at = toc && toc.getBoundingClientRect(), before = document.body.dataset.theme;
  const button = [...document.querySelectorAll(".theme-toggle")].find((one) => one.offsetWidth > 0);
  if (button) button.click();
  return { margin: getComputedStyle(document.body).margin, wide: document.documentElement.scrollWidth, window: innerWidth,
    contents: at ? [at.left, at.right] : null, theme: [before, document.body.dataset.theme] };
})()`;

async function main(files) {
  const browser = new Browser(),
    failed = [];
  browser.listeners.push((m) => m.method === "Network.loadingFailed" && !m.params.canceled && failed.push(m.params.errorText));
  for (const file of files) {
    const tab = await browser.open(file, { width: 1366 });
    await tab.until("document.readyState === 'complete'", 60);
    await new Promise((r) => setTimeout(r, 500)); /* messages of scripts that load late */
    const said = [...tab.said], /* the theme names its mode after the click */
      seen = await tab.value(SEEN);
    if (process.env.PICTURES) await tab.picture(`${process.env.PICTURES}/${file.replace(/.*html\/|\.html$/g, "").replace(/\//g, "_")}.png`);
    console.log(JSON.stringify({ file, said, failed: failed.splice(0), elsewhere: tab.fetched.filter((url) => !/^(file|data):/.test(url)), ...seen }));
    await tab.close();
  }
  await browser.close();
}
main(process.argv.slice(2)).catch((e) => {
  console.error(e);
  process.exit(1);
});
