#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints megabytes and processor seconds of the files of a long run of many objects, and of the same written the former way
(base64, all digits of everything, an image of the air each frame). By one thread.

    pvpython benchmark_results.py [objects [frames [points along a side of the air's lattice]]]      1000 300 37
"""
import os
import pathlib
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import waft  # noqa: F401 (loads the plugin)
from waft.files import half, write_xml
from waft.results.place import Entry
from waft.results.writing import AIR_INTERVAL, spaced, write_tracks
from waft.vtkWaftFilters import vtkMotionAnimationWriter

RATE = 30.0


def tracks(objects, frames, random):
    """Poses of bodies on sums of swings, with all arrays that poses have."""
    time_of = np.arange(frames) / RATE

    def swings(width, typical):
        values = np.zeros((objects, frames, width))
        for period in (4.0, 1.3, 0.6):
            phase = random.uniform(0.0, 2.0 * np.pi, (objects, 1, width))
            values += typical * period / 4.0 * np.sin(2.0 * np.pi / period * time_of[None, :, None] + phase)
        return values.reshape(-1, width)

    data = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    places = swings(3, 0.8)
    points.SetData(numpy_to_vtk(places, deep=True))
    data.SetPoints(points)
    lines = vtkCellArray()
    for first in range(0, objects * frames, frames):
        lines.InsertNextCell(frames, list(range(first, first + frames)))
    data.SetLines(lines)
    turns = swings(4, 1.0)
    columns = {"Time": np.tile(time_of, objects), "Velocity": swings(3, 0.9), "AirVelocity": swings(3, 0.9),
               "Control": swings(3, 0.1), "Orientation": turns / np.linalg.norm(turns, axis=1)[:, None],
               "AngularVelocity": swings(3, 3.0), "Torque": swings(3, 1e-6), "VortexAcceleration": np.zeros_like(places),
               "WindAcceleration": np.zeros_like(places), "Frame": np.tile(np.arange(frames, dtype=np.int32), objects),
               "VortexId": np.full(objects * frames, -1, np.int32)}
    for name, values in columns.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    ids = numpy_to_vtk(np.arange(objects, dtype=np.int32), deep=True)
    ids.SetName("ObjectId")
    data.GetCellData().AddArray(ids)
    for name, values in (("Bounds", [-3.0, 3.0, -3.0, 3.0, 0.0, 5.0]), ("NumberOfFrames", np.array([frames], np.int32)),
                         ("FramesPerSecond", [RATE]), ("AirDensity", [1.2]), ("Seed", np.array([1], np.int64))):
        array = numpy_to_vtk(np.asarray(values), deep=True)
        array.SetName(name)
        data.GetFieldData().AddArray(array)
    return data


def air(side, second):
    """An air of waves that travel, with the roughness of halves."""
    axis = np.linspace(0.0, 6.0, side, dtype=np.float32)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    data = vtkImageData()
    data.SetDimensions(side, side, side)
    for name, speed in (("Velocity", 1.0), ("Wind", 2.0)):
        values = np.zeros((side ** 3, 3), np.float32)
        for wave in range(1, 6):
            for axis_of, (a, b) in enumerate(((y, z), (z, x), (x, y))):
                values[:, axis_of] += np.sin(wave * a + 0.7 * wave * b + speed * wave ** 0.7 * second).ravel() / wave
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def former(data, path):
    writer = vtkXMLPolyDataWriter() if data.IsA("vtkPolyData") else vtkXMLImageDataWriter()
    writer.SetInputDataObject(data)
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(1)
    writer.Write()


def former_air(data, path):
    for index in range(data.GetPointData().GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetPointData().GetArray(index))
        values[...] = values.astype(np.float16)
    former(data, path)


def present_air(data, path):
    half(data)
    write_xml(data, path)


def poses_csv(data, path):
    writer = vtkMotionAnimationWriter()
    for port, block in enumerate((data, vtkPolyData())):
        writer.SetInputDataObject(port, block)
    from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

    writer.SetInputDataObject(2, vtkMultiBlockDataSet())
    writer.SetFileName(str(path))
    if not writer.Write():
        raise SystemExit(f"{path}: not written")


class Files:
    """What was written: megabytes and seconds."""

    def __init__(self, folder):
        self.folder, self.megabytes, self.seconds = folder, 0.0, 0.0

    def write(self, name, data, how):
        path = self.folder / name
        began = time.process_time()
        how(data, path)
        self.seconds += time.process_time() - began
        self.megabytes += os.path.getsize(path) / 1e6


def main(objects=1000, frames=300, side=37):
    random = np.random.RandomState(1)
    poses = tracks(objects, frames, random)
    print(f"results of {objects} objects, {frames} frames, an air of {side}^3 points, 1 thread")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        was, now, motion = Files(folder / "was"), Files(folder / "now"), Files(folder / "now")
        was.folder.mkdir()
        now.folder.mkdir()
        for name in ("planned.vtp", "optimized.vtp", "assimilated.vtp", "poses.vtp"):
            was.write(name, poses, former)
            now.write(name, poses, write_xml if name == "planned.vtp" else write_tracks)
        print(f"  tracks  {was.megabytes:6.1f} MB {was.seconds:6.2f} CPU-s as it was, {now.megabytes:6.1f} MB {now.seconds:6.2f} CPU-s now")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(now.folder / "poses.vtp"))
        reader.Update()
        same = all(np.array_equal(vtk_to_numpy(a), vtk_to_numpy(b)) for a, b in (
            (reader.GetOutput().GetPoints().GetData(), poses.GetPoints().GetData()),
            *((reader.GetOutput().GetPointData().GetArray(n), poses.GetPointData().GetArray(n))
              for n in ("Orientation", "AngularVelocity"))))
        print(f"  points, orientations and angular velocities read back {'bit for bit' if same else 'OTHERWISE'}")
        air_was, air_now = Files(was.folder), Files(now.folder)
        times = [frame / RATE for frame in range(frames)]
        kept = {step for step, _ in spaced(times, AIR_INTERVAL)}
        for step, second in enumerate(times):
            air_was.write(f"air_{step:04d}.vti", air(side, second), former_air)
            if step in kept:
                air_now.write(f"air_{step:04d}.vti", air(side, second), present_air)
        print(f"  air     {air_was.megabytes:6.1f} MB {air_was.seconds:6.2f} CPU-s as it was, {air_now.megabytes:6.1f} MB "
              f"{air_now.seconds:6.2f} CPU-s now, {len(kept)} of {frames} images")
        motion.write("poses.csv", poses, poses_csv)
        print(f"  poses.csv {motion.megabytes:4.1f} MB {motion.seconds:6.2f} CPU-s")
        began = time.process_time()
        for path in now.folder.iterdir():
            Entry.of(path)
        print(f"  digests of all, once: {time.process_time() - began:.2f} CPU-s")
        total = [sum(part) for part in zip(*((f.megabytes, f.seconds) for f in (was, air_was, motion)))]
        after = [sum(part) for part in zip(*((f.megabytes, f.seconds) for f in (now, air_now, motion)))]
        print(f"  all     {total[0]:6.1f} MB {total[1]:6.2f} CPU-s as it was, {after[0]:6.1f} MB {after[1]:6.2f} CPU-s now")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:4]))
