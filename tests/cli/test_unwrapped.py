# SPDX-License-Identifier: GPL-3.0-or-later
"""Images in result files unwrap positions: mean-square displacements computed from the file are those that the program
measures by its own means, at rest, in sheared boxes and between walls."""
import sys

from tap import Skip, check, main, run

SCENE = ("{flow: %s, phi: %s, particles: 150, measure: [rheology, diffusion], run: {collisions: 1200, warmup: 40}, "
         "output: {trajectory_every: 1, after: warmup}%s}")


def modules(*names):
    import importlib

    try:
        return [importlib.import_module(name) for name in names]
    except ImportError as missing:
        raise Skip(missing)


def paths(file, numpy):
    """Times, unwrapped positions without the flow, in the laboratory, and edges; interpolated to equal times."""
    grains = file["particles/grains"]
    time, edges = grains["position/time"][:], grains["box/edges/value"][:]
    r = grains["position/value"][:] + numpy.einsum("tna,tab->tnb", grains["image/value"][:], edges)
    return time, r, edges


def test_displacements_from_the_file_are_those_of_the_program():
    """Both are means over the same 1200 collisions a grain, from other origins."""
    h5py, numpy = modules("h5py", "numpy")
    for flow, phi, more in ("equilibrium", 0.2, ", collision: {e: 1}"), ("usf", 0.2, ", collision: {e: 0.9}"), \
            ("usf", 0.02, ", collision: {e: 0.7}"), ("usf", 0.5, ", collision: {e: 0.9, beta: 0}"):
        done = run("run", "scene.yaml", "--quiet", scene=SCENE % (flow, phi, more))
        check(done.code in (0, 1), done.err)
        with h5py.File("scene.h5") as f:
            time, r, edges = paths(f, numpy)
            rate = f["particles/grains/velocity"].attrs["shear_rate"]
            flown = rate * (r[:, :, 1] - edges[0, 1, 1] / 2)
            r[1:, :, 0] -= numpy.cumsum((flown[1:] + flown[:-1]) / 2 * numpy.diff(time)[:, None], axis=0)
            step = numpy.median(numpy.diff(time))
            jump = numpy.abs(numpy.diff(r, axis=0)).max()
            check(len(time) > 500 and numpy.abs(f["particles/grains/image/value"][:]).max() >= 2, flow, phi)
            for a, name in enumerate("xyz"):
                curve = f[f"graingas/curves/displacement_squared_{name}"]
                x, value, error = (curve[k][:] for k in ("x", "value", "stderr"))
                for lag in 4, 16, 64:
                    mine = ((r[lag:, :, a] - r[:-lag, :, a]) ** 2).mean()
                    theirs = numpy.exp(numpy.interp(numpy.log(lag * step), numpy.log(x[1:]), numpy.log(value[1:])))
                    sigma = numpy.interp(lag * step, x, error)
                    check(abs(mine - theirs) < 4 * sigma + 0.04 * theirs, flow, phi, name, lag, mine, theirs, sigma, jump)


def test_grains_between_walls_leave_the_box_along_them_alone():
    h5py, numpy = modules("h5py", "numpy")
    scene = "{flow: couette, phi: 0.2, particles: 150, run: {collisions: 200, warmup: 20}, output: {trajectory_every: 1}}"
    check(run("run", "scene.yaml", "--quiet", scene=scene).code in (0, 1))
    with h5py.File("scene.h5") as f:
        image = f["particles/grains/image/value"][:]
        time, r, edges = paths(f, numpy)
        velocity = f["particles/grains/velocity/value"][:]
        check(not image[:, :, 1].any() and image[:, :, 0].any() and image[:, :, 2].any())
        # The centre of mass goes where its mean velocity leads.
        mean = velocity.mean(axis=1)
        way = numpy.cumsum((mean[1:] + mean[:-1]) / 2 * numpy.diff(time)[:, None], axis=0)
        gone = (r - r[0]).mean(axis=1)[1:]
        check(numpy.abs(gone - way)[:, 0].max() < 0.02 * numpy.abs(r - r[0]).max(), numpy.abs(gone - way).max(axis=0))


def test_fields_of_the_file_leave_images_out():
    (h5py,) = modules("h5py")
    for more, there in ("", True), (", fields: [position, velocity]", False):
        scene = "{flow: usf, phi: 0.2, particles: 50, run: {collisions: 60, warmup: 0}, output: {trajectory_every: 20%s}}" % more
        run("run", "scene.yaml", "--quiet", scene=scene)
        with h5py.File("scene.h5") as f:
            check(("image" in f["particles/grains"]) == there)


if __name__ == "__main__":
    main(sys.modules["__main__"])
