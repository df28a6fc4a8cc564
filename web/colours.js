/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours: of grains by a value from 0 to 1, of curves. */
export const DARK = [16, 21, 26];

/* Blue over red to yellow, of growing brightness and so distinguishable without colours (after plasma), on a dark
 * ground; and from violet over light grey to green, for values with two signs: blue and orange are the engines'. */
const MAPS = {
  rising: [
    [76, 84, 232],
    [146, 70, 205],
    [220, 84, 140],
    [250, 150, 74],
    [255, 238, 90],
  ],
  sided: [
    [170, 80, 215],
    [195, 155, 225],
    [225, 228, 230],
    [130, 205, 140],
    [40, 165, 75],
  ],
};
export const mapOf = (by) => (by === "along" || by === "origin" ? "sided" : "rising");

export function colourAt(x, map = "rising") {
  const colours = MAPS[map],
    at = Math.min(Math.max(x, 0), 1) * (colours.length - 1),
    i = Math.min(Math.floor(at), colours.length - 2),
    f = at - i;
  return colours[i].map((c, k) => Math.round(c + f * (colours[i + 1][k] - c)));
}
export const rgb = (c) => `rgb(${c.join(",")})`;

export const MD = "#0072B2",
  DSMC = "#C44E00",
  GHOSTS = ["#8aa4b8", "#a9b6c0", "#c4ccd2"];
/* Colours of the students of a class; their number and that of the marks have no common factor: 42 pairs. */
export const CLASS = ["#00797d", "#b5179e", "#5a6e00", "#5b3fd6", "#8c2f1b", "#2b2d42"];
/* Colours of theories, in the order in which they are drawn. */
export const LINES = [
  { colour: "#00785a", dash: "8 4" },
  { colour: "#8e3a9a", dash: "2 3" },
  { colour: "#555555", dash: "10 3 2 3" },
  { colour: "#8a6a00", dash: "5 5" },
  { colour: "#a3004c", dash: "12 2" },
  { colour: "#2f6f00", dash: "1 4" },
  { colour: "#004c6d", dash: "6 2 1 2 1 2" },
  { colour: "#6b4a3a", dash: "3 6" },
];
