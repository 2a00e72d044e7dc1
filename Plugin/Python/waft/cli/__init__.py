# SPDX-License-Identifier: BSD-3-Clause
"""The command `waft`."""
from waft.cli.command import main, parse, parser

__all__ = ["main", "parse", "parser"]
