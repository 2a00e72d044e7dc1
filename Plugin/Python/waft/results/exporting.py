# SPDX-License-Identifier: BSD-3-Clause
"""A result with its surroundings for other programs: `waft export`. See Documentation/Export.md."""
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from waft.beneath import Folder
from waft.failures import InputError, WaftError
from waft.files import copy_file, write_bytes
from waft.page import _pagedata
from waft.render._cameras import Cameras
from waft.results import _folder
from waft.results._gltf import Gltf, y_up
from waft.results.place import ResultPlace

_GROUND, _STONE = (0.42, 0.38, 0.32), (0.5, 0.5, 0.52)
_ASPECT = 16.0 / 9.0
_IN_BLENDER = pathlib.Path(__file__).resolve().parent / "_inblender.py"
_LACKING = 4  # what _inblender.py ends with where Blender was built without the format


def export(folder, to, parts):
    """Writes FOLDER/scene.TO (glb, abc or usd), the animation with parts of its surroundings (of ground, obstacles, marks, camera), and its
    manifest, FOLDER/export-TO.json; returns the path.

    Raises InputError on a bad folder, and where a file is in the way that Waft did not write or that was changed since; WaftError
    where abc or usd is asked for and there is no Blender that writes it.
    """
    if not os.path.isdir(folder):
        raise InputError(f"{folder}: no such folder; `waft synthesize` makes it")
    name = f"scene.{to}"
    with ResultPlace(folder, f"export-{to}.json") as place:
        place.check([name])
        animation, rate, frames = _with_surroundings(folder, parts)
        if to == "glb":
            write_bytes(place.path(name), animation)
        else:
            _by_blender(animation, place.path(name), rate, frames)
        place.commit({})
    return os.path.join(folder, name)


def _with_surroundings(folder, parts):
    """(bytes of a .glb, frames a second, number of frames)"""
    below = Folder(folder)
    animation, _, rate, frames, origin = _pagedata.animation_of(below)
    gltf = Gltf(animation, np.array(origin))
    timing = {"framesPerSecond": rate, "firstFrame": 0, "lastFrame": frames - 1}
    for holder in (gltf.content["asset"], gltf.content["scenes"][0]):
        holder["extras"] = {**holder.get("extras", {}), **timing}
    bounds = _folder.volume_of(below)
    for obstacle in _folder.moving_obstacles(below, bounds, rate, frames):
        if obstacle.ground is not None:
            if "ground" in parts:
                _add_ground(gltf, bounds, obstacle.ground)
        elif "obstacles" in parts:
            _add_obstacle(gltf, obstacle, rate)
    if "marks" in parts:
        for mark in _pagedata.marks_of(below):
            _add_mark(gltf, mark)
    if "camera" in parts:
        _add_camera(gltf, folder)
    return gltf.data(), rate, frames


def _add_ground(gltf, bounds, height):
    x0, x1, y0, y1 = bounds[:4]
    middle = np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1), height])
    corners = np.array([(x0, y0, height), (x1, y0, height), (x1, y1, height), (x0, y1, height)]) - middle
    mesh = gltf.add_mesh("ground", corners, np.array([(0, 1, 2), (0, 2, 3)]), _GROUND)
    gltf.add_node("ground", middle, mesh=mesh)


def _add_obstacle(gltf, obstacle, rate):
    name = f"obstacle-{obstacle.number}"
    middle = 0.5 * (obstacle.points.min(axis=0) + obstacle.points.max(axis=0))
    node = gltf.add_node(name, middle, mesh=gltf.add_mesh(name, obstacle.points - middle, obstacle.triangles, _STONE))
    if obstacle.shifts is not None:
        gltf.move_node(node, middle + obstacle.shifts, rate)


def _add_mark(gltf, mark):
    for frame, x, y, z, radius in mark["places"]:
        gltf.add_node(f"mark-{mark['row']}-{mark['target']}-{frame}", (x, y, z), extras={
            "frame": frame, "radius": radius, "ObjectId": mark["object"], "kind": mark["kind"], "status": mark["status"]})


def _add_camera(gltf, folder):
    """The camera of the pictures from the side, which has all of the motion in sight."""
    camera = Cameras(_folder.load(folder), _ASPECT).at("side", 0)
    back = -y_up(camera.GetDirectionOfProjection())
    right = np.cross(y_up((0.0, 0.0, 1.0)), back)
    right /= np.linalg.norm(right)
    near, far = camera.GetClippingRange()
    number = gltf.add_camera("camera", np.radians(camera.GetViewAngle()), near, far)
    gltf.add_node("camera", camera.GetPosition(), camera=number,
                  rotation=_quaternion(np.column_stack([right, np.cross(back, right), back])))


def _quaternion(turn):
    """x, y, z, w of a rotation matrix that turns by less than a half turn."""
    w = 0.5 * np.sqrt(1.0 + np.trace(turn))
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return [*(axis / (4.0 * w)).tolist(), float(w)]


def _by_blender(animation, path, rate, frames):
    """Lets Blender write another format, and read it back."""
    blender = shutil.which("blender")
    if blender is None:
        raise WaftError(f"{path.suffix}: Blender writes it, and none was found: apt-get install --no-install-recommends blender")
    with tempfile.TemporaryDirectory(prefix="waft-export-") as folder:
        source, written = os.path.join(folder, "scene.glb"), os.path.join(folder, path.name)
        write_bytes(source, animation)
        # Blender takes Python's library from the first python3 on the PATH: that beside it is its own.
        environment = {**os.environ, "PATH": os.pathsep.join([os.path.dirname(blender), os.environ.get("PATH", "")])}
        done = subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "3", "--python", _IN_BLENDER, "--", source, written,
                               repr(rate), str(frames)], env=environment, capture_output=True, text=True, check=False)
        if done.returncode == _LACKING:
            raise WaftError(f"{path.suffix}: {blender} was built without this format (Debian's is); nothing was written")
        if done.returncode != 0 or not os.path.isfile(written):
            raise WaftError(f"{path.suffix}: Blender failed: {' '.join((done.stderr or done.stdout)[-800:].split())}")
        copy_file(written, path)
