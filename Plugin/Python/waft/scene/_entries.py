# SPDX-License-Identifier: BSD-3-Clause
"""Between the arguments of waft.Scene's methods and the fields of a scene."""
import functools
import inspect
import re
from typing import Any, Callable, Dict, TypeVar, cast

from waft.failures import InputError
from waft.scene import _schema
from waft.scene._sense import nonsense

Method = TypeVar("Method", bound=Callable[..., Any])


def field_name(argument):
    """settling_speed is the field settlingSpeed; class_ is class."""
    head, *rest = argument.rstrip("_").split("_")
    return head + "".join(word.capitalize() for word in rest)


def argument_name(field):
    name = re.sub(r"(?<=[a-z])([A-Z])", lambda match: "_" + match.group(1).lower(), field)
    return name + "_" if name == "class" else name


def refusal(method, argument, expected, found):
    return InputError(f"Scene.{method}: {argument}: expected {expected}, found {found}")


def documented(*definitions: str) -> Callable[[Method], Method]:
    """For a method whose arguments are fields of these definitions of the schema: what the schema says of each ends its
    documentation, and a call that does not fit its signature raises InputError."""
    fields: Dict[str, Any] = {}
    for kind in definitions:
        fields.update(_schema.definition(kind)["properties"])

    def decorate(method: Method) -> Method:
        signature = inspect.signature(method)
        names = [name for name in signature.parameters if name != "self"]

        @functools.wraps(method)
        def called(self, *positional, **named):
            try:
                signature.bind(self, *positional, **named)
            except TypeError as error:
                raise InputError(f"Scene.{method.__name__}: {error}; expected the arguments {', '.join(names)}") from None
            return method(self, *positional, **named)

        lines = [f"{name}: {_schema.described(fields[field_name(name)])}" for name in names if field_name(name) in fields]
        lines += ["comment: a text that goes with the entry"] if "comment" in names else []
        called.__doc__ = (inspect.getdoc(method) or "") + "\n\n" + "\n".join(lines) + "\n"
        return cast(Method, called)
    return decorate


def entry_of(method, definition, given, **constant):
    """The entry of a definition from a method's arguments, those that are None left out; raises InputError that names the first
    that is wrong."""
    entry = dict(constant)
    for argument, value in given.items():
        if argument == "comment" and value is not None:
            wrong = _schema.fault(value, {"type": "string"}, argument)
            if wrong is not None:
                raise refusal(method, *wrong)
            entry = {"_": value, **entry}
        elif value is not None and argument != "self":
            try:
                entry[field_name(argument)] = _schema.plain(value)
            except RecursionError:
                raise refusal(method, argument, "a value", "lists in lists") from None
    wrong = _schema.fault(entry, _schema.definition(definition), "")
    if wrong is not None:
        place, expected, found = wrong
        if not place:  # of several together
            raise InputError(f"Scene.{method}: expected {expected}, found {found}")
        head, *rest = place.strip("/").split("/")
        raise refusal(method, "".join([argument_name(head), *(f"[{part}]" if part.isdigit() else f".{part}" for part in rest)]),
                      expected, found)
    return entry if definition == "domain" else sensible(method, definition, entry)  # whose corners may come one by one


def sensible(method, definition, entry):
    """The entry; raises InputError where its fields do not go together."""
    wrong = nonsense(entry, definition)
    if wrong is not None:
        field, expected, found = wrong
        raise refusal(method, argument_name(field), expected, found)
    return entry
