# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while flight.xml plays: takes the pictures of the page on ParaView's window into the folder that
WAFT_GUI_PICTURES names, each when the window has come to it and what flies has flown."""
import json
import os
import sys

from paraview import simple

import waft  # noqa: F401 (the classes of its sources)

sys.path.insert(0, os.environ["WAFT_GUI_MODULES"])
import screen  # noqa: E402
from watching import has_bodies, is_in_the_air, view, wait_until, watch  # noqa: E402

FOLDER = os.environ["WAFT_GUI_PICTURES"]
MARK = (0.9, -0.3, 1.5)  # of the scene
TIME = 190 / 30  # s, when the feather is at it
DISTANCE = 3.0  # m, of the camera
NEXT_TIME = 240 / 30  # s, of the mark that is new
COVERED = 0.1  # of the screen
ROUNDS = 50  # of the window's events, in which it draws what it has


def edits(animation):
    return len(json.loads(animation.SMProxy.GetProperty("Edits").GetElement(0) or "[]"))


def layer_size():
    """Of the layer of the view that handles are in, and what is always there."""
    return view.SMProxy.GetClientSideObject().GetNonCompositedRenderer().GetActors().GetNumberOfItems()


def show_handle():
    """The screen's own pointer goes to the middle of the view, where the mark is: a tip comes up beside it."""
    middle = [length // 2 for length in view.GetRenderWindow().GetSize()]
    x, y = (length // 2 for length in screen.size())
    for _ in range(2):  # the first tells where the view is
        screen.move_pointer(x, y)
        draw_all()
        at = view.GetInteractor().GetEventPosition()
        x, y = x + middle[0] - at[0], y - (middle[1] - at[1])


def play_to_mark():
    """The mark comes to the middle of the view, where the event script's pointer goes."""
    simple.GetAnimationScene().AnimationTime = TIME
    camera = view.GetActiveCamera()
    ahead = camera.GetDirectionOfProjection()
    camera.SetFocalPoint(MARK)
    camera.SetPosition([at - DISTANCE * way for at, way in zip(MARK, ahead)])
    view.StillRender()


def play_on():
    simple.GetAnimationScene().AnimationTime = NEXT_TIME


def draw_all():
    """A change of the scene flies when the window comes to it."""
    rounds = 0

    def is_drawn():
        nonlocal rounds
        rounds = 0 if is_in_the_air() else rounds + 1
        return rounds > ROUNDS

    wait_until(is_drawn)


def keep_screen():
    global kept
    kept = screen.pixels()


def is_another_window():
    """Whether one has come before ParaView's, or gone."""
    return (screen.pixels() != kept).any(axis=2).mean() > COVERED


def look():
    animation = next(iter(simple.GetSources().values()), None)
    if not STEPS or animation is None or not animation.FileName:
        return
    name, is_there, first, then = STEPS[0]
    if is_there(animation):
        draw_all()
        if first is not None:
            first()
        screen.save(os.path.join(FOLDER, name + ".png"), step=2)
        STEPS.pop(0)
        if then is not None:
            then()


# Name of a picture, when the window has come to it, and what is done before and after it is taken.
STEPS = [("window_open", has_bodies, None, play_to_mark),
         ("window_edit", lambda animation: layer_size() > without_handles, show_handle, None),
         ("window_dragged", lambda animation: edits(animation) == 1, None, play_on),
         ("window_marked", lambda animation: edits(animation) == 2, keep_screen, None),
         ("window_help", lambda animation: is_another_window(), None, None)]
without_handles = layer_size()
kept = None  # what the screen showed
watch(look)
