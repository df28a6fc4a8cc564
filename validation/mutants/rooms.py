# SPDX-License-Identifier: GPL-3.0-or-later
"""Files with physics, by room, and the number of mutants of each room. Left out is code on which no result depends:
code for speed alone (sorting, memory, prefetching, the size of cells), input, output and descriptions."""

ROOMS = {
    "common": (40, """
        src/common/collision.c src/common/collision.h src/common/collision_of.h src/common/contact_value.c
        src/common/model.c src/common/model_rates.c src/common/restitution.c src/common/species.h src/common/thermostat.c
        src/common/laws/loss_table.h src/common/laws/loss_at_of.h src/common/laws/coefficient_tables.c
        src/common/laws/coefficient_tables.h src/common/laws/speed_laws.c
        src/common/laws/viscoelastic.c src/common/vec.h src/common/vec_of.h src/common/rng.c src/common/rng.h
        src/common/surface/plane.h src/common/surface/ridges.h src/common/surface/shapes.h
        src/common/surface/surfaces.c"""),
    "md": (32, """
        src/md/box.h src/md/epoch.c src/md/contacts.c src/md/contacts.h src/md/event_loop.h
        src/md/separating_pairs.c src/md/predict.h src/md/resolve.c src/md/resolve.h src/md/row_motion.c
        src/md/row_motion.h src/md/md_snapshot.c src/md/kicks.c src/md/start/place.c src/md/start/relax_lists.c src/md/start/start.c
        src/md/wall_contacts.c src/md/md_thermostat.c src/md/cell_grid.c src/md/cell_grid.h"""),
    "md/search": (26, """
        src/md/search/candidates.h src/md/search/comoving_rows.h src/md/search/faces.h src/md/search/list_update.h
        src/md/search/lists.h src/md/search/overlapping.h src/md/search/overlapping_cells.h
        src/md/search/overlapping_rows.h src/md/search/pair.h src/md/search/plain_cells.h src/md/search/search.h
        src/md/search/simd_pairs.h src/md/search/near_surfaces.h src/md/overlapping_members.h"""),
    "dsmc": (38, """
        src/dsmc/ensemble.c src/dsmc/majorant.c src/dsmc/collision_loop.c src/dsmc/species_pair.c src/dsmc/splitting.c
        src/dsmc/step.c src/dsmc/dsmc_thermostat.c src/dsmc/time_step.c src/dsmc/kernel/block_pairs.h
        src/dsmc/kernel/candidate.h src/dsmc/kernel/collide_blocks.c src/dsmc/kernel/collide_plain.c
        src/dsmc/kernel/collision_sums.h src/dsmc/kernel/directions.h src/dsmc/kernel/kicks.c
        src/dsmc/kernel/lanes_collision.h src/dsmc/kernel/normal.h src/dsmc/kernel/pass.h src/dsmc/kernel/stages.h
        src/dsmc/kernel/synchronise.c src/dsmc/parallel/round_robin.c"""),
    "measure": (36, """
        src/measure/grain_snapshot.c src/measure/cell_frame.c src/measure/cell_frame.c src/measure/cell_means.c
        src/measure/collisions.c src/measure/curve.c src/measure/diffusion.c
        src/measure/diffusion_coefficient.c src/measure/displacement.c src/measure/two_times.c src/measure/free_flight.c src/measure/histogram.c
        src/measure/impact_speed.c src/measure/local_distributions.c src/measure/local_frame.c
        src/measure/long_time_tail.c src/measure/mesh.c src/measure/orientation.c src/measure/pair_correlation.c
        src/measure/pairs.c src/measure/pairs.h src/measure/profiles.c src/measure/rheology.c
        src/measure/rheology_quantities.c src/measure/sonine.c src/measure/sonine.c src/measure/structure.c
        src/measure/stretched_tail.c src/measure/velocity_correlations.c src/measure/velocity_distributions.c
        src/measure/velocity_distributions.c src/measure/velocity_moments.c src/measure/green_kubo_viscosity.c"""),
    "theory": (22, """
        src/theory/answer.c src/theory/answer.c src/theory/hermite/hermite_curves.c src/theory/enskog.c
        src/theory/enskog_hermite.c src/theory/equation_of_state.c src/theory/garzo_dufty1999.c
        src/theory/garzo_montanero2003.c src/theory/gaussian_closure.c src/theory/gaussian_moments.c
        src/theory/gaussian_steady.c src/theory/goldhirsch_zanetti1993.c src/theory/grad.c src/theory/grad.c
        src/theory/haff1983.c src/theory/huthmann_zippelius1997.c src/theory/kremer_santos_garzo2014.c
        src/theory/lun1991.c src/theory/mixture.c src/theory/sela_goldhirsch1998.c src/theory/spin_escape.c
        src/theory/two_maxwellian.c"""),
    "theory/hermite": (14, """
        src/theory/hermite/basis.c src/theory/hermite/component.c src/theory/hermite/contact_integral.c
        src/theory/hermite/hermite_curves.c src/theory/hermite/derivative.c src/theory/hermite/flux.c src/theory/hermite/gas.c
        src/theory/hermite/isotropic.c src/theory/hermite/hermite_mixture.c src/theory/hermite/mixture_answer.c
        src/theory/hermite/operator.c src/theory/hermite/overlap.c src/theory/hermite/radial.c
        src/theory/hermite/shear.c src/theory/hermite/shear_answer.c src/theory/hermite/spectrum.c
        src/theory/hermite/streaming.c src/theory/hermite/sums.c src/theory/hermite/viscosity.c"""),
    "theory/rough": (8, """
        src/theory/rough/rough_answer.c src/theory/rough/rough_collision.c src/theory/rough/eight_directions.c src/theory/rough/factors.c
        src/theory/rough/functions.c src/theory/rough/distribution.c src/theory/rough/friction.c src/theory/rough/friction_averages.c src/theory/rough/friction_points.c src/theory/rough/turn.c src/theory/rough/rough_pairs.c src/theory/rough/relative.c src/theory/rough/rough_state.c
        src/theory/rough/steady.c"""),
}

ROOM_OF = {path: room for room, (_, files) in ROOMS.items() for path in files.split()}

# Shares of the kinds where a room has sites of all of them.
KINDS = {"sign": 0.28, "factor": 0.30, "index": 0.24, "image": 0.18}
