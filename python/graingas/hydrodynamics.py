# SPDX-License-Identifier: GPL-3.0-or-later
"""Hydrodynamics at measured profiles: the stress and heat flux that closures have where a run between walls measured
density, temperature and shear rate, beside the stress and heat flux that it measured there."""
from __future__ import annotations

import numpy as np

from . import _c, tables
from .errors import BadInput, check, encode, lib
from .estimate import format_estimate
from .result import Result
from .structs import address
from .theory import theory

ffi = _c.ffi

STATE = "solid_fraction", "temperature", "shear_rate", "solid_fraction_slope", "temperature_slope"
FLUXES = "P_xx", "P_yy", "P_zz", "P_yx", "q_y", "loss"
SHOWN = "P_yx", "q_y"


class LocalFluxes:
    """Closures beside what was measured, height by height.

    y          (n,) heights, without the layers at walls
    state      arrays by name: solid_fraction, temperature, shear_rate, and the slopes along y, from measured profiles
    measured   arrays by flux: P_xx, P_yy, P_zz, P_yx, q_y; `error` likewise
    theory     by theory, then by flux; also the loss of energy per volume and time
    units      of y and of the fluxes
    """

    def __init__(self, title, y, state, measured, error, theories, units):
        self.title, self.y, self.state, self.measured, self.error = title, y, state, measured, error
        self.theory, self.units = theories, units

    def ratio(self, name: str, flux: str) -> float:
        """A theory's flux over the measured one, by least squares over all heights."""
        x, y = self.measured[flux], self.theory[name][flux]
        known = np.isfinite(x) & np.isfinite(y)
        return float((x * y)[known].sum() / (x * x)[known].sum()) if known.any() else np.nan

    def to_dataframe(self):
        """A row for each height: the state, and each flux as measured, with its error, and by each theory."""
        import pandas
        columns = {"y": self.y, **self.state}
        for flux, values in self.measured.items():
            columns.update({flux: values, f"{flux}_error": self.error[flux]})
            columns.update({f"{flux}_{name}": answers[flux] for name, answers in self.theory.items()})
        return pandas.DataFrame(columns)

    def _table(self):
        head = ["y", "phi", "T", "shear rate"]
        columns = [self.y, *(self.state[name] for name in STATE[:3])]
        columns = [list(map(tables.number, column.tolist())) for column in columns]
        for flux in SHOWN:
            head += [flux, *self.theory]
            columns.append([format_estimate(*pair) for pair in zip(self.measured[flux], self.error[flux])])
            columns += [list(map(tables.number, answers[flux].tolist())) for answers in self.theory.values()]
        ratios = ["theory / measured", "", "", ""]
        for flux in SHOWN:
            ratios += ["", *(f"{self.ratio(name, flux):.3f}" for name in self.theory)]
        return head, [*zip(*columns), ratios]

    def __repr__(self):
        return f"{self.title}\n\n" + tables.as_text(*self._table())

    def _repr_html_(self):
        return tables.as_html(self.title, *self._table())

    def plot(self, fluxes=SHOWN, axes=None):
        """Draws fluxes over the height: measured as points, theories as lines; returns the axes."""
        from .plot import plot_local_fluxes
        return plot_local_fluxes(self, fluxes, axes)


def _fit(x, values, errors, at, slabs):
    """Value and slope at a height: a parabola through the nearest points, weighted by their errors."""
    near = np.sort(np.argsort(abs(x - at), kind="stable")[:slabs])
    weight = 1 / errors[near] if np.all(errors[near] > 0) else np.ones(len(near))
    powers = np.vander(x[near] - at, 3)
    (_, slope, value), *_ = np.linalg.lstsq(powers * weight[:, None], values[near] * weight, rcond=None)
    return value, slope


def _core(result, wanted):
    """The heights without layers at walls, from the first theory that answers."""
    for name in wanted:
        curves = theory(result.scene, name).curves
        if "profile_velocity" in curves:
            numbers = curves["profile_velocity"].numbers
            return numbers["core_from"].mean, numbers["core_to"].mean
    raise BadInput(f"local_fluxes: none of the theories {', '.join(wanted)} answers for this scene, so the layers at its "
                   "walls are not known")


def _closure(scene, name, state):
    states = np.ascontiguousarray(np.column_stack([state[key] for key in STATE]))
    found = np.full((len(states), len(FLUXES)), np.nan)
    with scene.held() as pointer:
        check(lib.gg_theory_local_fluxes, pointer, encode(name, "theory"), len(states),
              address(states, "gg_local_state *"), address(found, "gg_local_fluxes *"))
    return dict(zip(FLUXES, found.T.copy()))


def local_fluxes(result, theories=("navier_stokes", "moments"), slabs: int = 9) -> LocalFluxes:
    """Stress and heat flux of closures at the profiles that a run between walls measured, beside those it measured.

    result     of a scene of one species of smooth grains between walls, with measure: [rheology, profiles, fluxes]
    theories   names of theories between walls
    slabs      neighbouring slabs through which a parabola gives density, temperature, velocity and their slopes
    Raises BadInput without such profiles, or for grains that the theories do not describe.
    """
    if not isinstance(result, Result):
        raise TypeError(f"local_fluxes: expected a Result, not {type(result).__name__}")
    theories = [theories] if isinstance(theories, str) else list(theories)
    if not {"profile_velocity", "profile_q_y"} <= set(result.curves):
        raise BadInput("local_fluxes: the run has no profiles of velocity and heat flux; add profiles and fluxes to the "
                       "scene's key measure")
    if isinstance(slabs, bool) or not isinstance(slabs, int) or slabs < 4:
        raise BadInput(f"local_fluxes: slabs: {slabs!r} is not allowed; allowed: whole numbers from 4 on")
    low, high = _core(result, theories)
    curves = {name: result.curves["profile_" + name] for name in ("solid_fraction", "temperature", "velocity", *FLUXES[:5])}
    x = curves["velocity"].x
    core = (x >= low) & (x <= high) & np.isfinite(curves["temperature"].value)
    if core.sum() < slabs:
        raise BadInput(f"local_fluxes: {core.sum()} slabs lie outside the layers at the walls, at y from {low:.3g} to "
                       f"{high:.3g}; {slabs} are needed")
    y, fits = x[core], {}
    for name in ("solid_fraction", "temperature", "velocity"):
        c = curves[name]
        fits[name] = np.array([_fit(y, c.value[core], c.error[core], at, slabs) for at in y]).T
    state = dict(zip(STATE, (fits["solid_fraction"][0], fits["temperature"][0], fits["velocity"][1],
                             fits["solid_fraction"][1], fits["temperature"][1])))
    measured = {flux: curves[flux].value[core] for flux in FLUXES[:5]}
    error = {flux: curves[flux].error[core] for flux in FLUXES[:5]}
    units = {"y": curves["velocity"].x_unit, **{flux: curves[flux].unit for flux in FLUXES[:5]}}
    found = {name: _closure(result.scene, name, state) for name in theories}
    return LocalFluxes(f"{result.scene.title}, {result.engine}: fluxes at measured profiles", y, state, measured, error,
                       found, units)
