# SPDX-License-Identifier: BSD-3-Clause
"""The command `waft`."""
import argparse
import json
import os
import shlex
import sys
import time
from typing import Callable, Optional, Sequence

from waft import failures
from waft.cli import defaults
from waft.cli.answers import answer, tell
from waft.cli.speaking import speaking
from waft.loading import version
from waft.render._styles import STYLES, VIEWS
from waft.run._options import option
from waft.run._chain import KEPT, QUALITIES, quality_of
from waft.run.request import SENTENCES, STATED
from waft.scene._schema import definition
from waft.texts import ROWS, is_utf8, line, names_a_row, say, shortened, warn
from waft.watching import interruptible, report_to_guard

DESCRIPTION = "Motion of light things in air that goes where you say and moves like things carried by one air."
EXIT = """exit status: 0 all constraints met; 2 malformed input or usage, nothing computed; 3 some constraint could not
be met (named in constraints.csv and below), all others are; 4 stopped early, best so far written; 1 anything else"""

DATABASE_EXIT = """exit status: 0 done; 2 malformed usage, nothing computed; 4 stopped early, the database of the
simulations that are whole written (nothing when there is none); 1 anything else. FILE.coverage.csv tells what
each simulation added"""

CLEAN_EXIT = """exit status: 0 done; 2 malformed usage, or DIR is no result; 1 anything else"""
INFO_EXIT = """exit status: 0 told; 2 malformed usage, or neither a result nor a scene; 1 anything else"""
NEW_EXIT = """exit status: 0 written; 2 malformed usage, or something is there already; 1 anything else"""

CHECK_EXIT = """exit status: 0 nothing stands against it, though some may be hard; 2 malformed scene or usage; 3 some constraint
cannot be met, by itself or beside another; 1 anything else"""

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


def _stated(stated):
    """A number of which Core says what it may be."""
    return _argument(int if stated.is_whole else float, stated.expected, stated.accepts)


def _of_database(name, **how):
    """How argparse takes an option of the database's simulations."""
    stated = option("vtkMotionDatabaseSource", name)
    default = int(stated.default) if stated.is_whole else stated.default
    return {"type": _stated(stated), "default": default, **how, "help": f"{how['help']}default {default}"}


def _fits(path):
    """Whether a file system takes a path, and ParaView."""
    name = os.fsencode(path)
    return is_utf8(path) and 0 < len(name) < 4096 and all(len(part) < 256 for part in name.split(b"/"))


path = _argument(str, "a path in UTF-8 of 1 to 4095 letters, 255 in each name", _fits)
threads = _whole(1, 1024)
seed = _whole(0, 2 ** 31 - 1)
seeds = _argument(_seeds, "seeds A:B, or one, from 0 to 2147483647, at most 100000 of them",
                  lambda s: 0 < len(s) <= 100000 and s[0] >= 0 and s[-1] < 2 ** 31)
positive = _argument(float, "a positive number", lambda x: 0.0 < x < float("inf"))
megabytes = _argument(float, "megabytes above 0, at most 1000", lambda x: 0.0 < x <= 1000.0)
millimetres = _argument(float, "millimetres from 0 to 1000", lambda x: 0.0 <= x <= 1000.0)
opacity = _argument(float, "a number from 0 to 1", lambda x: 0.0 <= x <= 1.0)
share = _argument(float, "a share above 0, at most 1", lambda x: 0.0 < x <= 1.0)
size = _argument(_size, "WxH such as 1280x720, each from 16 to 16384", lambda s: all(16 <= n <= 16384 for n in s))

speeds = _argument(_speeds, "speeds from 0 to 20 m/s with commas between", lambda all_: all(0.0 <= v <= 20.0 for v in all_))
parts = _argument(_parts, "none, or names of ground, obstacles, marks and camera with commas between",
                  lambda names: len(set(names)) == len(names) and all(name in PARTS for name in names))
kept = _argument(_names, "names of air and state with commas between",
                 lambda names: len(set(names)) == len(names) and all(name in KEPT for name in names))
views = _argument(_names, "names of hero, side, top and follow with commas between",
                  lambda names: len(set(names)) == len(names) and all(name in VIEWS for name in names))


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        """What is wrong with a command line, whatever is in it, in one line below the usage."""
        super().error(line(shortened(message)))


ANSWERING = ("synthesize", "check", "info", "render", "page")  # commands that answer programs, too


def _add_common(command, answers):
    """The options that say how much is said, and where."""
    if answers:
        command.add_argument("--json", dest="as_json", action="store_true",
                             help="the answer as one JSON document on stdout, all else on stderr")
    loudness = command.add_mutually_exclusive_group()
    loudness.add_argument("-q", "--quiet", dest="loudness", action="store_const", const="quiet", default="normal",
                          help="say nothing but errors, warnings and what is not met")
    loudness.add_argument("-v", "--verbose", dest="loudness", action="store_const", const="verbose",
                          help="say what each stage does, too")
    command.add_argument("--log", type=path, metavar="FILE",
                         help="every message with its time in FILE, also those that are not shown; an older log makes room, any other "
                              "file stays")


def parser() -> argparse.ArgumentParser:
    main = _Parser(prog="waft", description=DESCRIPTION, epilog=EXIT)
    main.add_argument("--version", action="version", version=f"waft {version()}")
    main.set_defaults(is_guarded=True, is_in_paraview=True, as_json=False)
    commands = main.add_subparsers(dest="command", required=True, metavar="COMMAND")

    make = commands.add_parser("synthesize", help="a scene file to an animation", epilog=EXIT)
    make.add_argument("scene", type=path, help="scene file, *.waft.json")
    make.add_argument("-o", "--output", type=path, metavar="DIR", help="folder for the results")
    for name, how in (("database", {"type": path, "metavar": "FILE"}), ("seed", {"type": _stated(STATED["seed"])}),
                      ("threads", {"type": threads}), ("time_limit", {"type": positive, "metavar": "S"}),
                      ("memory_limit", {"type": _stated(STATED["memory_limit"]), "metavar": "MB"}),
                      ("quality", {"type": quality_of, "choices": QUALITIES}),
                      ("resume", {"action": "store_true"}), ("edit_of", {"type": path, "metavar": "DIR"}),
                      ("meshes", {"action": "store_true"}), ("particles", {"action": "store_true"}),
                      ("keep", {"type": kept, "default": (), "metavar": "K,K"})):
        make.add_argument(f"--{name.replace('_', '-')}", help=SENTENCES[name], **how)
    make.add_argument("--preview", dest="quality", action="store_const", const="preview", help=SENTENCES["preview"])
    make.add_argument("--no-csv", dest="csv", action="store_false",
                      help="without poses.csv; poses.vtp and animation.glb hold the same motion")
    make.add_argument("--watch", action="store_true",
                      help="fly at preview quality, and again whenever the scene file or a file that it names is saved, until stopped; "
                           "DIR/page.html, open in a browser, follows")
    make.add_argument("--progress", choices=("line", "json"), default="line",
                      help="line: on a terminal; json: each message as a line of JSON on stdout, {\"fraction\", \"text\"}")
    make.set_defaults(run=run_synthesize, is_in_paraview=False, defaults_of=lambda: {
        action.dest: action for action in make._actions if action.dest in defaults.NAMES and not action.const})

    many = commands.add_parser("takes", help="many variations of a scene, and a table of them", epilog=TAKES_EXIT)
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

    begin = commands.add_parser("new", help="a first scene, to change by hand", epilog=NEW_EXIT)
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
    begin.set_defaults(run=run_new, is_guarded=False)

    look = commands.add_parser("check", help="what of a scene cannot be, and what will be hard", epilog=CHECK_EXIT)
    look.add_argument("scene", type=path, help="scene file, *.waft.json")
    look.add_argument("--database", type=path, metavar="FILE", help=SENTENCES["database"])
    look.set_defaults(run=run_check, is_guarded=False)

    about = commands.add_parser("info", help="what a result or a scene holds, and whether a result can be gone on with",
                                epilog=INFO_EXIT)
    about.add_argument("place", type=path, metavar="DIR", help="what synthesize wrote, or a scene file")
    about.set_defaults(run=run_info, is_guarded=False)

    base = commands.add_parser("database", help="a motion database from simulations of smoke", epilog=DATABASE_EXIT)
    base.add_argument("-o", "--output", type=path, required=True, metavar="FILE.vtm", help="file for the database")
    base.add_argument("--simulations", **_of_database("NumberOfSimulations", help=""))
    base.add_argument("--frames", **_of_database("NumberOfFrames", help="frames of each, "))
    base.add_argument("--resolution", **_of_database("Resolution", help="cells along a side, "))
    base.add_argument("--seed", **_of_database("Seed", type=seed, help="of the first simulation, "))
    base.add_argument("--threads", type=threads, help="default: all cores; the result is the same")
    base.add_argument("--until-covered", type=share, nargs="?", const=0.05, default=0.0, metavar="SHARE",
                      help="stop when less than this share of a simulation's segments is new (without a number "
                           "0.05); --simulations is then the most")
    base.add_argument("--coverage-tolerance", **_of_database("CoverageTolerance", metavar="SHARE", help=(
        "a segment is new when it is farther from all before than this share of the rms chord, ")))
    base.add_argument("--time-limit", type=positive, metavar="S", help="seconds; the simulations that are whole "
                                                                       "are used")
    base.add_argument("--resume", action="store_true", help="go on from what a stopped run left beside FILE")
    base.set_defaults(run=run_database, is_in_paraview=False)

    show = commands.add_parser("render", help="pictures and a movie of a result")
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

    share_it = commands.add_parser("page", help="a result as one page for a browser, DIR/page.html")
    share_it.add_argument("folder", type=path, metavar="DIR", help="what synthesize wrote")
    share_it.add_argument("--measure", type=path, nargs="?", const=True, metavar="FILE",
                          help="with the rows of measure: measured now, or those in FILE, which measure --json wrote (default: "
                               "DIR/measure.json where it is)")
    share_it.set_defaults(run=run_page)

    hand = commands.add_parser("export", help="a result with its surroundings for other programs, DIR/scene.glb and the like")
    hand.add_argument("folder", type=path, metavar="DIR", help="what synthesize wrote")
    hand.add_argument("--to", choices=("glb", "abc", "usd"), default="glb", help="default glb; the others are written by Blender where it "
                                                                                 "was built with them")
    hand.add_argument("--with", dest="parts", type=parts, default=PARTS, metavar="P,P",
                      help="of ground, obstacles, marks (as empties) and camera, or none; default all")
    hand.set_defaults(run=run_export)

    plug = commands.add_parser("blender-addon", help="the add-on for Blender as a zip file, to install there", epilog=NEW_EXIT)
    plug.add_argument("file", type=path, metavar="FILE.zip", help="is written; what is there is never overwritten")
    plug.set_defaults(run=run_blender_addon, is_guarded=False)

    judge = commands.add_parser("measure", help="how good a motion is, from the files of results alone", epilog=MEASURE_EXIT)
    judge.add_argument("folders", type=path, nargs="*", metavar="DIR", help="what synthesize wrote; several are pooled, too")
    judge.add_argument("--tracks", choices=("optimized", "assimilated", "planned", "poses"), default="optimized",
                       help="the motion, DIR/TRACKS.vtp; default optimized")
    judge.add_argument("--json", type=path, nargs="?", const="-", metavar="FILE",
                       help="the rows as JSON; without FILE on stdout, instead of the table")
    judge.add_argument("--plots", type=path, metavar="FOLDER", help="a picture of each beside the drifters'; needs matplotlib")
    judge.add_argument("--scene", type=path, metavar="SCENE", help="the scene that was flown: how well its texts and pictures are to be read")
    judge.add_argument("--drifters", type=path, metavar="FILE", help="the bodies in free air to measure by (default: those that "
                                                                     "come with Waft)")
    judge.add_argument("--make-drifters", type=path, metavar="FILE", help="measure nothing; simulate drifters for the volume, frame "
                                                                          "rate and settling speeds of DIR")
    judge.add_argument("--settling-speeds", type=speeds, metavar="V,V", help="of --make-drifters, instead of those of DIR [m/s]; DIR "
                                                                             "may then be left out")
    judge.add_argument("--airs", type=_whole(2, 1000), default=6, help="of --make-drifters, default 6")
    judge.add_argument("--seed", type=seed, default=20001, help="of the first air of --make-drifters, default 20001")
    judge.set_defaults(run=run_measure)

    tidy = commands.add_parser("clean", help="give back room: what runs keep for later ones, or what a result does without",
                               epilog=CLEAN_EXIT)
    tidy.add_argument("folder", type=path, nargs="?", metavar="DIR",
                      help="a result: its series of fields, particles and meshes go, the motion stays; without DIR the store of states goes")
    tidy.add_argument("--list", dest="only_lists", action="store_true", help="remove nothing")
    tidy.set_defaults(run=run_clean, is_guarded=False)

    demo = commands.add_parser("demo", help="the embedded scenes, start to finish, with pictures")
    demo.add_argument("-o", "--output", type=path, default="demo", metavar="DIR", help="folder for the results, default demo")
    demo.add_argument("--threads", type=threads, help="default: all cores; the result is the same")
    demo.set_defaults(run=run_demo)
    for name, command in commands.choices.items():
        _add_common(command, name in ANSWERING)
    return main


def parse(arguments: Optional[Sequence[str]] = None) -> argparse.Namespace:
    """The options of a command line; ends the process by SystemExit at --help, --version and malformed usage."""
    main = parser()
    options = main.parse_args(arguments)
    options.answer = {}
    if options.command == "synthesize":
        if options.watch and (options.time_limit is not None or options.resume):
            main.error("--watch: expected neither --time-limit nor --resume with it")
        if options.as_json and (options.watch or options.progress == "json"):
            main.error("--json: expected neither --watch nor --progress json with it, which say more than one thing on stdout")
    return options


def settle(options: argparse.Namespace) -> None:
    """Fills in what the command line leaves open. Raises BadInput of defaults of the user's that are wrong, and where there are none
    of what is needed."""
    if options.command != "synthesize":
        return
    options.taken = defaults.apply(options, options.defaults_of())
    options.quality = options.quality or "full"
    if options.output is None:
        raise failures.BadInput("expected --output DIR, the variable WAFT_OUTPUT, or output in ~/.config/waft.toml")


def run_synthesize(options):
    if options.watch:
        from waft.run.repeating import fly_when_saved

        return fly_when_saved(options.scene, lambda: _fly_and_show(options))
    return _fly(options, options.quality)


def _fly(options, quality):
    from waft.results.describing import describe_result
    from waft.run.synthesis import report_run, synthesize

    asked = {name: value for name, value in vars(options).items() if name in SENTENCES}
    asked.update(quality=quality, quiet=False, on_progress=_print_json if options.progress == "json" else None,
                 _defaults=options.taken)
    for name, taken in options.taken.items():
        say(f"waft: {name} {taken['value']}, by {taken['from']}")
    run = synthesize(**asked)
    report_run(run, options.output)
    run.delete()
    if options.as_json:
        options.answer["result"] = describe_result(options.output)
    return run.status


def run_clean(options):
    from waft.results.cleaning import clean

    clean(options.folder, options.only_lists)
    return failures.ALL_MET


def _fly_and_show(options):
    """A preview, and its page, which loads itself again after the next one; without a page there is all else."""
    from waft.page import write_page

    status = _fly(options, "preview")
    if status != failures.STOPPED_EARLY:
        try:
            say(f"waft: {write_page(options.output, is_watched=True)}: open it in a browser, it follows")
        except failures.WaftError as error:
            warn(error)
    return status


def _print_json(fraction, text):
    print(json.dumps({"fraction": round(fraction, 4), "text": text}), flush=True)


def run_takes(options):
    from waft.run.takes import fly_takes, table

    status, rows = fly_takes(options.scene, options.seeds, options.output, options.quality, options.jobs, options.threads,
                             options.database, log=lambda text: say(f"waft: {text}"))
    print(table(rows), end="")
    return status


def run_new(options):
    from waft.scene.starting import new_scene

    scene = new_scene(options.scene, options.text, options.image, options.path, options.obstacle, options.shape, options.count)
    name = options.scene if not options.scene.startswith("-") else f"./{options.scene}"
    say(f"{options.scene}: {len(scene.objects)} objects, {scene.frames} frames; fly it: waft synthesize {shlex.quote(name)} "
        "--output out --preview")
    return failures.ALL_MET


def run_check(options):
    from waft.scene.checking import check

    with interruptible("stopped: a check writes nothing"):
        found = check(options.scene, options.database)
    for text in found.lines:
        tell(options, f"waft: {text}")
    if any(names_a_row(text) for text in found.lines):
        tell(options, f"waft: {ROWS}")
    tell(options, f"waft: {options.scene}: {found.objects} objects, {found.constraints} constraints, {found.impossible} of them cannot be "
                  f"met, {len(found.findings) - found.impossible} remarks on what will be hard")
    options.answer.update(scene=options.scene, objects=found.objects, constraints=found.constraints, findings=found.findings)
    return failures.NOT_ALL_MET if found.impossible else failures.ALL_MET


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


def run_database(options):
    from waft.run.database import make_database

    made = make_database(options.output, simulations=options.simulations, frames=options.frames,
                         resolution=options.resolution, seed=options.seed, threads=options.threads,
                         time_limit=options.time_limit, stop_below=options.until_covered,
                         coverage_tolerance=options.coverage_tolerance, resume=options.resume,
                         quiet=False)
    count = len(made.coverage) + 1
    say(f"{options.output}: {count} simulations" + (
        f", {100.0 * made.coverage[-1][2]:.1f} % of the last one's segments are new" if made.coverage else ""))
    if made.stopped:
        say("stopped early; --resume goes on")
    return failures.STOPPED_EARLY if made.stopped else failures.ALL_MET


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
                          progress=lambda _, text: say(text))
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
        settle(options)
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
