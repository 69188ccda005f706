#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strength and base stiffness of a muscle from a force-length table with noise: force_length.py FOLDER

A block of muscle is pulled from 0.8 to 1.3 of its length, once fully active and once passive, quasi-statically. Its forces at 12 lengths, with
noise of 2 % of the greatest, are the measured table; the fit finds the maximum isometric stress of the fibres and the factor of the base
material again, and tells how well they are known.
"""

import sys

import numpy as np

import myolines

STRESS, BASE = "system/tissues/muscle/fibre/maximum isometric stress", "system/tissues/muscle/base/factor"
TRUTH = {STRESS: 2.3e5, BASE: 1.4}
FORCE = "moving end along the line"


def pulled_block(activation):
    scene = myolines.Scene.template("muscle 3d", "static")
    return scene.update({
        "system/inertia": "quasi-static", "system/geometry/refinement": 0, "system/fibres/angle": 0,
        "system/boundary/moving end/strain": {"type": "control points", "points": [(0, 0), (0.2, -0.2), (0.7, 0.3)]},
        "system/activation": {"type": "control points", "points": [(0, 0), (0.2, activation)]},
        "time/end": 0.7, "time/step": 0.05, "output/checkpoint/every": 1000000})


def measured_table(folder, rng):
    """Times at which the block has its lengths, and forces [N], active and passive."""
    times = np.linspace(0.22, 0.7, 12)
    forces = {}
    for name, activation in (("active", 1), ("passive", 0)):
        table = myolines.run(pulled_block(activation).update(TRUTH), f"{folder}/{name}", overwrite=True)["reaction"]
        forces[name] = np.interp(times, table["Time"], table[FORCE])
    noise = 0.02 * max(np.abs(one).max() for one in forces.values())
    return times, {name: one + noise * rng.standard_normal(len(times)) for name, one in forces.items()}, noise


def main(folder):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    times, forces, noise = measured_table(folder, np.random.default_rng(7))
    scenes = {"active": pulled_block(1), "passive": pulled_block(0)}
    fit = myolines.fit(
        [myolines.Parameter(STRESS, low=5e4, high=1e6, name="maximum isometric stress [Pa]"), myolines.Parameter(BASE, low=0.1, high=10, name="base factor")],
        [myolines.Column(scenes[name], "reaction", FORCE, times, forces[name], sigma=noise) for name in scenes], tolerance=1e-5)
    print(fit)
    print("95 %:", [[float(f"{end:.4g}") for end in interval] for interval in fit.intervals(0.95)], "truth:", list(TRUTH.values()))
    strain = np.interp(times, [0.2, 0.7], [-0.2, 0.3])
    for (name, values), residual in zip(forces.items(), fit.residuals):
        pyplot.plot(1 + strain, values, "o", label=f"{name}, measured")
        pyplot.plot(1 + strain, values + residual, label=f"{name}, fitted")
    pyplot.xlabel("length of the block over that at rest")
    pyplot.ylabel("force [N]")
    pyplot.legend()
    pyplot.savefig(folder + "/force_length.png")
    return fit, list(TRUTH.values())


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
