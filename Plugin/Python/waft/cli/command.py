# SPDX-License-Identifier: BSD-3-Clause
"""The command `waft`."""
import argparse
import json
import os
import shlex
import subprocess
import sys
import time
from typing import Callable, Optional, Sequence

from waft import failures
from waft.cli.answers import answer, tell
from waft.cli.speaking import speaking
from waft.loading import command, version
from waft.render._styles import STYLES, VIEWS
from waft.run._chain import QUALITIES, quality_of
from waft.run.request import SENTENCES, TOLD
from waft.scene._schema import definition
from waft.texts import is_utf8, line, say, shortened
from waft.watching import interruptible, report_to_guard

CLEAN_EXIT = """exit status: 0 done; 2 malformed usage, or DIR is no result; 1 anything else"""
INFO_EXIT = """exit status: 0 told; 2 malformed usage, or neither a result nor a scene; 1 anything else"""
NEW_EXIT = """exit status: 0 written; 2 malformed usage, or something is there already; 1 anything else"""

TAKES_EXIT = """exit status: that of the worst take: 0 all constraints of all takes met; 3 some not; 2 malformed scene or usage,
nothing computed; 4 stopped, the same command goes on; 1 a take failed, or anything else"""

MEASURE_EXIT = """exit status: 0 measured, whatever the figures; 2 malformed usage or a folder without the results that are
needed; 1 anything else"""


def _argument(kind, expected, accepts):
    """An argparse type: kind(text) where accepts(value), else an error that says what was expected."""
    def convert(text):
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not accepts(value):
            raise argparse.ArgumentTypeError(f"expected {expected}, found '{line(shortened(text, 100))}'")
        return value
    return convert


def _size(text):
    width, height = text.split("x")
    return int(width), int(height)


PARTS = ("ground", "obstacles", "marks", "camera")


def _names(text):
    return tuple(text.split(","))


def _parts(text):
    return () if text == "none" else _names(text)


def _speeds(text):
    return [float(speed) for speed in text.split(",")]


def _seeds(text):
    first, _, last = text.partition(":")
    return range(int(first), int(last or first) + 1)


def _whole(first, last):
    return _argument(int, f"a whole number from {first} to {last}", lambda n: first <= n <= last)


def _fits(path):
    """Whether a file system takes a path, and ParaView."""
    name = os.fsencode(path)
    return is_utf8(path) and 0 < len(name) < 4096 and all(len(part) < 256 for part in name.split(b"/"))


def _frame(text):
    """A time of a new scene as a frame: seconds end with s."""
    from waft.scene.starting import RATE

    if not text.endswith("s"):
        return int(text)
    seconds = float(text[:-1])
    if not abs(seconds) < 1e4:
        raise ValueError("no time of a scene")
    return round(RATE * seconds)


def _times(text):
    first, _, last = text.partition("..")
    return _frame(first), _frame(last or first)


times = _argument(_times, "a time or FIRST..LAST, in seconds (0s..3s) or frames (0..90), not reversed",
                  lambda t: 0 <= t[0] <= t[1] <= 100000)
duration = _argument(_frame, "a time in seconds (1s) or frames (30)", lambda n: 0 <= n <= 100000)
path = _argument(str, "a path in UTF-8 of 1 to 4095 letters, 255 in each name", _fits)
threads = _whole(1, 1024)
seed = _whole(0, 2 ** 31 - 1)
seeds = _argument(_seeds, "seeds A:B, or one, from 0 to 2147483647, at most 100000 of them",
                  lambda s: 0 < len(s) <= 100000 and s[0] >= 0 and s[-1] < 2 ** 31)
megabytes = _argument(float, "megabytes above 0, at most 1000", lambda x: 0.0 < x <= 1000.0)
millimetres = _argument(float, "millimetres from 0 to 1000", lambda x: 0.0 <= x <= 1000.0)
opacity = _argument(float, "a number from 0 to 1", lambda x: 0.0 <= x <= 1.0)
size = _argument(_size, "WxH such as 1280x720, each from 16 to 16384", lambda s: all(16 <= n <= 16384 for n in s))

speeds = _argument(_speeds, "speeds from 0 to 20 m/s with commas between", lambda all_: all(0.0 <= v <= 20.0 for v in all_))
parts = _argument(_parts, "none, or names of ground, obstacles, marks and camera with commas between",
                  lambda names: len(set(names)) == len(names) and all(name in PARTS for name in names))
views = _argument(_names, "names of hero, side, top and follow with commas between",
                  lambda names: len(set(names)) == len(names) and all(name in VIEWS for name in names))


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        """What is wrong with a command line, whatever is in it, in one line below the usage."""
        super().error(line(shortened(message)))


ANSWERING = ("info", "render", "page")  # commands that answer programs, too


def _add_common(parsed, answers):
    """The options that say how much is said, and where."""
    if answers:
        parsed.add_argument("--json", dest="as_json", action="store_true",
                            help="the answer as one JSON document on stdout, all else on stderr")
    loudness = parsed.add_mutually_exclusive_group()
    loudness.add_argument("-q", "--quiet", dest="loudness", action="store_const", const="quiet", default="normal",
                          help="say nothing but errors, warnings and what is not met")
    loudness.add_argument("-v", "--verbose", dest="loudness", action="store_const", const="verbose",
                          help="say what each stage does, too")
    parsed.add_argument("--log", type=path, metavar="FILE",
                        help="every message with its time in FILE, also those that are not shown; an older log makes room, any other "
                             "file stays")


def parser() -> argparse.ArgumentParser:
    """Of all commands; those that the program itself carries out are there to be told of."""
    main = _Parser(prog="waft", description=TOLD["description"], epilog=TOLD["exit"])
    main.add_argument("--version", action="version", version=f"waft {version()}")
    main.set_defaults(is_guarded=True, as_json=False)
    commands = main.add_subparsers(dest="command", required=True, metavar="COMMAND")
    made = {name: commands.add_parser(name, help=sentence, epilog=TOLD["own"].get(name, {}).get("epilog"))
            for name, sentence in TOLD["commands"].items()}
    for name, own in TOLD["own"].items():
        for said in own["options"]:
            _add_told(made[name], said)

    def add(name, epilog=None):
        made[name].epilog = epilog
        return made[name]

    many = add("takes", epilog=TAKES_EXIT)
    many.add_argument("scene", type=path, help="scene file, *.waft.json")
    many.add_argument("--seeds", type=seeds, required=True, metavar="A:B", help="a take for each, both ends included")
    many.add_argument("-o", "--output", type=path, required=True, metavar="DIR",
                      help="folder for takes.csv, takes.txt and the takes; those that are there already are not flown again")
    many.add_argument("--jobs", type=_whole(1, 256), default=1, metavar="N", help="takes at a time, default 1")
    many.add_argument("--threads", type=threads, help="of each take; default: all cores together; the result is the same")
    many.add_argument("--database", type=path, metavar="FILE", help=SENTENCES["database"])
    many.add_argument("--quality", type=quality_of, choices=QUALITIES, default="full", help="of all takes, default full")
    many.add_argument("--preview", dest="quality", action="store_const", const="preview", help="--quality preview")
    many.set_defaults(run=run_takes, is_guarded=False)

    begin = add("new", epilog=NEW_EXIT)
    begin.add_argument("scene", type=path, metavar="FILE.waft.json", help="is written; what is there is never overwritten")
    begin.add_argument("--text", action="append", default=[], metavar="TEXT",
                       help="a word that bodies form; repeatable, one after the other; default WAFT")
    begin.add_argument("--image", type=path, action="append", default=[], metavar="FILE", help="a picture that they form; repeatable")
    begin.add_argument("--path", type=path, action="append", default=[], metavar="CSV",
                       help="a curve that one more body follows, rows x,y,z in metres; repeatable")
    begin.add_argument("--obstacle", type=path, action="append", default=[], metavar="FILE",
                       help="a closed surface in the way (.vtp, .obj, .ply, .stl, .glb); repeatable")
    begin.add_argument("--shape", choices=definition("shape")["properties"]["builtin"]["enum"], default="maple",
                       help="a built-in shape, default maple")
    begin.add_argument("--count", type=_whole(1, 100000), default=60, help="bodies that form words and pictures, default 60")
    begin.add_argument("--then", action="append", dest="text", metavar="TEXT", help="the next word; as --text, of the same bodies")
    begin.add_argument("--release", type=times, metavar="TIMES",
                       help="when bodies are let go that hang still until then, one after another by chance: 0s..3s, or frames 0..90")
    begin.add_argument("--arrive", type=times, metavar="TIMES", help="when they come to the first word or picture, default 7s; 4s..8s: one by one")
    begin.add_argument("--order", choices=("air", "left-to-right", "right-to-left", "top-down", "bottom-up", "outward", "inward", "random",
                                           "letters", "words", "lines"), help="who comes when in such a time; default air: least control")
    begin.add_argument("--blow-away", choices=("left", "right", "back", "top"),
                       help="a gust carries the last word or picture out by that side, which is open")
    begin.add_argument("--hold", type=duration, default=0, metavar="TIME", help="how long each word or picture stays, still: 1s, or frames")
    begin.add_argument("--loop", action="store_true", help="after the last word or picture all go back to where they begin, over and over")
    begin.set_defaults(run=run_new, is_guarded=False)

    about = add("info", epilog=INFO_EXIT)
    about.add_argument("place", type=path, metavar="DIR", help="what synthesize wrote, or a scene file")
    about.set_defaults(run=run_info, is_guarded=False)

    show = add("render")
    show.add_argument("folder", type=path, metavar="DIR", help="what synthesize wrote")
    show.add_argument("--frames", metavar="A:B:S", help="first, last and step; default all")
    show.add_argument("--size", type=size, default=(1280, 720), metavar="WxH", help="of the pictures, default 1280x720")
    show.add_argument("--movie", action="store_true", help="also DIR/VIEW.ogv and .avi, and .mp4 with ffmpeg")
    show.add_argument("--views", type=views, default=("hero", "top"), metavar="V,V",
                      help="of hero (near, goes along), side (still), top and follow; default hero,top")
    show.add_argument("--style", choices=tuple(STYLES), default="day", help="default day")
    show.add_argument("--loop", type=megabytes, nargs="?", const=3.0, metavar="MB",
                      help="also DIR/VIEW.webp, an animation that begins again, of at most so many megabytes; default 3")
    show.add_argument("--sheet", action="store_true", help="also DIR/VIEW_sheet.png, up to 20 of the pictures with their frames' numbers")
    show.add_argument("--shutter", type=opacity, default=0.0, metavar="X",
                      help="fraction of a frame in which the shutter is open: blurs what moves; default 0")
    show.add_argument("--aperture", type=millimetres, default=0.0, metavar="MM",
                      help="width of the lens, 0 to 1000: blurs what is nearer or farther than where the camera looks; default 0")
    show.add_argument("--subframes", type=_whole(2, 256), default=16, metavar="N",
                      help="pictures that are averaged with --shutter or --aperture, default 16")
    show.add_argument("--jobs", type=_whole(1, 64), default=1, metavar="N", help="pictures that are drawn at a time, default 1")
    show.add_argument("--no-trails", action="store_true", help="without the ways of the last second")
    marks = show.add_mutually_exclusive_group()
    marks.add_argument("--marks", action="store_true", default=None, help="the places that the scene asks for in the view hero, too")
    marks.add_argument("--no-marks", dest="marks", action="store_false", help="without these places in any view")
    show.add_argument("--obstacle-opacity", type=opacity, metavar="X",
                      help="0 to 1; default 1, and little where obstacles hide what flies")
    show.set_defaults(run=run_render)

    share_it = add("page")
    share_it.add_argument("folder", type=path, metavar="DIR", help="what synthesize wrote")
    share_it.add_argument("--measure", type=path, nargs="?", const=True, metavar="FILE",
                          help="with the rows of measure: measured now, or those in FILE, which measure --json wrote (default: "
                               "DIR/measure.json where it is)")
    share_it.set_defaults(run=run_page)

    hand = add("export")
    hand.add_argument("folder", type=path, metavar="DIR", help="what synthesize wrote")
    hand.add_argument("--to", choices=("glb", "abc", "usd"), default="glb", help="default glb; the others are written by Blender where it "
                                                                                 "was built with them")
    hand.add_argument("--with", dest="parts", type=parts, default=PARTS, metavar="P,P",
                      help="of ground, obstacles, marks (as empties) and camera, or none; default all")
    hand.set_defaults(run=run_export)

    plug = add("blender-addon", epilog=NEW_EXIT)
    plug.add_argument("file", type=path, metavar="FILE.zip", help="is written; what is there is never overwritten")
    plug.set_defaults(run=run_blender_addon, is_guarded=False)

    judge = add("measure", epilog=MEASURE_EXIT)
    judge.add_argument("folders", type=path, nargs="*", metavar="DIR", help="what synthesize wrote; several are pooled, too")
    judge.add_argument("--tracks", choices=("optimized", "assimilated", "planned", "poses"), default="optimized",
                       help="the motion, DIR/TRACKS.vtp; default optimized")
    judge.add_argument("--json", type=path, nargs="?", const="-", metavar="FILE",
                       help="the rows as JSON; without FILE on stdout, instead of the table")
    judge.add_argument("--plots", type=path, metavar="FOLDER", help="a picture of each beside the drifters'; needs matplotlib")
    judge.add_argument("--scene", type=path, metavar="SCENE",
                       help="the scene that was flown: how well its texts and pictures are to be read; of --make-drifters, what acts on "
                            "them besides")
    judge.add_argument("--drifters", type=path, metavar="FILE", help="the bodies in free air to measure by (default: those that "
                                                                     "come with Waft)")
    judge.add_argument("--make-drifters", type=path, metavar="FILE", help="measure nothing; simulate drifters for the volume, frame "
                                                                          "rate and settling speeds of DIR")
    judge.add_argument("--settling-speeds", type=speeds, metavar="V,V", help="of --make-drifters, instead of those of DIR [m/s]; DIR "
                                                                             "may then be left out")
    judge.add_argument("--airs", type=_whole(2, 1000), default=6, help="of --make-drifters, default 6")
    judge.add_argument("--seed", type=seed, default=20001, help="of the first air of --make-drifters, default 20001")
    judge.set_defaults(run=run_measure)

    tidy = add("clean", epilog=CLEAN_EXIT)
    tidy.add_argument("folder", type=path, nargs="?", metavar="DIR",
                      help="a result: its series of fields, particles and meshes go, the motion stays; without DIR the store of states goes")
    tidy.add_argument("--list", dest="only_lists", action="store_true", help="remove nothing")
    tidy.set_defaults(run=run_clean, is_guarded=False)

    demo = add("demo")
    demo.add_argument("-o", "--output", type=path, default="demo", metavar="DIR", help="folder for the results, default demo")
    demo.add_argument("--threads", type=threads, help="default: all cores; the result is the same")
    demo.set_defaults(run=run_demo)
    for name, parsed in made.items():
        if name not in TOLD["own"]:
            _add_common(parsed, name in ANSWERING)
    watch = commands.add_parser("watch")  # by the program, of `synthesize --watch`
    watch.add_argument("scene", type=path)
    watch.add_argument("output", type=path)
    watch.add_argument("flight", nargs=argparse.REMAINDER)
    watch.set_defaults(run=run_watch, is_guarded=False, loudness="normal", log=None)
    return main


def _add_told(parsed, said):
    """An option as the program tells of it."""
    how = {"help": said["help"].replace("%", "%%")}
    if not said["flags"]:
        parsed.add_argument(said["name"], **how)
    elif said["value"] is None:
        parsed.add_argument(*said["flags"], action="store_true", **how)
    elif said["value"].startswith("["):
        parsed.add_argument(*said["flags"], nargs="?", metavar=said["value"].strip("[]"), **how)
    else:
        parsed.add_argument(*said["flags"], choices=said["choices"], metavar=None if said["choices"] else said["value"],
                            required=said["isNeeded"], **how)


def parse(arguments: Optional[Sequence[str]] = None) -> argparse.Namespace:
    """The options of a command line; ends the process by SystemExit at --help, --version and malformed usage."""
    options = parser().parse_args(arguments)
    options.answer = {}
    return options


def run_watch(options):
    from waft.run.repeating import fly_when_saved

    return fly_when_saved(options.scene, options.output, options.flight)


def run_clean(options):
    from waft.results.cleaning import clean

    clean(options.folder, options.only_lists)
    return failures.ALL_MET


def run_takes(options):
    from waft.run.takes import fly_takes, table

    status, rows = fly_takes(options.scene, options.seeds, options.output, options.quality, options.jobs, options.threads,
                             options.database, log=lambda text: say(f"waft: {text}"))
    print(table(rows), end="")
    return status


def run_new(options):
    from waft.scene.starting import new_scene

    scene = new_scene(options.scene, options.text, options.image, options.path, options.obstacle, options.shape, options.count,
                      options.release, options.arrive, options.order, options.hold, options.blow_away, options.loop)
    name = options.scene if not options.scene.startswith("-") else f"./{options.scene}"
    say(f"{options.scene}: {len(scene.objects)} objects, {scene.frames} frames; fly it: waft synthesize {shlex.quote(name)} "
        "--output out --preview")
    return failures.ALL_MET


def run_info(options):
    from waft.results.describing import describe_result, words_of_result
    from waft.scene.describing import describe_scene, words_of_scene

    if os.path.isdir(options.place):
        found = options.answer["result"] = describe_result(options.place)
        words = words_of_result(found)
    else:
        found = options.answer["scene"] = describe_scene(options.place)
        words = words_of_scene(found)
    for text in words:
        tell(options, text)
    return failures.ALL_MET


def run_render(options):
    from waft.render import render

    began = time.monotonic()
    drawn = []
    with interruptible("stopped: the pictures that were drawn are whole"):
        written = render(options.folder, frames=options.frames, size=options.size, movie=options.movie, views=options.views,
                         obstacle_opacity=options.obstacle_opacity, paths=not options.no_trails, targets=options.marks,
                         style=options.style, loop=options.loop, shutter=options.shutter, aperture=options.aperture,
                         subframes=options.subframes, sheet=options.sheet, jobs=options.jobs,
                         progress=lambda done, text: drawn.append(text))
    seconds = time.monotonic() - began
    count = len(drawn) * len(options.views)
    options.answer.update(folder=options.folder, files=[os.path.relpath(file, options.folder) for file in written],
                          seconds=round(seconds, 3))
    say(f"{options.folder}: {count} pictures in {seconds:.1f} s, {count / seconds:.1f} frames a second")
    return failures.ALL_MET


def run_page(options):
    from waft.page import write_page

    with interruptible("stopped: no page was written"):
        page = write_page(options.folder, options.measure)
    options.answer.update(page=page, bytes=os.path.getsize(page))
    say(f"{page}: {os.path.getsize(page) / 1e6:.1f} MB; open it in a browser")
    return failures.ALL_MET


def run_export(options):
    from waft.results.exporting import export

    with interruptible("stopped: nothing was written"):
        file = export(options.folder, options.to, options.parts)
    say(f"{file}: {os.path.getsize(file) / 1e6:.1f} MB")
    return failures.ALL_MET


def run_blender_addon(options):
    from waft.cli.blenderaddon import write_addon

    write_addon(options.file)
    say(f"{options.file}: in Blender, Edit > Preferences > Add-ons > Install (from 4.2 on: Install from Disk)")
    return failures.ALL_MET


def run_measure(options):
    from waft.files import check_target, whole_file, write_json
    from waft.marks import is_marked_json, marked_rows
    from waft.measuring import make_drifters_for, measure, table

    if options.make_drifters:
        make_drifters_for(options.folders, options.make_drifters, options.settling_speeds, options.airs, options.seed,
                          progress=lambda _, text: say(text), scene=options.scene)
        return failures.ALL_MET
    if options.json and options.json != "-":
        check_target(options.json, is_marked_json)
    measured = measure(options.folders, options.tracks, options.drifters, options.plots, scene=options.scene)
    rows = marked_rows([one.as_json() for one in measured])
    if options.json == "-":
        json.dump(rows, sys.stdout, indent=2)
        print()
    else:
        print("\n\n".join("\n".join(map(line, table(one))) for one in measured))
        if options.json:
            with whole_file(options.json, is_marked_json) as part:
                write_json(part, rows)
    return failures.ALL_MET


def run_demo(options):
    from waft.cli.demo import run_demo as demo

    return demo(options.output, threads=options.threads)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    if arguments[:1] and arguments[0] in TOLD["own"]:
        return subprocess.run([command(), *arguments], check=False).returncode
    options = parse(arguments)
    return carry_out(options, arguments, _run)


def _run(options):
    status = options.run(options)
    answer(options, status)
    return status


def carry_out(options: argparse.Namespace, arguments: Sequence[str], act: Callable[[argparse.Namespace], int]) -> int:
    """The exit status of act(options), which says as much as the command line asks, and in the log; what it raises is reported."""
    try:
        with speaking(options, arguments) as ended:
            return ended(_carry_out(options, act))
    except (failures.WaftError, OSError) as error:  # of the log
        return _give_up(options, error, getattr(error, "status", failures.FAILED))


def _carry_out(options, act):
    try:
        return act(options)
    except failures.WaftError as error:
        return _give_up(options, error, error.status)
    except OSError as error:
        return _give_up(options, error, failures.FAILED)
    except MemoryError:
        return _give_up(options, "too little memory", failures.FAILED)
    except ImportError as error:  # of another version, or too little memory to load it
        return _give_up(options, f"ParaView cannot be loaded: {error}", failures.FAILED)


def _give_up(options, error, status):
    report_to_guard("words", "")  # said here
    say(f"waft: {shortened(error)}", "error")
    answer(options, status, shortened(error))
    return status
