/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of flows, by the values of a scene. */
export const WALLED = ["couette", "poiseuille", "chute", "fourier"];
export const isWalled = ({ flow }) => WALLED.includes(flow);
export const sheared = ({ flow }) => /usf|shear/.test(flow);
