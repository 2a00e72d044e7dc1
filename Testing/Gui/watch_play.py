# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene; notes each
picture that the window draws, and what the picture is when the work is done; when Play has come to the last frame it writes a film,
and ends ParaView."""
import pathlib
import time

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from watching import SCENE, animation_of_the_menu, end, has_bodies, steps, view, watch, write

import waft
from waft import showing

FRAMES = 40
scene = waft.Scene(seed=5)
scene.set_time(FRAMES)
scene.add_shape("red", builtin="maple", size=0.25, color=(0.9, 0.15, 0.1))
scene.add_objects("red", positions=[(-0.6, -0.5, 2.6), (0.4, 0.3, 2.8)])
scene.add_position(0, 20, (0.1, 0.2, 2.3), radius=0.05)
scene.add_position(1, 35, (-0.3, 0.1, 2.2), radius=0.05)
scene.add_box((-0.2, -0.2, 1.9), (0.2, 0.2, 2.1))
scene.add_position(1, 38, (0, 0, 2))  # within the box: it cannot be met
scene.save(SCENE)
keeper = simple.GetTimeKeeper()
done = None  # when the work was; -1: looked at
hears = looks = ended = False


def picture():
    """What the window shows: rows, columns, red, green and blue."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3].astype(float)


def camera():
    return [list(view.CameraPosition), list(view.CameraFocalPoint), list(view.CameraViewUp)]


def look(animation):
    """The picture by numbers: what bodies take of it, and how they stand out against what is behind."""
    at = camera()
    bodies = simple.GetRepresentation(animation["Meshes"], view)
    whole = picture()
    bodies.Visibility = 0
    view.StillRender()
    behind = picture()
    bodies.Visibility = 1
    view.StillRender()
    apart = np.abs(whole - behind).max(axis=2)
    taken = apart > 8
    bars = [one for one in view.Representations if one.SMProxy.GetXMLName() == "ScalarBarWidgetRepresentation" and one.Visibility]
    line = {"share": float(taken.mean()), "contrast": float(apart[taken].mean()) if taken.any() else 0.0,
            "color": whole[taken].mean(axis=0).tolist() if taken.any() else [], "bars": len(bars), "camera": at,
            "steps": len(keeper.TimestepValues or []), "end": simple.GetAnimationScene().EndTime,
            "duration": simple.GetAnimationScene().Duration}
    line["looks"] = [str(simple.GetRepresentation(animation[port], view).Representation).strip("'") for port in ("Meshes", "Poses", "Obstacles", "Marks")]
    line["background"] = str(view.BackgroundColorMode).strip("'")
    showing._look_at(view, [simple.OutputPort(animation, port) for port in (0, 1, 2, 4)])  # those that are shown by themselves
    write({**line, "shown": camera()})


def step():
    global done, hears, looks
    animation = animation_of_the_menu()
    if animation is None:
        return
    if not hears:
        hears = True
        view.GetRenderWindow().AddObserver("EndEvent", drawn)
    if done is None and has_bodies(animation) and animation.GetClientSideObject().GetComplete():
        done = time.monotonic()
    elif done is not None and done > 0 and time.monotonic() - done > 1.0:  # the window has drawn it
        done = -1.0
        looks = True
        look(animation)
        looks = False
    if done == -1.0 and ended:
        looks = True
        folder = pathlib.Path(SCENE).parent
        simple.SaveAnimation(str(folder / "film.png"), view, ImageResolution=[80, 60])
        write({"film": sorted(one.name for one in folder.glob("film.*.png"))})
        end()


def drawn(*_):
    global ended
    if not looks:
        image = picture()
        write({"time": keeper.Time, "columns": np.round(image.mean(axis=(0, 2)), 3).tolist(), "steps": steps(),
               "clock": time.monotonic(), "mode": str(simple.GetAnimationScene().PlayMode).strip("'")})
        ended = ended or keeper.Time >= (FRAMES - 1.5) / 30


watch(step, ends=True)
