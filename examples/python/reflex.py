#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A stretch reflex holds a load: reflex.py FOLDER

A weight hangs on a muscle with its tendon, x'' = g (1 - F/W). At 1 s it becomes half as heavy again. Without a reflex the excitation stays, and
the muscle gives way; with one, the excitation follows the length of the unit and its rate, as they were 30 ms ago. The simulation is advanced
by a millisecond at a time: the force that it measures moves the load, and the load moves its end.
"""

import collections
import sys

import myolines

LENGTH, EXCITATION = "system/input/length", "system/input/excitation"
GRAVITY, STEP, DELAY = 9.81, 1e-3, 0.03


def hanging_unit():
    scene = myolines.Scene.template("muscle-tendon unit", "sdirk3")
    scene.update({
        "system/masses": 0, "system/activation": "unknown", "system/damping": 0.1, "system/data/optimal unit length": 0.45,
        "system/input": {"type": "profiles", "length": {"type": "steered", "value": 0.45}, "excitation": {"type": "steered", "value": 0.3}},
        "time/end": 3, "time/step": STEP})
    return scene


def held(gain, rate_gain):
    """Times, lengths [m] and excitations while the reflex with these gains [1/m], [s/m] holds the load."""
    simulation = myolines.Simulation(hanging_unit())
    weight = simulation.measure("tendon force/F0")  # what it holds at the start
    start = length = simulation.value_of(LENGTH)
    speed = 0.0
    past = collections.deque([(length, speed)] * round(DELAY / STEP))
    times, lengths, excitations = [], [], []
    while simulation.t < simulation.end - STEP / 2:
        load = weight if simulation.t < 1 else 1.5 * weight
        speed += STEP * GRAVITY * (1 - simulation.measure("tendon force/F0") / load)
        length += STEP * speed
        past.append((length, speed))
        felt_length, felt_speed = past.popleft()
        simulation.set(EXCITATION, min(1.0, max(0.0, 0.3 + gain * (felt_length - start) + rate_gain * felt_speed)))
        simulation.ramp(LENGTH, length, STEP)
        simulation.advance(STEP)
        times.append(simulation.t)
        lengths.append(length)
        excitations.append(simulation.value_of(EXCITATION))
    return times, lengths, excitations


def main(folder):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (above, below) = pyplot.subplots(2, sharex=True)
    sunk = {}
    for name, gains in (("no reflex", (0, 0)), ("reflex", (15, 1.5))):
        times, lengths, excitations = held(*gains)
        above.plot(times, [1e3 * length for length in lengths], label=name)
        below.plot(times, excitations, label=name)
        sunk[name] = 1e3 * (lengths[-1] - lengths[0])
        print(f"{name}: the load sinks by {sunk[name]:.1f} mm, the excitation ends at {excitations[-1]:.2f}")
    above.set_ylabel("length [mm]")
    below.set_ylabel("excitation")
    below.set_xlabel("time [s]")
    above.legend()
    figure.savefig(folder + "/reflex.png")
    return sunk


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
