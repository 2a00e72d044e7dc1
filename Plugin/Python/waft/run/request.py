# SPDX-License-Identifier: BSD-3-Clause
"""What a flight is asked for: each option of waft.synthesize once, with its type, its sentence and its default; what Core says of
an option of a stage, it says here, and what the program says of its own."""
import dataclasses
import functools
import inspect
import os
import pathlib
import textwrap
from typing import (
    Annotated, Any, Callable, Dict, List, Mapping, Optional, ParamSpec, Sequence, TypeVar, Union, get_type_hints)

from waft.failures import InputError
from waft.reading import read_json
from waft.run._options import Option, option
from waft.run._chain import KEPT, QUALITIES, WITHOUT, quality_of
from waft.scene import Scene
from waft.texts import is_utf8

# What the program tells of its commands (Plugin/Command): commands.json, which is written when Waft is built.
TOLD = read_json(pathlib.Path(__file__).parents[1] / "commands.json")
_SENTENCES = {said["field"]: said["help"] for own in TOLD["own"].values() for said in own["options"] if said["field"]}

Path = Union[str, "os.PathLike[str]"]
Progress = Callable[[float, str], Optional[bool]]
P = ParamSpec("P")
R = TypeVar("R")


@dataclasses.dataclass(frozen=True)
class Request:
    """The options of waft.synthesize; those after `database` by their names alone."""

    scene: Annotated[Union[Scene, Path], "a waft.Scene, or the path of a *.waft.json file"]
    output: Annotated[Optional[Path], "folder for the results (default: nothing is written)"] = None
    database: Annotated[Optional[Path], _SENTENCES["database"]] = None
    _: dataclasses.KW_ONLY
    seed: Annotated[Optional[int], option("vtkMotionAnimationSource", "Seed")] = None
    threads: Annotated[Optional[int], _SENTENCES["threads"]] = None
    time_limit: Annotated[Optional[float], _SENTENCES["time_limit"]] = None
    preview: Annotated[bool, _SENTENCES["preview"]] = False
    resume: Annotated[bool, _SENTENCES["resume"]] = False
    quiet: Annotated[bool, "say nothing of progress on stderr"] = True
    checkpoint_interval: Annotated[Optional[float], option("vtkSPHSpacetimeFilter", "CheckpointInterval",
                                                           of="the optimiser")] = None
    meshes: Annotated[bool, _SENTENCES["meshes"]] = False
    memory_limit: Annotated[Optional[float], option("vtkSPHSpacetimeFilter", "MemoryLimit", of="the optimiser")] = None
    quality: Annotated[Optional[str], _SENTENCES["quality"]] = None
    edit_of: Annotated[Optional[Path], _SENTENCES["edit_of"]] = None
    on_progress: Annotated[Optional[Progress], "called with the share that is done (0 to 1) and a sentence, some five times a "
                                               "second; when it returns False the run stops with the best so far"] = None
    particles: Annotated[bool, _SENTENCES["particles"]] = False
    keep: Annotated[Sequence[str], _SENTENCES["keep"]] = ()
    csv: Annotated[bool, "write poses.csv, the motion as a table, which poses.vtp and animation.glb hold as well"] = True
    _settings: Mapping[str, Mapping[str, Any]] = dataclasses.field(default_factory=dict)  # {stage: {property: value}}, for tests
    _defaults: Mapping[str, Mapping[str, Any]] = dataclasses.field(default_factory=dict)  # what the command took from the user's settings

    def __post_init__(self) -> None:
        """Raises InputError of what can be told without a look at any file."""
        if self.on_progress is not None and not callable(self.on_progress):
            raise InputError(f"on_progress: expected a function of a share and a sentence, found {self.on_progress!r}")
        for name, stated in STATED.items():
            if getattr(self, name) is not None:
                stated.check(name, getattr(self, name))
        for path in (self.scene, self.output, self.database, self.edit_of):
            if path and not isinstance(path, Scene) and not is_utf8(path):
                raise InputError(f"{os.fsdecode(path)}: expected a name in UTF-8, as ParaView takes no other")
        if self.way not in QUALITIES:
            raise InputError(f"quality: expected one of {', '.join(QUALITIES)}, found {self.way}")
        if self.particles and "spacetime" in WITHOUT[self.way]:
            raise InputError(f"particles: expected quality full or paper, whose optimiser has particles, found {self.way}")
        for wrong in (name for name in self.keep if name not in KEPT):
            raise InputError(f"keep: expected of {', '.join(KEPT)}, found {wrong!r}")

    @property
    def way(self) -> str:
        """The quality that is meant."""
        return quality_of(self.quality or ("preview" if self.preview else "full"))

    @property
    def series(self) -> List[str]:
        """The data that are asked for, a file a frame."""
        return [name for name, is_wanted in (("meshes", self.meshes), ("particles", self.particles)) if is_wanted]

    def settings(self) -> Dict[str, Dict[str, Any]]:
        """{stage: {property: value}} besides defaults and those of the quality."""
        settings = {stage: dict(own) for stage, own in self._settings.items()}
        asked = {"MemoryLimit": self.memory_limit, "CheckpointInterval": self.checkpoint_interval}
        settings.setdefault("Spacetime", {}).update({name: value for name, value in asked.items() if value is not None})
        return settings


_SAID = {name: hint.__metadata__[0] for name, hint in get_type_hints(Request, include_extras=True).items()
         if hasattr(hint, "__metadata__")}
STATED: Dict[str, Option] = {name: said for name, said in _SAID.items() if isinstance(said, Option)}
SENTENCES: Dict[str, str] = {name: said.clause if isinstance(said, Option) else said for name, said in _SAID.items()}


def by_options(request: Callable[P, Request]) -> Callable[[Callable[[Request], R]], Callable[P, R]]:
    """Makes a function of a Request one of its options, with a signature and a documentation that show each."""
    def decorate(act: Callable[[Request], R]) -> Callable[P, R]:
        hints = get_type_hints(Request)
        shown = inspect.signature(act).replace(parameters=[
            parameter.replace(annotation=hints[name]) for name, parameter in inspect.signature(request).parameters.items()
            if name in SENTENCES])

        @functools.wraps(act)
        def call(*args: P.args, **options: P.kwargs) -> R:
            unknown = [name for name in options if name not in hints]
            if unknown:
                raise TypeError(f"{act.__name__}: no option {unknown[0]}; expected {', '.join(SENTENCES)}")
            return act(request(*args, **options))
        each = "\n".join(textwrap.fill(f"{name}: {text}", 110, initial_indent="    ", subsequent_indent="        ")
                         for name, text in SENTENCES.items())
        call.__doc__ = inspect.cleandoc(act.__doc__ or "").replace("\n\n", f"\n\n{each}\n\n", 1)
        setattr(call, "__signature__", shown)
        return call
    return decorate
