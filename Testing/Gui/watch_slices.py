# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a scene with feathers, in
a quality that takes long; notes, a line a look, how far the work is, and what the window draws. When the work was held and has gone on
it saves frames; then it changes file and quality to what is soon done, compares with a run all at once, and ends ParaView."""
import os
import time

from paraview import simple
from watching import SCENE, animation_of_the_menu, digest, end, has_bodies, view, wait_until, watch, write

import waft

FULL, PREVIEW = 2, 0  # of Quality
PICTURES = 4          # that are drawn while they are counted
RESTS = 2.0           # s that Stop is watched
SHORT = SCENE.replace("kept", "short")


def make_scene(path, feathers, frames):
    scene = waft.Scene(seed=5)
    scene.set_time(frames)
    scene.add_objects("feather", positions=[(-0.6, -0.5 + 0.5 * feather, 2.6) for feather in range(feathers)])
    for feather in range(feathers):
        scene.add_position(feather, frames // 2, (0.3, -0.4 + 0.4 * feather, 2.1))
        scene.add_position(feather, frames - 10, (0.5, 0.2 - 0.4 * feather, 1.5))
    scene.save(path)


make_scene(SCENE, 3, 480)  # so long that Stop is pressed before it has flown
make_scene(SHORT, 1, 60)
began = time.monotonic()
steps = ["flies", "rests", "flies again", "counts", "ends"]
counting = 0.0
rest = {}
drawing = {"pictures": 0, "began": 0.0, "seconds": 0.0}
is_hooked = False


def note(**line):
    write({"wall": time.monotonic() - began, "processor": time.process_time(), **line})


def on_start(*_):
    drawing["began"] = time.monotonic()


def on_end(*_):
    drawing["pictures"] += 1
    drawing["seconds"] += time.monotonic() - drawing["began"]


def save(animation):
    """Frames and data of all time steps, while the work is not done; the window's events come through meanwhile."""
    folder = os.path.dirname(SCENE)
    for name, write_it in (
            ("film", lambda: simple.SaveAnimation(os.path.join(folder, "frame.png"), view, ImageResolution=[80, 60], FrameWindow=[0, 9])),
            ("data", lambda: simple.SaveData(os.path.join(folder, "meshes.pvd"), animation, WriteTimeSteps=1))):
        played = set()
        scene_of_session = simple.GetAnimationScene()
        observer = scene_of_session.SMProxy.AddObserver("PropertyModifiedEvent", lambda *_: played.add(digest(animation)))
        before = digest(animation)
        write_it()
        scene_of_session.SMProxy.RemoveObserver(observer)
        note(save=name, motions=sorted(played | {before, digest(animation)}), frames=len(played))


def finish(animation):
    flown = digest(animation)
    once = simple.WaftAnimation(FileName=animation.FileName)
    simple.UpdatePipeline(proxy=once)
    note(flown=flown, once=digest(once), saved=animation.Slice, slices=[made.GetClientSideObject().GetSlice() for made in (animation, once)],
         text=animation.GetClientSideObject().GetProgressText())
    end()


def follow(animation, source):
    """From one step to the next."""
    global counting
    now = time.monotonic()
    step, is_held, done = steps[0], source.GetWorkState() == source.HELD, source.GetWorkDone()
    if step == "flies" and is_held:  # for a picture it waits less than that
        then = time.process_time()
        wait_until(lambda: source.GetWorkState() != source.HELD or time.monotonic() - now > RESTS)
        if source.GetWorkState() == source.HELD:
            steps.pop(0)
            rest.update(before=done, after=source.GetWorkDone(), rested=time.monotonic() - now, used=time.process_time() - then)
    elif step == "rests" and not is_held:
        steps.pop(0)
        note(**rest)
    elif step == "flies again" and done > rest["after"]:
        steps.pop(0)
        save(animation)
        drawing.update(pictures=0, seconds=0.0)
        counting = time.monotonic()
    elif step == "counts" and drawing["pictures"] >= PICTURES:
        steps.pop(0)
        note(counted=now - counting, **drawing, left=source.GetSecondsLeft(), message=source.GetWorkText())
        animation.FileName = SHORT
        animation.Quality = PREVIEW
        simple.UpdatePipeline(proxy=animation)


def look():
    global is_hooked
    animation = animation_of_the_menu(Quality=FULL)
    if animation is None:
        return
    if not is_hooked:
        is_hooked = True
        view.GetRenderWindow().AddObserver("StartEvent", on_start)
        view.GetRenderWindow().AddObserver("EndEvent", on_end)
    if not has_bodies(animation):
        note(waits=True)  # for Apply
        return
    source = animation.GetClientSideObject()
    meshes, poses = source.GetOutputDataObject(0), source.GetOutputDataObject(1)
    complete = source.GetComplete()
    note(complete=complete, points=poses.GetNumberOfPoints(), bodies=meshes.GetNumberOfPoints(),
         flagged=meshes.GetFieldData().HasArray("Complete"), work=source.GetWorkDone(), step=steps[0])
    if complete:
        finish(animation)
    follow(animation, source)


watch(look, ends=True)
