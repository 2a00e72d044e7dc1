# SPDX-License-Identifier: BSD-3-Clause
"""Every number that can be set on a class of the plugin, set to what it cannot be."""
import inspect
import resource

from case import Case
from cases_data import STAGES, good
from stages import classes, stage_of, update, wrong_with

REALS = (float("nan"), 1e308, -1e308)
INTEGERS = (2 ** 31 - 1, -2 ** 31)
# What VTK's own classes bring, and numbers that only count or number things.
FOREIGN = ("ReferenceCount", "MemkindDirectory", "AbortExecute", "AbortOutput", "Progress", "ProgressShiftScale",
           "ReleaseDataFlag", "GlobalReleaseDataFlag", "Debug", "GlobalWarningDisplay", "InputArrayToProcess",
           "UsingMemkind", "ContainerAlgorithm", "NoPriorTemporalAccessInformationKey")

# What a number that is cut to the largest there may be makes a stage do, even if it is asked to stop.
LONG_WORK = dict.fromkeys(("NumberOfGasParticles", "NumberOfTargets"), {resource.RLIMIT_CPU: 120})


def numbers_of(algorithm):
    """(name, value) of each property with a number, or several, that can be set."""
    for name, _ in inspect.getmembers(type(algorithm), callable):
        if name.startswith("Set") and name[3:] not in FOREIGN and hasattr(algorithm, "Get" + name[3:]):
            try:
                value = getattr(algorithm, "Get" + name[3:])()
            except TypeError:
                continue
            first = value[0] if isinstance(value, tuple) and value else value
            if isinstance(first, (int, float)) and not isinstance(first, bool):
                yield name[3:], value


def _act(stage, name, value):
    def act():
        first = value[0] if isinstance(value, tuple) else value
        for wrong in REALS if isinstance(first, float) else INTEGERS:
            print(f"{name} = {wrong}", flush=True)  # so that a crash tells it
            algorithm = stage_of(stage)
            for port, data in enumerate(STAGES.get(stage, ())):
                if data is not None:
                    algorithm.SetInputDataObject(port, good()[data])
            try:
                getattr(algorithm, f"Set{name}")(*([wrong] * len(value) if isinstance(value, tuple) else [wrong]))
            except (TypeError, OverflowError, ValueError):
                continue
            fault = wrong_with(algorithm, update(algorithm))
            if fault:
                return f"{name} = {wrong}: {fault}"
        return ""
    return act


def cases():
    good()
    for stage in sorted(classes()):
        algorithm = stage_of(stage)
        ports = map(algorithm.GetInputPortInformation, range(algorithm.GetNumberOfInputPorts()))
        needs_input = any(not port.Has(algorithm.INPUT_IS_OPTIONAL()) for port in ports)
        if needs_input and stage not in STAGES:
            continue
        for name, value in numbers_of(algorithm):
            yield Case("properties", f"{stage}: {name}", act=_act(stage, name, value), limits=LONG_WORK.get(name, {}))
