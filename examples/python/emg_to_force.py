#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A motion of OpenSim and raw EMG become the force of a muscle: emg_to_force.py FOLDER [LENGTHS.sto EMG.csv]

LENGTHS.sto is what OpenSim's muscle analysis writes: lengths of muscles with their tendons over time. EMG.csv has raw samples in mV. Without
them the script writes two such files first: a synthetic gait, and noise under two bursts a cycle.
"""

import sys

import numpy as np

import myolines

MUSCLE = "semiten_r"


def write_files(folder):
    t = np.linspace(0, 2, 401)
    length = 0.46 * (1 + 0.02 * np.sin(2 * np.pi * 1.4 * t))
    with open(folder + "/lengths.sto", "w") as stream:
        stream.write(f"Length\nversion=1\nnRows={len(t)}\nnColumns=2\ninDegrees=no\nendheader\ntime\t{MUSCLE}\n")
        stream.writelines(f"{a:.4f}\t{b:.6f}\n" for a, b in zip(t, length))
    t = np.linspace(0, 2, 2001)
    bursts = np.exp(-40 * (np.mod(1.4 * t, 1) - 0.3) ** 2) + 0.5 * np.exp(-80 * (np.mod(1.4 * t, 1) - 0.8) ** 2)
    emg = (0.05 + 1.2 * bursts) * np.random.default_rng(4).standard_normal(len(t))
    with open(folder + "/emg.csv", "w") as stream:
        stream.write("time [s],ST [mV]\n")
        stream.writelines(f"{a:.4f},{b:.5f}\n" for a, b in zip(t, emg))
    return folder + "/lengths.sto", folder + "/emg.csv"


def main(folder, lengths=None, emg=None):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    if lengths is None:
        lengths, emg = write_files(folder)
    scene = myolines.Scene.template("muscle-tendon unit")
    scene.update({
        "system/masses": 0, "system/muscle": "ST", "system/task": "running", "system/data/optimal unit length": (460, "mm"),
        "system/input": {
            "type": "profiles",
            "length": {"type": "file", "file": lengths, "column": MUSCLE, "unit": "m"},
            "excitation": {"type": "file", "file": emg, "rectify": True, "low-pass": 6, "normalise": "maximum"}},
        "time/start": 0.1, "time/end": 1.9, "output/series/interval": 0.01})
    run = myolines.run(scene, folder + "/emg_to_force", overwrite=True)
    table = run["muscle_tendon"]
    figure, (above, below) = pyplot.subplots(2, sharex=True)
    above.plot(table["Time"], table["excitation"], label="excitation")
    above.plot(table["Time"], table["activation"], label="activation")
    above.legend()
    below.plot(table["Time"], table["tendon force/F0"])
    below.set_ylabel("force over F0")
    below.set_xlabel("time [s]")
    figure.savefig(folder + "/emg_to_force.png")
    greatest = int(np.argmax(table["tendon force/F0"]))
    print(f"greatest force: {table['tendon force/F0'][greatest]:.2f} F0 at {table['Time'][greatest]:.2f} s")
    return run


if __name__ == "__main__":
    main(*(sys.argv[1:] or ["."]))
