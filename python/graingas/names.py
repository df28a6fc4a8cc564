# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of the keys of scenes and names of quantities, for editors and type checkers. Written by scripts/make-names."""
from __future__ import annotations

from typing import Any, Literal, TypedDict, Union

Quantity = Literal[
    "temperature", "rotational_temperature", "temperature_ratio", "spin_z", "pressure", "compressibility_factor",
    "shear_viscosity", "N1", "N2", "P_xx", "P_yy", "P_zz", "P_xy", "P_yx", "P_xx_kinetic", "P_yy_kinetic",
    "P_zz_kinetic", "P_xy_kinetic", "P_yx_kinetic", "P_xx_collisional", "P_yy_collisional", "P_zz_collisional",
    "P_xy_collisional", "P_yx_collisional", "collision_rate", "mean_free_path", "knudsen", "cos2_psi", "a11", "b",
    "kurtosis_Cx", "kurtosis_Cy", "kurtosis_Cz", "kurtosis_Wx", "kurtosis_Wy", "kurtosis_Wz", "skewness_Wz",
    "dissipation", "wall_dissipation", "wall_heat_flux", "wall_friction", "energy_balance", "cooling_rate", "a2", "c_1",
    "c_2", "temperature_1", "temperature_2", "partial_temperature_ratio", "viscosity_reduced",
    "viscosity_reduced_kinetic", "thermal_conductivity_reduced", "thermal_conductivity_reduced_kinetic",
    "diffusive_heat_conductivity_reduced", "bulk_viscosity_reduced", "cooling_rate_transport",
    "rotational_conductivity_reduced", "rotational_diffusive_conductivity_reduced", "thermal_conductivity",
    "thermal_conductivity_cross", "rotational_conductivity_cross", "rotational_conductivity", "bulk_viscosity",
    "rotational_viscosity", "diffusion_reduced", "pressure_diffusion_reduced", "thermal_diffusion_reduced",
    "density_waves", "momentum_waves", "clustering_length", "heat_mode_length", "relaxation_rate"
]

Flow = Literal[
    "equilibrium", "usf", "hcs", "hss", "couette", "poiseuille", "chute", "small_shear", "heated_shear", "fourier"
]

TheoryName = Literal[
    "lun1991", "lun1991_lun_savage", "enskog_hermite", "gaussian_closure", "saha_alam2016", "jenkins_zhang2002",
    "vescovi2014", "chialvo_sundaresan2013", "grad", "sela_goldhirsch1998", "huthmann_zippelius1997",
    "kremer_santos_garzo2014", "haff1983", "goldhirsch_zanetti1993", "garzo_dufty1999", "montanero_santos2000",
    "garzo_santos_montanero2007", "chamorro_vega_garzo2013", "garzo_montanero2003", "garzo_montanero2003_ms",
    "garzo_dufty2002", "garzo_dufty_hrenya2007", "enskog", "navier_stokes", "navier_stokes_hermite", "moments",
    "carnahan_starling1969", "kolafa2004", "pieprzyk2019"
]


class BathKeys:
    """The keys below `bath`."""

    drag: float  # drag coefficient: velocities relative to the imposed flow decay at this rate
    temperature: float  # temperature that the bath alone would give; 0: drag alone, which needs shear
    rotation: float  # drag of spins over that of velocities, at the same temperature; 0: none; 10/3: Stokes drag of a sphere


class CollisionKeys:
    """The keys below `collision`."""

    e: Union[float, dict]  # coefficient of normal restitution; in equilibrium the default is 1; a formula or table may exceed 1
    beta: Union[float, dict]  # coefficient of tangential restitution: -1 smooth, 1 perfectly rough; with finite mu, of sticking contacts
    mu: Union[float, dict]  # Coulomb friction coefficient; inf: beta is constant
    normal_kick: Union[float, dict]  # D of kicks at contact: two grains part with the relative normal velocity e g_n + 2 D
    tangential_kick: Union[float, dict]  # D_t of kicks at contact: the surface of grain 1 gets 2 D_t k x z against that of grain 2, k from 1 to 2; above 0 the pair turns about z by the right hand
    law: str  # dependence of e on the normal speed of a collision between grains
    speed: Union[float, str]  # normal speed at which collision.e holds; auto: the unit of velocity of results


class DsmcKeys:
    """The keys below `dsmc`."""

    time_step: Union[float, str]  # time step of the Monte Carlo engine
    particles: Union[int, str]  # size of the Monte Carlo ensemble; auto: particles, at least 5000, and finite-size bias below a quarter of run.relative_error, between walls half
    precision: str  # precision of stored velocities and spins in dsmc; sums are always double


class MdKeys:
    """The keys below `md`."""

    contact_time: Union[float, str]  # collisions of a grain closer in time than this lose no normal energy, against inelastic collapse; 0: off; auto: 1e-5, tenfold up to 1e-3 where grains collapse nevertheless; with gravity along y 1e-3 sqrt(d/g)


class OutputKeys:
    """The keys below `output`."""

    checkpoint_every: float  # wall-clock time between checkpoints; 0: none
    state: str  # checkpoint at the end of a finished run
    trajectory_every: float  # interval between stored frames; 0: only the last state
    after: str  # first frame that is stored
    fields: Union[str, list[str]]  # what frames in the result file hold of every grain; velocity is always among it
    precision: str  # precision of the frames in the result file; means, curves and checkpoints are always double
    log: str  # file to which a run appends a row for each sample of its first replica: time, collisions, headline quantities and their means so far; beside the result, unless its path is absolute


class RunKeys:
    """The keys below `run`."""

    relative_error: Union[float, str]  # stop when every headline quantity has this relative standard error; auto: 0.01, or no such test if run.collisions or run.until is given
    until: Union[dict, None]  # stop when each of these quantities has its relative standard error: {N1: 0.01, temperature: 0.002}; headline quantities that are not named keep run.relative_error, if it is given
    collisions: Union[float, None]  # stop after this length of averaging; a gas cooling with a restitution law has 400 by default
    time_limit: Union[float, None]  # wall-clock limit, counted from the first start; to continue, resume with a larger limit
    duration: Union[float, None]  # follow the gas from its start for this time, without warm-up: curves in time are means over replicas, and values those at the end
    warmup: Union[float, str]  # length of the warm-up; auto: until the slowest quantity is steady
    replicas: int  # number of independent copies to average over; 8 by default if run.duration is given
    seed: int  # seed of the random streams; the same seed gives the same run


class StartKeys:
    """The keys below `start`."""

    temperature: Union[float, str]  # initial temperature, <m C.C>/3; auto: near the steady state, and where the gas keeps or loses its initial temperature the one that makes v_0 a diameter per unit of time
    rotational_temperature: Union[float, str]  # initial rotational temperature; auto: near the steady state
    a2: float  # initial fourth cumulant of the velocities: C^2 has the gamma distribution of shape 0.6/(0.4 + a2)
    spin: Union[float, str]  # initial mean angular velocity along z; auto: -shear_rate/2 under shear, else 0
    wave: float  # amplitude of a transverse wave u_x = wave v_0 sin(2 pi y/L_y), v_0 = sqrt(2 T/m): shear_wave measures its decay; the box is then long enough along y, unless aspect is given
    positions: str  # initial positions: random, a face-centred lattice (fcc), or those of a file in the scene's unit of length, without overlaps; its path is relative to the scene's file, and only a start reads it


class WallsKeys:
    """The keys below `walls`."""

    e: float  # coefficient of normal restitution at walls
    beta: float  # coefficient of tangential restitution at walls; smooth grains do not spin: theirs applies to the centre
    mu: float  # Coulomb friction coefficient at walls
    temperature: Union[Union[float, list[float]], None]  # temperature of the walls, of both or [lower, upper]: grains that touch leave with velocities and spins of a gas of it; none: by walls.e, beta and mu
    accommodation: float  # share of contacts in which a wall of a given temperature does so; the others are by walls.e, beta and mu
    top: str  # upper boundary of a chute
    speed: float  # speed of moving walls: +speed at +L_y/2, -speed at -L_y/2
    ridges: float  # diameter of half cylinders across the flow on resting walls, adjusted so that a whole number fits; 0: flat


class SceneKeys:
    """The keys of a scene as attributes."""

    flow: str  # flow to simulate; required
    engine: str  # engine of `graingas run`; `graingas compare` runs both
    thermostat: str  # thermostat that supplies energy
    gaussian_rate: Union[float, str]  # rate zeta_0 of the Gaussian thermostat, dT/dt = zeta_0 T; auto: that of the energy lost in collisions
    noise_strength: Union[float, str]  # xi^2 of white noise: variance that each component of a velocity gains per time; auto: balances the losses at the initial temperature
    contact_value: str  # formula for the pair correlation at contact
    phi: float  # solid fraction; required; 0 is the Boltzmann limit (dsmc only)
    particles: int  # number of grains in the box; by default fewer, from 500 on, where a box of 1000 that cools or has the Gaussian thermostat would not stay homogeneous
    shear_rate: Any  # imposed shear rate: above 0; with run.duration also 0, below 0, or a formula of the time t, "sin(2*pi*t/10)", whose mean in each of shear_steps steps is imposed
    shear_steps: int  # number of equal steps of constant shear rate, at whose ends the gas is sampled: in shear_period, or in run.duration
    shear_period: Union[float, None]  # period of the formula; run.duration has a whole number of them, two or more: of the later half amplitudes and phases of stress and temperature are computed
    aspect: list[float]  # shape of the box: ratio of its edges x : y : z
    species: list[dict]  # species of the mixture, up to 16
    gravity: list[float]  # body force per mass; poiseuille and chute have defaults of their own
    protocol: list[dict]  # what changes on the way, at times from the start: [{at: 5, bath.temperature: 2}]; keys: collision.*, bath.*, thermostat, gaussian_rate, noise_strength, shear_rate
    measure: Union[str, list[str]]  # observables to measure; unlisted ones cost nothing
    frame: str  # what peculiar velocities and spins are relative to, in means and distributions
    frame_cells: int  # cells along each edge of the box, or slabs along y; at least 4 grains in each
    local_densities: Any  # solid fractions of the cells of local_distributions, each within a tenth; auto: 0.5, 0.75, 1, 1.25, 1.5 times phi
    bath: BathKeys
    collision: CollisionKeys
    dsmc: DsmcKeys
    md: MdKeys
    output: OutputKeys
    run: RunKeys
    start: StartKeys
    walls: WallsKeys
    drag: float  # drag coefficient: velocities relative to the imposed flow decay at this rate
    rotation: float  # drag of spins over that of velocities, at the same temperature; 0: none; 10/3: Stokes drag of a sphere
    rotational_temperature: Union[float, str]  # initial rotational temperature; auto: near the steady state
    a2: float  # initial fourth cumulant of the velocities: C^2 has the gamma distribution of shape 0.6/(0.4 + a2)
    spin: Union[float, str]  # initial mean angular velocity along z; auto: -shear_rate/2 under shear, else 0
    wave: float  # amplitude of a transverse wave u_x = wave v_0 sin(2 pi y/L_y), v_0 = sqrt(2 T/m): shear_wave measures its decay; the box is then long enough along y, unless aspect is given
    positions: str  # initial positions: random, a face-centred lattice (fcc), or those of a file in the scene's unit of length, without overlaps; its path is relative to the scene's file, and only a start reads it
    normal_kick: Union[float, dict]  # D of kicks at contact: two grains part with the relative normal velocity e g_n + 2 D
    tangential_kick: Union[float, dict]  # D_t of kicks at contact: the surface of grain 1 gets 2 D_t k x z against that of grain 2, k from 1 to 2; above 0 the pair turns about z by the right hand
    law: str  # dependence of e on the normal speed of a collision between grains
    accommodation: float  # share of contacts in which a wall of a given temperature does so; the others are by walls.e, beta and mu
    top: str  # upper boundary of a chute
    ridges: float  # diameter of half cylinders across the flow on resting walls, adjusted so that a whole number fits; 0: flat
    relative_error: Union[float, str]  # stop when every headline quantity has this relative standard error; auto: 0.01, or no such test if run.collisions or run.until is given
    until: Union[dict, None]  # stop when each of these quantities has its relative standard error: {N1: 0.01, temperature: 0.002}; headline quantities that are not named keep run.relative_error, if it is given
    collisions: Union[float, None]  # stop after this length of averaging; a gas cooling with a restitution law has 400 by default
    time_limit: Union[float, None]  # wall-clock limit, counted from the first start; to continue, resume with a larger limit
    duration: Union[float, None]  # follow the gas from its start for this time, without warm-up: curves in time are means over replicas, and values those at the end
    warmup: Union[float, str]  # length of the warm-up; auto: until the slowest quantity is steady
    replicas: int  # number of independent copies to average over; 8 by default if run.duration is given
    seed: int  # seed of the random streams; the same seed gives the same run
    contact_time: Union[float, str]  # collisions of a grain closer in time than this lose no normal energy, against inelastic collapse; 0: off; auto: 1e-5, tenfold up to 1e-3 where grains collapse nevertheless; with gravity along y 1e-3 sqrt(d/g)
    time_step: Union[float, str]  # time step of the Monte Carlo engine
    checkpoint_every: float  # wall-clock time between checkpoints; 0: none
    state: str  # checkpoint at the end of a finished run
    trajectory_every: float  # interval between stored frames; 0: only the last state
    after: str  # first frame that is stored
    fields: Union[str, list[str]]  # what frames in the result file hold of every grain; velocity is always among it
    log: str  # file to which a run appends a row for each sample of its first replica: time, collisions, headline quantities and their means so far; beside the result, unless its path is absolute
    e: Union[float, dict]  # coefficient of normal restitution; in equilibrium the default is 1; a formula or table may exceed 1
    beta: Union[float, dict]  # coefficient of tangential restitution: -1 smooth, 1 perfectly rough; with finite mu, of sticking contacts
    mu: Union[float, dict]  # Coulomb friction coefficient; inf: beta is constant
    theories: dict[str, Any]


class KeyWords(TypedDict, total=False):
    """The keys of a scene as keyword arguments."""

    flow: Any
    engine: Any
    thermostat: Any
    gaussian_rate: Any
    noise_strength: Any
    contact_value: Any
    phi: Any
    particles: Any
    shear_rate: Any
    shear_steps: Any
    shear_period: Any
    aspect: Any
    species: Any
    gravity: Any
    protocol: Any
    measure: Any
    frame: Any
    frame_cells: Any
    local_densities: Any
    bath: Any
    collision: Any
    dsmc: Any
    md: Any
    output: Any
    run: Any
    start: Any
    walls: Any
    drag: Any
    rotation: Any
    rotational_temperature: Any
    a2: Any
    spin: Any
    wave: Any
    positions: Any
    normal_kick: Any
    tangential_kick: Any
    law: Any
    accommodation: Any
    top: Any
    ridges: Any
    relative_error: Any
    until: Any
    collisions: Any
    time_limit: Any
    duration: Any
    warmup: Any
    replicas: Any
    seed: Any
    contact_time: Any
    time_step: Any
    checkpoint_every: Any
    state: Any
    trajectory_every: Any
    after: Any
    fields: Any
    log: Any
    e: Any
    beta: Any
    mu: Any
    theories: Any
