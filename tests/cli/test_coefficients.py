# SPDX-License-Identifier: GPL-3.0-or-later
"""Transport coefficients of theories against a second computation: collision integrals of Lun (1991) and of Kremer,
Santos & Garzo (2014) from the collision rule itself, term by term over Gaussians, and the critical lengths from the
eigenvalues of the equations of hydrodynamics. Nothing is shared with the program but the rule."""
import csv
import json
import math
import os
import subprocess
import sys

from tap import Skip, check, main, run

try:
    import numpy as np
except ImportError:
    np = None

K = 0.4


def add(p, q, factor=1):
    sum_ = dict(p)
    for powers, c in q.items():
        sum_[powers] = sum_.get(powers, 0) + factor * c
    return sum_


def product(p, q):
    out = {}
    for a, c in p.items():
        for b, d in q.items():
            powers = tuple(map(sum, zip(a, b)))
            out[powers] = out.get(powers, 0) + c * d
    return out


def times(p, factor):
    return {powers: factor * c for powers, c in p.items()}


ONE = {(0,) * 12: 1.0}


def variable(i):
    return {tuple(int(i == j) for j in range(12)): 1.0}


def square(vector):
    return add(add(product(vector[0], vector[0]), product(vector[1], vector[1])), product(vector[2], vector[2]))


def moments():
    """Moments of a standard normal: over the positive half line, over the whole."""
    double = [math.prod(range(n - 1, 0, -2)) for n in range(16)]
    half = [double[n] / (math.sqrt(2 * math.pi) if n % 2 else 2) for n in range(16)]
    return half, [0 if n % 2 else double[n] for n in range(16)]


HALF, WHOLE = moments()


def mean(p):
    return sum(c * HALF[powers[2]] * math.prod(WHOLE[n] for i, n in enumerate(powers) if i != 2) for powers, c in p.items())


class Collision:
    """k along z, from grain 1 to 2; m = d = T = 1, surface velocities s with K <s.s>/3 = r; weight: g.k > 0."""

    def __init__(self, e, beta, r):
        self.r = r
        relative, centre = [variable(i) for i in range(3)], [variable(i) for i in range(3, 6)]
        width = math.sqrt(r / K)
        s = [[times(variable(6 + 3 * grain + i), width) for i in range(3)] for grain in range(2)]
        c = [[times(add(centre[i], relative[i], sign), math.sqrt(0.5)) for i in range(3)] for sign in (1, -1)]
        spin = [add(a, b) for a, b in zip(*s)]
        g = [times(u, math.sqrt(2)) for u in relative]
        slip = [add(g[0], spin[1]), add(g[1], spin[0], -1), g[2]]
        eta = [(1 + beta) * K / (2 * (1 + K))] * 2 + [(1 + e) / 2]
        J = [times(v, f) for v, f in zip(slip, eta)]
        self.flux, self.c, self.s = g[2], c, s
        self.after = [add(a, b, -1) for a, b in zip(c[0], J)], [add(s[0][0], J[1], 1 / K), add(s[0][1], J[0], -1 / K), s[0][2]]

    def energy(self, which, v=None, s=None):
        return times(square(v), 0.5) if which == 0 else times(square(s), K / 2)

    def excess(self, which, grain, mean_energy):
        """C^2/2 - 3/2 and the like, of width 1."""
        energy = self.energy(which, self.c[grain], self.s[grain])
        return add(times(energy, 1 if which == 0 else 1 / self.r), ONE, -mean_energy)

    def change(self, which):
        return add(self.energy(which, *self.after), self.energy(which, self.c[0], self.s[0]), -1)

    def change_of_flux(self, which, axis):
        now, then = self.energy(which, self.c[0], self.s[0]), self.energy(which, *self.after)
        return add(product(then, self.after[0][axis]), product(now, self.c[0][axis]), -1)

    def trial(self, which, axis):
        """c times the Sonine polynomial of both grains."""
        terms = [product(self.c[grain][axis], self.excess(which, grain, 2.5 if which == 0 else 1.5)) for grain in range(2)]
        return add(*terms)

    def average(self, p):
        return mean(product(p, self.flux))


def decay(collision):
    """-dq_i/dt per n chi d^2 of q_j; f = f0 (1 + A.trial) has q_0 = 5/2 n A, q_1 = 3/2 n r A."""
    norm = [2.5, 1.5 * collision.r]
    return np.array([[-4 * math.pi / 3 / norm[j] * sum(
        collision.average(product(collision.change_of_flux(i, axis), collision.trial(j, axis))) for axis in range(3))
        for j in range(2)] for i in range(2)])


def conductivities(e, beta, r, phi, chi):
    """q_i = -sum_j kappa_ij grad T_j at T = 1, over n."""
    c, n = Collision(e, beta, r), 6 * phi / math.pi
    pressure = 1 + n * chi * 2 * math.pi / 3 * (1 + e) / 2
    kappa = np.zeros((2, 2))
    widths = [1, r]
    norm = [2.5, 1.5 * r]
    streaming = np.array([[2.5 * (2 - pressure), 0], [1.5 * r * (1 - pressure), 1.5]])
    distant = np.array([[n * chi * 4 * math.pi / 3 * c.average(product(c.change_of_flux(i, 2), c.excess(j, 1, 1.5))) / widths[j]
                         for j in range(2)] for i in range(2)])
    kinetic = np.linalg.solve(n * chi * decay(c), streaming - distant)
    carried = np.array([[-n * chi * 2 * math.pi / 3 * c.average(product(c.change(i), c.trial(j, 2))) / norm[j]
                         for j in range(2)] for i in range(2)])
    direct = np.array([[n * chi * math.pi / 3 * c.average(product(c.change(i), add(c.excess(j, 1, 1.5), c.excess(j, 0, 1.5), -1))) / widths[j]
                        for j in range(2)] for i in range(2)])
    return kinetic + carried @ kinetic + direct


def theory(name, scene):
    if np is None:
        raise Skip("no numpy")
    document = json.loads(run("theory", "scene.yaml", "--json", "--theory", name, scene=json.dumps(scene)).out)
    return {q: v["mean"] for q, v in document["theory"][name].items()}


def close(found, right, *what, within=1e-9):
    check(abs(found - right) <= within * max(abs(right), 1e-3), *what, found, right)


def test_lun_has_its_published_coefficients():
    names = [["thermal_conductivity", "thermal_conductivity_cross"],
             ["rotational_conductivity_cross", "rotational_conductivity"]]
    for e, beta, phi in (0.9, 0.3, 0.3), (0.6, -0.5, 0.1), (0.95, 1, 0.45), (0.8, -1, 0.2):
        a = theory("lun1991", {"flow": "usf", "phi": phi, "collision": {"e": e, "beta": beta}})
        chi, T = (1 - phi / 2) / (1 - phi) ** 3, a["temperature"]
        kappa = conductivities(e, beta, a.get("temperature_ratio", 1), phi, chi)
        for i in range(2 if beta > -1 else 1):
            for j in range(2 if beta > -1 else 1):
                close(a[names[i][j]], phi * math.sqrt(T) * kappa[i, j], e, beta, names[i][j])
        close(a["bulk_viscosity"], math.sqrt(T) * 8 / 3 / math.sqrt(math.pi) * (1 + e) / 2 * phi ** 2 * chi, "bulk viscosity")
        check((beta > -1) == ("rotational_viscosity" in a) == ("rotational_conductivity" in a), sorted(a))


def test_spinners_have_luns_rotational_viscosity():
    """Collisions pass on the whole torque. Lun's formula is for Gaussian grains: these are colder where they spin."""
    N, phi, e, beta = 0.3, 0.1, 0.95, 0.3
    scene = {"flow": "hss", "phi": phi, "thermostat": "bath", "bath": {"drag": 0.3, "temperature": 1, "rotation": 0},
             "collision": {"e": e, "beta": beta}, "species": [{"torque": N}], "run": {"relative_error": 0.02, "seed": 2}}
    n, chi, eta2 = 6 * phi / math.pi, (1 - phi / 2) / (1 - phi) ** 3, (1 + beta) * K / 2 / (1 + K)
    for engine in "md", "dsmc":
        done = run("run", "s.yaml", "--engine", engine, "--json", "--quiet", scene=json.dumps(scene), name="s.yaml")
        check(done.code == 0, done.err)
        r = json.loads(done.out)["results"]
        found, T = r["rotational_viscosity"], r["temperature"]["mean"]
        close(r["P_xy"]["mean"] - r["P_yx"]["mean"], phi * N, engine, "torque", within=1e-3)
        close(4 * found["mean"] * r["spin_z"]["mean"], phi * N, engine, "balance of spin", within=1e-3)
        lun = math.pi / 6 * eta2 * n * n * chi * math.sqrt(math.pi * T) / 3
        check(abs(found["mean"] / lun - 1.005) < 0.005 + 3 * found["stderr"] / lun, engine, found, lun)
        spin = r["spin_z"]["stderr"] / r["spin_z"]["mean"]  # the torque has no error
        check(0.7 < found["stderr"] / found["mean"] / spin < 1.4 and spin < 0.01, engine, found, spin)
    a = theory("lun1991", {"flow": "usf", "phi": phi, "collision": {"e": e, "beta": beta}})
    close(a["rotational_viscosity"] / math.sqrt(a["temperature"]), lun / math.sqrt(T), "Lun")


def test_rough_cooling():
    """Fluxes along grad T and grad n decay by collisions and grow, in units of the falling temperature, by cooling."""
    nu0 = 16 / 5 * math.sqrt(math.pi)
    for e, beta in (0.9, 0.3), (0.7, -0.4), (1, 1):
        a = theory("kremer_santos_garzo2014", {"flow": "hcs", "phi": 0, "collision": {"e": e, "beta": beta}})
        r = a["temperature_ratio"]

        def losses(ratio):
            c = Collision(e, beta, ratio)
            return [-4 * math.pi * c.average(c.change(i)) / 1.5 / (1, ratio)[i] / nu0 for i in range(2)]

        zeta = losses(r)[0]
        close(losses(r)[1], zeta, e, beta, "one cooling rate", within=1e-6)
        rate = decay(Collision(e, beta, r)) / nu0
        kappa = np.linalg.solve(rate - 2 * zeta * np.eye(2), [2 / 3, 0.4 * r])
        mu = np.linalg.solve(rate - 1.5 * zeta * np.eye(2), zeta * kappa)
        for name, value in (("thermal_conductivity_reduced", kappa[0]), ("rotational_conductivity_reduced", kappa[1]),
                            ("diffusive_heat_conductivity_reduced", mu[0]),
                            ("rotational_diffusive_conductivity_reduced", mu[1])):
            close(a[name], value, e, beta, name, within=1e-6)
        h = 1e-4
        slope = sum(s * (b - t) for s, (t, b) in ((1, losses(r * math.exp(h))), (-1, losses(r * math.exp(-h))))) / (2 * h)
        close(a["bulk_viscosity_reduced"], 2 / 3 * r / (1 + r) / (slope + zeta / 2), e, beta, "bulk viscosity", within=1e-6)


def growth(k, a, Z, slope, bulk):
    """Largest growth of n, longitudinal u and T, as shares of n, sqrt(T) and T, and of the transverse u; t in 1/nu_0 and
    lengths in sqrt(T)/nu_0."""
    zeta, eta, kappa, mu = (a[q] for q in ("cooling_rate", "viscosity_reduced", "thermal_conductivity_reduced",
                                           "diffusive_heat_conductivity_reduced"))
    along = np.array([[0, -1j * k, 0],
                      [-1j * k * Z * (1 + (Z - 1) / Z * (1 + slope)), zeta / 2 - (4 / 3 * eta + bulk) * k * k, -1j * k * Z],
                      [-zeta * (1 + slope) - 2.5 * mu * k * k, -2 / 3 * Z * 1j * k, -zeta / 2 - 2.5 * kappa * k * k]])
    return max(np.linalg.eigvals(along).real), zeta / 2 - eta * k * k


def test_critical_lengths():
    for name in "garzo_dufty1999", "garzo_santos_montanero2007", "enskog_hermite":
        for phi, e in (0, 0.9), (0.2, 0.8), (0.4, 0.95):
            a = theory(name, {"flow": "hcs", "phi": phi, "collision": {"e": e}})
            chi, h = (1 - phi / 2) / (1 - phi) ** 3, 1e-5
            slope = phi * (math.log((1 - (phi + h) / 2) / (1 - phi - h) ** 3) - math.log((1 - (phi - h) / 2) / (1 - phi + h) ** 3)) / (2 * h)
            unit = 1 / (3.2 * math.sqrt(math.pi) * (6 * phi / math.pi or 1))
            for which, length in enumerate((a["heat_mode_length"], a["clustering_length"])):
                short, long = (growth(2 * math.pi * unit / (length * f), a, 1 + 2 * (1 + e) * phi * chi, slope, 1)[which] for f in (0.9999, 1.0001))
                check(short < 0 < long, name, phi, e, which, short, long)


def test_closures_are_those_of_the_theory():
    """validation/noise_free/closures and its stored table have the numbers of `graingas theory`."""
    folder = os.path.join(os.environ["SOURCE"], "validation", "noise_free")
    with open("two.yaml", "w") as f:
        f.write("flow: hcs\nvary: {phi: [0.1, 0.4], collision.e: [0.8, 1]}\nsweep: {does: theory}\n")
    done = subprocess.run([os.path.join(folder, "closures"), "two.yaml"], capture_output=True, text=True)
    if "No module" in done.stderr:
        raise Skip(done.stderr)
    check(done.returncode == 0, done.stderr)
    with open("two.csv") as f, open(os.path.join(folder, "closures.csv")) as g:
        rows, all_ = list(csv.DictReader(f)), list(csv.DictReader(g))
    check(len(rows) == 4 and len(all_) == 1020, len(rows), len(all_))
    import h5py

    with h5py.File("two.h5") as h, h5py.File(os.path.join(folder, "closures.h5")) as whole:
        for row in rows:
            phi, e = float(row["phi"]), float(row["collision.e"])
            a = theory("enskog_hermite", {"flow": "hcs", "phi": phi, "collision": {"e": e}})
            stored = [r for r in all_ if float(r["phi"]) == phi and float(r["collision.e"]) == e][0]
            place = tuple(list(h[k][:]).index(v) for k, v in (("phi", phi), ("collision.e", e)))
            there = tuple(list(whole[k][:]).index(v) for k, v in (("phi", phi), ("collision.e", e)))
            check(len(row) == 14 == len(stored), row)
            for q in [c for c in row if c + "_error" in row]:
                for found in float(row[q]), float(stored[q]), h[q][place], whole[q][there]:
                    close(found, a.get(q, 0), phi, e, q, within=1e-7)


def test_mixtures_diffuse_as_their_theories():
    """The flux of mass that keeps pace with the gradients of a cooling mixture: momentum of species 1, and how gradients
    of p and T change where zeta depends on place."""
    for masses, sizes, e in ((1, 1), (1, 1), 0.8), ((4, 1), (1.5, 1), 0.7), ((1, 8), (1, 2), 0.9), ((4, 1), (2, 1), 1):
        def at(x):
            species = [{"fraction": f, "mass": m, "diameter": d} for f, m, d in zip((x, 1 - x), masses, sizes)]
            return theory("garzo_dufty2002", {"flow": "hcs", "phi": 0, "dsmc": {"particles": 100000}, "engine": "dsmc",
                                              "species": species, "collision": {"e": e}})

        def split(a, x):  # T_1, T_2 at T = 1
            r = a["partial_temperature_ratio"]
            return r / (x * r + 1 - x), 1 / (x * r + 1 - x)

        x, h, a = 0.4, 0.01, at(0.4)
        sides = [(at(x + s), x + s) for s in (-h, h)]
        m1, m2 = masses
        rho, T1, T2 = x * m1 + (1 - x) * m2, *split(a, x)
        g_slope = sum(s * y * split(b, y)[0] for s, (b, y) in zip((-1, 1), sides)) / (2 * h)
        zeta, zeta_slope = a["cooling_rate"], (sides[1][0]["cooling_rate"] - sides[0][0]["cooling_rate"]) / (2 * h)
        # drag of both species on each other over nu_0 = sqrt(pi) n sigma_12^2 v_0, v_0^2 = 2 T (m_1 + m_2)/(m_1 m_2)
        S = math.sqrt(T1 / m1 + T2 / m2)
        nu = 4 / 3 * math.sqrt(2) * (1 + e) * rho * S / (m1 + m2) / math.sqrt(2 * (m1 + m2) / (m1 * m2))
        # J = j_1 nu_0/(nT), where sqrt(T) falls at zeta/2: dJ/dt = -(nu - zeta/2) J - s.V of the gradients V of x, ln p
        # and ln T, and dV/dt = -B V. J = -D.V at all times if D B = (nu - zeta/2) D - s.
        s = [g_slope, x * T1 - x * m1 / rho, 0]
        B = np.array([[0, 0, 0], [zeta_slope, zeta, -zeta / 2], [zeta_slope, zeta, -zeta / 2]])
        D = np.linalg.solve(((nu - zeta / 2) * np.eye(3) - B).T, s)
        for name, value in zip(("diffusion_reduced", "pressure_diffusion_reduced", "thermal_diffusion_reduced"), D):
            close(a[name], value, masses, sizes, e, name, within=2e-3)
        if e == 1:  # Chapman & Cowling, 9.81: n D_12 = 3/(8 sigma^2) sqrt(T (m_1 + m_2)/(2 pi m_1 m_2))
            close(a["diffusion_reduced"], 3 / 8 * math.sqrt((m1 + m2) / (2 * math.pi * m1 * m2)) * m1 * m2 / rho * math.sqrt(
                math.pi) * math.sqrt(2 * (m1 + m2) / (m1 * m2)), "elastic", within=1e-9)
            check(abs(a["thermal_diffusion_reduced"]) < 1e-11, a)


def free_energy(n, d):
    """Excess over an ideal gas, per volume and T: Mansoori et al. 1971."""
    x = [math.pi / 6 * sum(a * b ** k for a, b in zip(n, d)) for k in range(4)]
    return 6 / math.pi * ((x[2] ** 3 / x[3] ** 2 - x[0]) * math.log(1 - x[3]) + 3 * x[1] * x[2] / (1 - x[3])
                          + x[2] ** 3 / (x[3] * (1 - x[3]) ** 2))


def test_dense_diffusion():
    """The same of a dense mixture, with the force on grains of species 1 by partners at a distance: integrals over
    directions of fields that vary in space. At e = 1 that is a gradient of chemical potentials. Counts of 10^8 grains have
    fractions to 1e-8."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    for phi, masses, sizes, e in (0.3, (4, 1), (1.5, 1), 0.8), (0.2, (1, 8), (1, 2), 0.9), (0.3, (4, 1), (1.5, 1), 1):
        m, d, x, h, small = np.array(masses), np.array(sizes), 0.4, 0.002, 1e-4
        n0 = np.array([x, 1 - x]) * phi / (math.pi / 6 * (x * d[0] ** 3 + (1 - x) * d[1] ** 3))
        sigma, reduced = (d[:, None] + d) / 2, m[:, None] * m / (m[:, None] + m)
        v0, cache = math.sqrt(2 * m.sum() / m.prod()), {}

        def nu0(n):
            return math.sqrt(math.pi) * sum(n) * sigma[0, 1] ** 2 * v0

        def state(n):  # T_1, T_2, zeta at T = 1
            if tuple(n) not in cache:
                species = [{"fraction": k / sum(n), "mass": a, "diameter": b} for k, a, b in zip(n, masses, sizes)]
                a = theory("garzo_montanero2003", {"flow": "hcs", "phi": math.pi / 6 * (n * d ** 3).sum(), "engine": "dsmc",
                                                   "dsmc": {"particles": 10 ** 8}, "particles": 10 ** 8, "species": species, "collision": {"e": e}})
                r, y = a["partial_temperature_ratio"], n[0] / sum(n)
                cache[tuple(n)] = r / (y * r + 1 - y), 1 / (y * r + 1 - y), a["cooling_rate"] * nu0(n)
            return cache[tuple(n)]

        def chi(n):
            xi = [math.pi / 6 * (n * d ** k).sum() for k in range(4)]
            y = d[:, None] * d / (2 * sigma) * xi[2] / (1 - xi[3])
            return (1 + 3 * y + 2 * y * y) / (1 - xi[3])

        def along(k):  # fields at a distance, of grad ln n_k = 1 there (2: ln T)
            T1, T2, z = state(n0)
            if k == 2:
                return np.zeros(2), np.array([T1, T2]), z / 2
            step = np.array([k == 0, k == 1]) * h
            more, less = state(n0 * (1 + step)), state(n0 * (1 - step))
            slope = [(a - b) / (2 * h) for a, b in zip(more, less)]
            return step / h, np.array(slope[:2]), slope[2]

        T, zeta, base = np.array(state(n0)[:2]), state(n0)[2], chi(n0)
        S2, c = T[:, None] / m[:, None] + T / m, 1e-3

        def force(k, i, bend, e, T, dT):  # sum over directions of what partners at sigma cos press, less without gradient
            dn, total = (np.array([k == 0, k == 1]) * 1.0), 0
            for l in range(2):
                for z, w in zip(nodes, weights):
                    at = c * sigma[i, l] * z
                    there = n0[l] * (1 + dn[l] * at) * ((T[i] / m[i] + (T[l] + dT[l] * at) / m[l]) / 2)
                    near = chi(n0 * (1 + dn * at / 2))[i, l] * (1 + bend[i, l] * at / 2)
                    total -= 2 * math.pi * w * z * n0[i] * there * near * reduced[i, l] * (1 + e) * sigma[i, l] ** 2 / c
            return total

        def bent(k):  # so that elastic gases at one temperature have n_1 grad mu_1
            up, down = (n0 * (1 + np.array([k == 0, k == 1]) * sign * small) for sign in (1, -1))
            own = np.array([small, 0]) * n0

            def mu(n):
                return (free_energy(n + own, d) - free_energy(n - own, d)) / (2 * own[0])

            right = -n0[0] * (mu(up) - mu(down)) / (2 * small)
            one, zero = np.array([[0, 1], [-1, 0]]), np.zeros((2, 2))
            without, more = (force(k, 0, b, 1, np.ones(2), np.zeros(2)) for b in (zero, one))
            return one * (right - without) / (more - without)

        def pressure(n, T):
            return n @ T + math.pi / 3 * (np.outer(n, n) * sigma ** 3 * chi(n) * reduced * (1 + e) * (T[:, None] / m[:, None] + T / m)).sum()

        rho, p = m * n0, pressure(n0, T)
        nu = 4 / 3 * math.sqrt(2 * math.pi) * base[0, 1] * sigma[0, 1] ** 2 * (1 + e) * rho.sum() * math.sqrt(S2[0, 1]) / m.sum()
        s, p_slope, z_slope = np.zeros(3), np.zeros(3), np.zeros(3)
        for k in range(3):
            dn, dT, z_slope[k] = along(k)
            p_slope[k] = (pressure(n0 * (1 + small * dn), T + small * dT) - pressure(n0 * (1 - small * dn), T - small * dT)) / (2 * small)
            bend = bent(k) if k < 2 else np.zeros((2, 2))
            s[k] = n0[0] * (dT[0] + dn[0] * T[0]) - rho[0] / rho.sum() * p_slope[k] - force(k, 0, bend, e, T, dT)
        B = np.zeros((3, 3))
        B[2] = z_slope
        a = np.linalg.solve(((nu - zeta / 2) * np.eye(3) - B).T, s)
        # grad ln n_1, ln n_2, ln T from those of x_1, ln p, ln T
        A = np.linalg.inv([[x * (1 - x), -x * (1 - x), 0], p_slope / p, [0, 0, 1]])
        found = theory("garzo_dufty_hrenya2007", {"flow": "hcs", "phi": phi, "engine": "dsmc", "dsmc": {"particles": 10 ** 8}, "particles": 10 ** 8,
                                                  "species": [{"fraction": k, "mass": a, "diameter": b} for k, a, b in zip((x, 1 - x), masses, sizes)],
                                                  "collision": {"e": e}})
        for name, value in zip(("diffusion_reduced", "pressure_diffusion_reduced", "thermal_diffusion_reduced"), nu0(n0) / n0.sum() * a @ A):
            close(found[name], value, phi, masses, sizes, e, name, within=1e-5)
    for e in 0.7, 1:  # one species cut in two; its self-diffusion: T/(m (nu - zeta/2))
        a = theory("garzo_dufty_hrenya2007", {"flow": "hcs", "phi": 0.3, "species": [{"fraction": 0.4}, {"fraction": 0.6}], "collision": {"e": e}})
        check(abs(a["pressure_diffusion_reduced"]) < 1e-11 > abs(a["thermal_diffusion_reduced"]), a)
        nu = 4 / 3 * math.sqrt(2) * 0.85 / 0.7 ** 3 * (1 + e) / 2 * math.sqrt(2) / 2
        close(a["diffusion_reduced"], 1 / (nu - a["cooling_rate"] / 2), e, "self-diffusion", within=1e-9)
    dilute = {"flow": "hcs", "phi": 0, "species": [{"fraction": 0.4, "mass": 4, "diameter": 1.5}, {"fraction": 0.6}], "engine": "dsmc", "collision": {"e": 0.7}}
    a, b = theory("garzo_dufty2002", dilute), theory("garzo_dufty_hrenya2007", dict(dilute, phi=1e-7))
    for name in a:
        close(b[name], a[name], "dilute", name, within=2e-6)


class Expanding:
    """Grains of one species that move apart: what collisions do to the averages of x^k, x = C^2/2, k = 1 .. K, and how
    much energy they take, bilinear in the coefficients of L_j^(1/2)(x) in both partners; T = m = n = sigma = 1."""

    def __init__(self, e, chi, K):
        self.e, self.K, self.rate = e, K, 4 * np.pi * chi
        x, w = np.polynomial.laguerre.laggauss(K + 4)
        v, wv = np.polynomial.hermite.hermgauss(2 * K + 8)
        g, wg = np.polynomial.legendre.leggauss(60)
        self.points = [a.ravel() for a in np.meshgrid(6.5 * (g + 1), v, x, indexing="ij")]
        self.weight = (6.5 * wg[:, None, None] * wv[:, None] * w).ravel() / (2 * np.pi)

    def laguerre(self, a, x):
        L = [np.ones_like(x), 1 + a - x]
        for k in range(1, self.K):
            L.append(((2 * k + 1 + a - x) * L[k] - (k + a) * L[k - 1]) / (k + 1))
        return np.array(L)

    def at(self, h):
        g, v, w = self.points
        z, other = v + (g + h) / 2, v - (g + h) / 2
        weight = self.rate * self.weight * np.exp(-(g + h) ** 2 / 4) * g
        before, after = z * z / 2 + w, (z - (1 + self.e) / 2 * g) ** 2 / 2 + w
        own, partner = self.laguerre(0.5, before), self.laguerre(-0.5, other * other / 2)
        change = np.array([after ** k - before ** k for k in range(1, self.K + 1)] + [(1 - self.e ** 2) / 8 * g * g])
        return np.einsum("kp,ip,jp->kij", change * weight, own, partner)

    def averages(self):
        """<x^k L_j> of a Maxwellian."""
        x, w = np.polynomial.hermite.hermgauss(4 * self.K)
        L = self.laguerre(0.5, x * x)
        return np.array([(w * x * x * x ** (2 * k) * L).sum(1) for k in range(1, self.K + 1)]) / (np.pi ** 0.5 / 2)


def test_expansion_changes_the_cooling_rate():
    """zeta_u: noise-free by more and more functions, solved anew; first order by two, linear in a_2."""
    for e, phi in (0.8, 0.3), (0.75, 0.1), (0.95, 0.4):
        scene = {"flow": "hcs", "phi": phi, "collision": {"e": e}}
        first, exact = theory("garzo_dufty1999", scene), theory("enskog_hermite", scene)["cooling_rate_transport"]
        density, chi, h = 6 * phi / np.pi, (1 - phi / 2) / (1 - phi) ** 3, 1e-3
        for K in 2, 7:
            gas = Expanding(e, chi * density, K)
            here, apart, m = gas.at(0), (gas.at(h) - gas.at(-h)) / (2 * h), gas.averages()
            order = np.arange(1, K + 1)

            def flow(B, c):
                rates = np.einsum("kij,i,j->k", B, c, c)[:K]
                return rates - order * rates[0] / m[0, 0] * (m @ c)  # T stays

            def slopes(c):
                unit = np.eye(K + 1)[2:] * 1e-5
                return np.array([(flow(here, c + u) - flow(here, c - u))[1:] / 2e-5 for u in unit]).T

            c = np.eye(K + 1)[0]
            linear = slopes(c)
            for _ in range(20 if K > 2 else 0):
                c[2:] -= np.linalg.solve(slopes(c), flow(here, c)[1:])
            if K == 2:
                c[2] = first["a2"]
            zeta = 2 / 3 * c @ here[K] @ c
            matrix = (slopes(c) if K > 2 else linear) - zeta / 2 * m[1:, 2:]
            answer = np.append([0, 0], np.linalg.solve(matrix, -flow(apart, c)[1:]))
            if K == 2:  # linear in a_2; then the loss by a_2 is that beside a Maxwellian
                one = np.eye(3)[0]
                close(2 / 3 * (one @ here[K] @ one + 2 * c[2] * here[K, 0, 2]) / (3.2 * np.pi ** 0.5 * density), first["cooling_rate"], "zeta")
                zeta_u = 2 / 9 * (one @ apart[K] @ one + answer[2] * (here[K, 0, 2] + here[K, 2, 0]))
                close(first["cooling_rate_transport"], zeta_u, e, phi, within=1e-5)
            else:
                zeta_u = 2 / 9 * (c @ apart[K] @ c + c @ here[K] @ answer + answer @ here[K] @ c)
                close(exact, zeta_u, e, phi, within=1e-5)


if __name__ == "__main__":
    main(sys.modules[__name__])
