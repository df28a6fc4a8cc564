# SPDX-License-Identifier: GPL-3.0-or-later
from spack.package import *


class Graingas(MesonPackage):
    """Granular gases of hard spheres: molecular dynamics, Enskog Monte Carlo, theory."""

    homepage = "https://example.org/graingas"
    git = "https://example.org/graingas.git"

    license("GPL-3.0-or-later")

    version("main", branch="main")
    version("0.1.0", tag="v0.1.0")

    variant("mpi", default=True, description="Share replicas and sweeps among processes")
    variant("python", default=True, description="The Python module")

    depends_on("c", type="build")
    depends_on("meson@1.0:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("gsl")
    depends_on("fftw@3:")
    depends_on("hdf5")
    depends_on("zlib-api")
    depends_on("libyaml")
    depends_on("jansson")
    depends_on("random123", type="build")
    depends_on("gnuplot", type="run")
    depends_on("mpi", when="+mpi")
    depends_on("python@3.9:", when="+python", type=("build", "link", "run"))
    depends_on("py-cffi", when="+python", type=("build", "run"))
    depends_on("py-numpy", when="+python", type=("build", "run"))
    extends("python", when="+python")

    def meson_args(self):
        def state(feature):
            return "enabled" if self.spec.satisfies("+" + feature) else "disabled"

        return ["-Dinstructions=native", "-Dmpi=" + state("mpi"), "-Dpython=" + state("python")]
