# SPDX-License-Identifier: BSD-3-Clause
"""The picture of the panel: Blender's window with the file that blender_word.py made, on a virtual screen.

xvfb-run -a -s "-screen 0 1280x800x24 -noreset" blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 \\
    --python Documentation/scripts/make_blender_panel.py -- FILE.blend PICTURE.png [FRAME]
"""
import sys
import traceback

import addon_utils
import bpy

FILE, PICTURE, *FRAME = sys.argv[sys.argv.index("--") + 1:]
TABS, TAB = 8, 26  # at most, of the sidebar; pixels from one to the next


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area


def click(window, x, y):
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, x=x, y=y)


def steps():
    window, area = view()
    space = area.spaces.active
    space.show_region_ui = True
    space.region_3d.view_perspective = "CAMERA"
    space.overlay.show_relationship_lines = False
    space.shading.color_type = "MATERIAL"
    yield 1.0
    # Tabs are at the right edge of the sidebar; ours is the last that a click finds.
    sidebar = next(region for region in area.regions if region.type == "UI")
    for number in range(TABS):
        click(window, sidebar.x + sidebar.width - 10, sidebar.y + sidebar.height - 30 - number * TAB)
        yield 0.3
    with bpy.context.temp_override(window=window, area=area, region=sidebar):
        bpy.ops.waft.check()
    bpy.context.scene.frame_set(int(FRAME[0]) if FRAME else 120)
    leaf = bpy.context.scene.objects["Leaf 0"]
    for thing in bpy.context.scene.objects:
        thing.select_set(thing is leaf)
    bpy.context.view_layer.objects.active = leaf
    yield 1.0
    with bpy.context.temp_override(window=window):
        bpy.ops.screen.screenshot(filepath=PICTURE)


def run():
    try:
        return next(STEPS)
    except StopIteration:
        pass
    except Exception:  # a window that stays open would wait for ever
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


addon_utils.enable("waft_addon", default_set=True)
bpy.context.preferences.view.show_splash = False
bpy.ops.wm.open_mainfile(filepath=FILE, load_ui=False)
STEPS = steps()
bpy.app.timers.register(run, first_interval=2.0, persistent=True)
