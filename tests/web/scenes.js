/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose trajectories are compared: collision models, flows, neighbour searches, kernels of dsmc. */
"use strict";
module.exports = {
  "smooth, sheared": "{flow: usf, phi: 0.3, collision: {e: 0.9}}",
  "rough, sheared": "{flow: usf, phi: 0.2, collision: {e: 0.9, beta: 0.3}}",
  "frictional, sheared": "{flow: usf, phi: 0.3, collision: {e: 0.9, beta: 0.4, mu: 0.3}}",
  dilute: "{flow: usf, phi: 0.02, collision: {e: 0.8}}",
  dense: "{flow: usf, phi: 0.45, collision: {e: 0.95}}",
  cooling: "{flow: hcs, phi: 0.1, collision: {e: 0.9}}",
  "cooling, rough": "{flow: hcs, phi: 0.1, collision: {e: 0.9, beta: -0.5}}",
  heated: "{flow: hss, phi: 0.2, collision: {e: 0.8}}",
  equilibrium: "{flow: equilibrium, phi: 0.4, particles: 500}",
  walls: "{flow: couette, phi: 0.2, collision: {e: 0.9}}",
  mixture:
    "{flow: usf, phi: 0.2, collision: {e: 0.9}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 2, mass: 8}]}",
  viscoelastic: "{flow: usf, phi: 0.2, collision: {e: 0.9, law: viscoelastic, speed: 1}}",
  "monte carlo, smooth": "{flow: usf, engine: dsmc, phi: 0.3, collision: {e: 0.9}}",
  "monte carlo, rough": "{flow: usf, engine: dsmc, phi: 0.2, collision: {e: 0.9, beta: 0.3}}",
  "monte carlo, frictional": "{flow: usf, engine: dsmc, phi: 0.3, collision: {e: 0.9, beta: 0.4, mu: 0.3}}",
  "monte carlo, cooling": "{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.9}}",
  "monte carlo, heated": "{flow: hss, engine: dsmc, phi: 0.1, collision: {e: 0.8}}",
  "monte carlo, large": "{flow: usf, engine: dsmc, phi: 0.1, collision: {e: 0.9}, dsmc: {particles: 20000}}",
  "monte carlo, Boltzmann": "{flow: usf, engine: dsmc, phi: 0, collision: {e: 0.7}}",
};
