# SPDX-License-Identifier: GPL-3.0-or-later
"""Granular gases of hard spheres: molecular dynamics, Enskog Monte Carlo and kinetic theories of one scene.

    import graingas as gg
    scene = gg.Scene("usf.yaml", e=0.8)
    c = gg.compare(scene)
    c["temperature"].md, c["temperature"].theory["lun1991"]

Numbers have the units of results (c["temperature"].unit): lengths in the diameter d and masses in the mass m of species
1; sheared flows in units of the shear rate gamma, others of the initial thermal speed v_0. Scenes have their own units.
"""
from . import _c
from . import catalogue, plot
from .cite import cite
from .comparison import Comparison, Theory
from .curves import Curve
from .errors import BadFile, BadInput, Busy, GraingasError, NotFound, PartialResult, RunFailed, text
from .estimate import Estimate
from .extension import DoesNotApply, define_law, define_observable, define_theory
from .grains import Grains
from .hydrodynamics import LocalFluxes, local_fluxes
from .live import View
from .relaxation import Relaxation, TimeSeries, relax
from .result import Result, export
from .run import compare, read, run
from .scene import Scene
from .simulation import Simulation
from .sweep import Sweep, Verdict, sweep, validate
from .theory import Grid, scan, theories, theory
from .trajectory import Trajectory, trajectory

__version__ = text(_c.lib.gg_version())

__all__ = [  # what help(graingas) shows
    "BadFile", "BadInput", "Busy", "catalogue", "cite", "compare", "Comparison", "Curve", "define_law",
    "define_observable", "define_theory", "DoesNotApply", "Estimate", "export", "GraingasError", "Grains", "Grid", "local_fluxes",
    "LocalFluxes", "NotFound", "PartialResult", "plot", "read", "relax", "Relaxation", "Result", "run", "RunFailed",
    "scan", "Scene", "Simulation", "Sweep", "sweep", "theories", "Theory", "theory", "TimeSeries", "Trajectory",
    "trajectory", "validate", "Verdict", "View",
]
