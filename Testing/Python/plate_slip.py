# SPDX-License-Identifier: BSD-3-Clause
"""How far the Slip of a run is from what its poses say by the law of a plate, as `waft measure` has it (measuring/_platelaw.py): from
the files of the run, which are read without Waft.

    plate_slip.py RUN        RUN: a folder of results, flown with --keep air; prints how far its Slip is from that by body
"""
import pathlib
import sys

import numpy as np

import result_files
from waft.measuring._platelaw import FACTORS, Plate, gradients_of, matrices, slips_of

FORGOTTEN = 1.8  # s, in which drag forgets what it began with


def air_gradients(folder, places, step):
    """d u_r / d x_c [1/s] of the air's velocity of a run, [body, frame, 3, 3], at places [body, frame, 3]."""
    times, files = result_files.read_series(pathlib.Path(folder) / "air.pvd")
    frames = np.arange(places.shape[1])
    at = np.interp(frames * step, times, np.arange(len(times)))
    result = np.zeros((*places.shape, 3))
    for index, file in enumerate(files):
        image = result_files.ImageData(file)
        values = np.array(image.point["Velocity"], float).reshape(*image.dimensions[::-1], 3)
        for frame in frames[np.abs(at - index) < 1.0 - 1e-6]:
            share = 1.0 - abs(at[frame] - index)
            result[:, frame] += share * gradients_of(values, np.array(image.origin), np.array(image.spacing), places[:, frame])
    return result


def recomputed(folder):
    """Slip of every frame of bodies that glide, {object: [frame, 3]}: by the law from that of the first frame on; by the law
    alone, from a fall broadside on, which is right when that is forgotten; and that of the run."""
    folder = pathlib.Path(folder)
    data = result_files.PolyData(folder / "poses.vtp")
    step, density = 1.0 / data.field["FramesPerSecond"][0], data.field["AirDensity"][0]
    meshes, lines, numbers = result_files.read_shape_meshes(folder), np.array(data.lines), data.cell["ObjectId"]
    poses, rates, flown = (np.array(data.point[name])[lines] for name in ("Orientation", "AngularVelocity", "Slip"))
    gradients = air_gradients(folder, np.array(data.points)[lines], step)
    objects = result_files.PolyData(folder / "objects.vtp").point
    settling = dict(zip(objects["ObjectId"], objects["SettlingSpeed"]))
    same = {}  # bodies of one shape
    for index, number in enumerate(numbers):
        if data.cell["BroadsideSpeed"][index] > 0.0:
            same.setdefault(str(meshes[number]), []).append(index)
    own, alone = {}, {}
    for which in same.values():
        twice = which + which
        of = {name: np.array(data.cell[name])[twice] for name in FACTORS}
        of["SettlingSpeed"] = np.array([settling[numbers[index]] for index in twice])
        falling = np.array([[0.0, 0.0, -data.cell["BroadsideSpeed"][index]] for index in which])
        slips = slips_of(Plate(*meshes[numbers[which[0]]]), of, density, step, matrices(poses[twice]), rates[twice],
                         gradients[twice], np.concatenate([flown[which, 0], falling])[:, None])
        own.update((numbers[index], slips[place]) for place, index in enumerate(which))
        alone.update((numbers[index], slips[len(which) + place]) for place, index in enumerate(which))
    return own, alone, {number: flown[index] for index, number in enumerate(numbers) if number in own}


def main(folder):
    own, _, theirs = recomputed(folder)
    for number in own:
        away = np.linalg.norm(own[number] - theirs[number], axis=1)
        print(f"object {number}: rms {np.sqrt(np.mean(away**2)):.4f}, in the median {np.median(away):.4f} m/s")


if __name__ == "__main__":
    main(sys.argv[1])
