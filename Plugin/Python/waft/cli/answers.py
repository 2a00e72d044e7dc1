# SPDX-License-Identifier: BSD-3-Clause
"""What the command answers on stdout: lines to be read, or with --json one document for programs, which
Documentation/command.schema.json describes."""
import json
import sys

from waft.loading import version
from waft.texts import line, say
from waft.watching import report_to_guard


def tell(options, text):
    """A line of the answer, but in the document."""
    if not options.as_json:
        print(line(text))
    say(text, "record")


def answer(options, status, error=None):
    """The document, where it is wanted: what the command put into options.answer and how it ended."""
    if not options.as_json:
        return
    report_to_guard("words", "")  # nobody else has to say anything
    document = {"waft": version(), "command": options.command, "status": status}
    document.update({"error": line(error)} if error is not None else options.answer)
    json.dump(document, sys.stdout, indent=2, allow_nan=False)
    print()
