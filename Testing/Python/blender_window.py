# SPDX-License-Identifier: BSD-3-Clause
"""The add-on in Blender's window: a run while Blender goes on, its take, and undo. test_blender.py runs it on a virtual screen:

blender --python blender_window.py -- FOLDER WAFT           FOLDER/said.txt holds what is wrong, "all well" where nothing is

What a timer does is done between events, as a user's clicks are; each step of `steps` yields the seconds to wait for.
"""
import pathlib
import sys
import traceback

import addon_utils
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import blender_scenes as scenes  # noqa: E402

addon_utils.enable("waft_addon", default_set=True)

from waft_addon import flying  # noqa: E402

FOLDER, WAFT = sys.argv[sys.argv.index("--") + 1:][:2]
MOST = 240  # s of a run


def in_view(act):
    """Does something as if the mouse were over the 3D view."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        return act()


def expect(holds, what):
    if not holds:
        raise AssertionError(f"expected {what}; {[problem.text for problem in flying.found]}")


def leaf_state():
    leaf = bpy.data.objects["Leaf"]
    action = leaf.animation_data.action.name if leaf.animation_data and leaf.animation_data.action else None
    return action, leaf.rotation_mode, [take.name for take in bpy.context.scene.waft.takes], len(bpy.data.actions)


BEFORE = (None, "XYZ", [], 0)
FLOWN = ("take-001 Leaf", "QUATERNION", ["take-001"], 1)


def steps():
    before = leaf_state()
    expect(in_view(lambda: bpy.ops.waft.check("INVOKE_DEFAULT")) == {"RUNNING_MODAL"}, "a check beside Blender")
    expect(flying.looking is not None, "it not to wait")
    for _ in range(10 * MOST):
        yield 0.1
        if flying.looking is None:
            break
    expect(flying.found.title.startswith("Ready: 1 flyer, 1 mark or target"), f"a scene that is ready, found {flying.found.title}")
    expect(leaf_state() == before, "nothing to change")
    in_view(lambda: bpy.ops.ed.undo_push(message="Made"))
    expect(in_view(lambda: bpy.ops.waft.fly("INVOKE_DEFAULT")) == {"RUNNING_MODAL"}, "a run beside Blender")
    reported = set()
    for _ in range(10 * MOST):
        yield 0.1
        if flying.running is None:
            break
        reported.add(flying.running.flight.fraction)
        expect(leaf_state() == BEFORE, "nothing to change meanwhile")
    expect(flying.running is None, f"an end within {MOST} s")
    expect(len(reported) > 1, "progress")
    yield 0.5
    expect(leaf_state() == FLOWN, f"a take, found {leaf_state()}")
    in_view(bpy.ops.ed.undo)
    yield 0.5
    expect(leaf_state() == BEFORE, f"one undo to take it away, found {leaf_state()}")
    in_view(bpy.ops.ed.redo)
    yield 0.5
    expect(leaf_state() == FLOWN, f"redo to bring it back, found {leaf_state()}")
    # Another one, stopped by its button.
    in_view(lambda: bpy.ops.waft.fly("INVOKE_DEFAULT"))
    yield 0.2
    in_view(bpy.ops.waft.stop)
    for _ in range(300):
        yield 0.1
        if flying.running is None:
            break
    # Where the plan was ready before it was stopped, the motion so far is a take, too, and is kept as a stopped one.
    stopped = [take.is_stopped for take in bpy.context.scene.waft.takes[1:]]
    left = FLOWN if not stopped else ("take-002 Leaf", "QUATERNION", ["take-001", "take-002"], 2)
    expect(flying.running is None and leaf_state() == left and all(stopped), f"a stopped run to leave the take, found {leaf_state()}")


def run():
    try:
        return next(STEPS)
    except StopIteration:
        said = "all well"
    except Exception:  # what is wrong is told, and Blender ends
        said = traceback.format_exc()
    flying.drop()
    (pathlib.Path(FOLDER) / "said.txt").write_text(said, encoding="utf-8")
    bpy.ops.wm.quit_blender()
    return None


scenes.small_scene()
bpy.context.preferences.addons["waft_addon"].preferences.command = WAFT
bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(FOLDER) / "window.blend"))
STEPS = steps()
bpy.app.timers.register(run, first_interval=2.0, persistent=True)
