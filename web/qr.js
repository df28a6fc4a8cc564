/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A link as a QR code, big enough for the back row. By qrcode-generator (Kazuhiko Arase, MIT). */
import qrcode from "qrcode-generator";
import { make } from "./chart.js";

const LONGEST = 1200; /* characters: more cannot be read from a screen */

/* A list with one drawing, or an empty one if the text is too long. */
export function qrSvg(text, label) {
  if (!qrcode || text.length > LONGEST) return []; /* null: built without it */
  const code = qrcode(0, "L");
  code.addData(text);
  code.make();
  const n = code.getModuleCount(),
    path = [];
  for (let y = 0; y < n; y++) for (let x = 0; x < n; x++) if (code.isDark(y, x)) path.push(`M${x} ${y}h1v1h-1z`);
  return [
    make(
      "svg",
      { viewBox: `-4 -4 ${n + 8} ${n + 8}`, role: "img", "aria-label": label },
      make("rect", { x: -4, y: -4, width: n + 8, height: n + 8, fill: "#fff" }),
      make("path", { d: path.join(""), fill: "#000" }),
    ),
  ];
}
