# SPDX-License-Identifier: BSD-3-Clause
"""A first scene to change by hand: `waft new`."""
import csv
import io
import itertools
import math
import os

from waft.failures import InputError
from waft.files import check_target
from waft.reading import read_text
from waft.scene.builder import Scene

RATE = 30  # frames per second
FLIGHT = 7.0  # s to a first word or picture
BETWEEN = 5.0  # s from one to the next
AFTER = 1.5  # s in which they part again
SPEED = 0.5  # m/s along a curve: what drifts well
HOLD = 0.15  # m about the points of a curve
HIGH, WIDEST = 1.0, 3.2  # m, of a letter and of a word
GUST, STRENGTH, GONE = 2.5, 6.0, 3.0  # m/s of the front's edge, m/s^2, and s in which it carries all out
AWAY = {"left": (-1, 0, 0), "right": (1, 0, 0), "back": (0, 1, 0), "top": (0, 0, 1)}
THIN = set("iIlj1.,:;'|!()[] ")
MOST_POINTS = 100000  # of a curve
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
SURFACES = (".vtp", ".obj", ".ply", ".stl", ".glb")


def new_scene(path, texts=(), images=(), curves=(), obstacles=(), shape="maple", count=60, release=None, arrive=None, order=None,
              hold=0, blow_away=None, loop=False):
    """Writes a commented scene that flies: texts and images in the order given, formed one after the other by `count` bodies of a
    built-in shape; for each curve a body that follows it; obstacles from files. release and arrive: first and last frame between which
    bodies are let go, and come to the first form (windows of those after it are as long); order: in which they come; hold: frames for
    which each form stays; blow_away: the side by which a front carries the last one out; loop: after the last form all go back to where
    they begin, over and over. Raises InputError where there is a file, of files and texts that no scene can use, and of times that do
    not fit."""
    check_target(path)
    if not str(path).endswith(".waft.json"):
        raise InputError(f"{path}: expected a name that ends with .waft.json")
    for text in texts:
        if not text.strip():
            raise InputError("--text: expected a word, found blanks")
    for files, kinds in ((images, PICTURES), (obstacles, SURFACES)):
        for file in files:
            if not str(file).lower().endswith(kinds):
                raise InputError(f"{file}: expected a file that ends with {', '.join(kinds)}")
    courses = [_course(curve) for curve in curves]
    if not (texts or images or curves):
        texts = ["WAFT"]
    forms = [{"text": text} for text in texts] + [{"image": image} for image in images]
    first, end = arrive or (round(RATE * FLIGHT),) * 2
    if loop and (blow_away or courses):
        raise InputError("--loop: expected words or pictures whose bodies stay, found " + ("--blow-away" if blow_away else "--path"))
    if order is not None and first == end:
        raise InputError("--order: expected a window of arrivals beside it, as --arrive 4s..8s")
    if release is not None and release[1] >= first:
        raise InputError(f"--release: expected the last one before the first arrival at frame {first}, found frame {release[1]}")
    apart = end - first + hold + round(RATE * BETWEEN)  # from a form to the next
    if blow_away:
        hold = hold or RATE
        apart = end - first + hold + round(RATE * BETWEEN)
    windows = [(first + apart * place, end + apart * place) for place in range(len(forms))]
    last = windows[-1][1] + hold if windows else 0
    ends = last  # of the last form
    last += round(RATE * GONE) if blow_away else 0
    last = max([last, *(len(course) - 1 for course in courses)]) + round(RATE * (FLIGHT if loop else AFTER))

    scene = Scene(f"Made by waft new: {', '.join([*texts, *map(os.path.basename, (*images, *curves))])}"[:200],
                  comment="Fields that begin with _ are comments. Metres, seconds; z is up; frames are counted from 0. Fly it: "
                          "waft synthesize THIS --output out --preview. See it again at each change: --watch. What is hard: "
                          "waft check THIS.")
    scene.set_time(last + 1, RATE, loop=loop or None, comment="more frames between marks: a calmer flight")
    sides = ["top", {"left": "x", "right": "x", "back": "y"}.get(blow_away)] if blow_away else []
    scene.set_domain((-2, -2, 0), (2, 2, 4), open=[side for side in sides if side] or None,
                     comment="the volume; its sides are walls, but for those that are open")
    scene.add_shape("body", shape, comment="leaf, maple, oak, willow, aspen, feather, down, petal, bubble or disc; size [m] and "
                                           "settlingSpeed [m/s] may be given, too")
    for file in obstacles:
        up = {} if str(file).lower().endswith(".glb") else {"up": "y" if str(file).lower().endswith(".obj") else "z"}
        scene.add_mesh(file, position=(0, 0, 0), scale=1, **up, comment="a closed surface, metres: scale and position put it where it "
                                                                        "is to be; up is the file's axis that is up")
    bodies = []
    if forms:
        bodies = scene.add_objects("body", count=count, region={"min": (-1.6, -1.2, 2.2), "max": (1.6, 1.2, 3.7)},
                                   release=_frames(release) if release else None, comment="spread in this box at frame 0")
    for course in courses:
        body = scene.add_object("body", course[0], comment="follows a curve")
        scene.add_path(body, 1, course[1:], radius=HOLD, comment=f"one point a frame, within {HOLD:g} m; the curve at {SPEED:g} m/s")
    exact = {"hold": hold} if hold else {"radius": 0.02}
    for window, form in zip(windows, forms):
        width = min(WIDEST, HIGH * _breadth(form["text"])) if form.get("text") else 2.4
        scene.add_keyframe(_frames(window), **form, order=order, origin=(0, 0, 1.9), u=(1, 0, 0), v=(0, 0, 1), width=width, count=len(bodies),
                           objects=bodies if courses else None, **exact,
                           leave=_leaving(blow_away, ends, width) if blow_away and form is forms[-1] else None,
                           comment="upright, seen from the front; velocity \"rest\", v [0, 1, 0] and a low origin: lying on the ground")
    if blow_away and forms:
        away = AWAY[blow_away]
        scene.add_front(away, GUST, STRENGTH, width=8.0, start_frame=ends, origin=[-0.5 * width * part for part in away],
                        comment="its edge is where the last form begins when the hold ends; what lies is lifted as it passes")
    scene.save(path, is_new=True)
    return scene


def _leaving(side, frame, width):
    """One after another, as the front passes."""
    return {"side": side, "frame": {"from": frame, "to": frame + round(RATE * width / GUST)}, "order": {"direction": list(AWAY[side])}}


def _frames(window):
    """A frame, or a window of frames."""
    first, last = window
    return first if first == last else {"from": first, "to": last}


def _breadth(text):
    """About how wide a text is where its letters are 1 high: letters of a sans, without the margins of the outer two."""
    return sum(0.3 if letter in THIN else 0.7 for letter in text) - 0.2


def _course(path):
    """One point a frame along a curve, at an even speed."""
    points = _points(path)
    steps = [math.dist(a, b) for a, b in zip(points, points[1:])]
    along = [0.0, *itertools.accumulate(steps)]
    if along[-1] <= SPEED / RATE:
        raise InputError(f"{path}: expected a curve longer than {SPEED / RATE:.2g} m, found {along[-1]:.2g} m")
    count = math.ceil(along[-1] / SPEED * RATE)
    if count > MOST_POINTS:
        raise InputError(f"{path}: expected a curve of {MOST_POINTS / RATE * SPEED:.0f} m at most, found {along[-1]:.3g} m; units are metres")
    course, piece = [], 0
    for frame in range(count + 1):
        at = min(along[-1] * frame / count, along[-1])
        while piece < len(steps) - 1 and along[piece + 1] < at:
            piece += 1
        share = (at - along[piece]) / steps[piece] if steps[piece] > 0.0 else 0.0
        course.append([round(a + min(share, 1.0) * (b - a), 6) for a, b in zip(points[piece], points[piece + 1])])
    return course


def _points(path):
    """The rows x,y,z of a file; a first row of words is its head."""
    points = []
    text = read_text(path, what="rows x,y,z [m]")
    try:
        for number, row in enumerate(csv.reader(io.StringIO(text, newline="")), 1):
            try:
                point = [float(cell) for cell in row]
            except ValueError:
                point = []
            if len(point) == 3 and all(map(math.isfinite, point)):
                points.append(point)
            elif row and number > 1:
                raise InputError(f"{path}: line {number}: expected three numbers x,y,z, found {','.join(row)[:80]}")
    except csv.Error as error:
        raise InputError(f"{path}: expected rows x,y,z [m]: {error}") from error
    if len(points) < 2:
        raise InputError(f"{path}: expected rows x,y,z [m], two at least, found {len(points)}")
    return points
