# SPDX-License-Identifier: BSD-3-Clause
"""Writes the manual page of the command `waft` and its completions for bash and zsh, as its parser has it.

    PYTHONPATH=... python3 describe_command.py waft.1 waft.bash _waft
"""
import argparse
import pathlib
import sys

from waft import cli
from waft.loading import version


class Command:
    """What the parser says of `waft` itself or of one of its commands."""

    def __init__(self, name, summary, parser):
        self.name = name
        self.summary = summary
        self.parser = parser
        self._formatter = parser._get_formatter()  # argparse says nowhere else how it shows an option
        self.options = [action for action in parser._actions if action.option_strings]
        self.positionals = [action for action in parser._actions
                            if not action.option_strings and not isinstance(action, argparse._SubParsersAction)]

    def usage(self):
        return " ".join(self.parser.format_usage().split()).removeprefix("usage: ")

    def shown(self, action):
        """An option with its value, as --help shows it."""
        return self._formatter._format_action_invocation(action)

    def help(self, action):
        return self._formatter._expand_help(action)


def commands(main):
    """Those of the parser, in its order."""
    action = next(action for action in main._actions if isinstance(action, argparse._SubParsersAction))
    return [Command(choice.dest, choice.help, action.choices[choice.dest]) for choice in action._choices_actions]


def takes_value(action):
    return action.nargs != 0


def _roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\n".join("\\&" + line if line.startswith(".") else line for line in text.splitlines())


def manual(main):
    lines = [f'.TH WAFT 1 "" "waft {version()}" "User Commands"', ".SH NAME", f"waft \\- {_roff(main.description)}", ".SH SYNOPSIS",
             ".B waft", "COMMAND ...", ".SH DESCRIPTION", "A scene file says what flies and where it is to be and when;",
             ".B waft synthesize", "flies it. Scene files and all commands are described in the user guide, below.", ".SH OPTIONS"]
    whole = Command("waft", "", main)
    for action in whole.options:
        lines += [".TP", f".B {_roff(whole.shown(action))}", _roff(whole.help(action))]
    lines.append(".SH COMMANDS")
    for command in commands(main):
        lines += [f".SS {_roff(command.name)}", _roff(command.summary[0].upper() + command.summary[1:]) + ".", ".PP",
                  f".B {_roff(command.usage())}"]
        for action in [*command.positionals, *command.options]:
            lines += [".TP", f".B {_roff(command.shown(action))}", _roff(command.help(action))]
        if command.parser.epilog and command.parser.epilog != main.epilog:
            lines += [".PP", _roff(" ".join(command.parser.epilog.split()))]
    lines += [".SH EXIT STATUS", _roff(" ".join(main.epilog.split()).removeprefix("exit status: ")), ".SH FILES", ".TP",
              ".I share/doc/waft/Documentation/UserGuide.md", "the user guide, below the prefix of the installation", ".TP",
              ".I share/waft/Data/Scenes", "scenes to begin with", ".SH SEE ALSO", ".BR paraview (1)"]
    return "\n".join(lines) + "\n"


def completion_of_bash(main):
    all_commands = commands(main)
    values = [f'    "{command.name} {option}") words="{" ".join(map(str, action.choices))}" ;;'
              for command in all_commands for action in command.options if action.choices for option in action.option_strings]
    own = [f'        {command.name}) words="{" ".join(s for action in command.options for s in action.option_strings)}" ;;'
           for command in all_commands]
    top = " ".join([*(command.name for command in all_commands),
                    *(s for action in Command("waft", "", main).options for s in action.option_strings)])
    return "\n".join([
        "# Completion of the command waft for bash; where nothing is offered names of files are.",
        "_waft() {",
        '  local words="" current="${COMP_WORDS[COMP_CWORD]}"',
        "  COMPREPLY=()",
        '  case "${COMP_WORDS[1]} ${COMP_WORDS[COMP_CWORD-1]}" in',
        *values,
        "    *)",
        f'      if [ "$COMP_CWORD" -eq 1 ]; then words="{top}"',
        '      elif [[ "$current" == -* ]]; then case "${COMP_WORDS[1]}" in',
        *own,
        "      esac; fi ;;",
        "  esac",
        '  COMPREPLY=($(compgen -W "$words" -- "$current"))',
        "}",
        "complete -o default -F _waft waft",
    ]) + "\n"


def _zsh(text):
    for letter in "\\[]:":
        text = text.replace(letter, "\\" + letter)
    return text.replace("'", "'\\''")


def _specification(command, action):
    """An argument of zsh's _arguments."""
    value = ""
    if takes_value(action):
        offered = f"({' '.join(map(str, action.choices))})" if action.choices else "_files"
        value = f"{'::' if action.nargs == '?' else ':'}{_zsh(str(action.metavar or action.dest))}:{offered}"
    if not action.option_strings:
        return f"'{'*' if action.nargs == '*' else ''}{value}'"
    return " ".join(f"'{option}[{_zsh(command.help(action))}]{value}'" for option in action.option_strings)


def completion_of_zsh(main):
    all_commands = commands(main)
    lines = ["#compdef waft", "# Completion of the command waft for zsh.", "local state line", "local -a commands", "commands=("]
    lines += [f"  '{command.name}:{_zsh(command.summary)}'" for command in all_commands]
    whole = Command("waft", "", main)
    lines += [")", " ".join(["_arguments -C", *(_specification(whole, action) for action in whole.options),
                             "'1: :->command' '*:: :->argument'"]),
              'case "$state" in', "  command) _describe command commands ;;", '  argument) case "$words[1]" in']
    for command in all_commands:
        specifications = [_specification(command, action) for action in [*command.options, *command.positionals]]
        lines.append(f"    {command.name}) _arguments {' '.join(specifications)} ;;")
    return "\n".join([*lines, "  esac ;;", "esac"]) + "\n"


def write(path, text):
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    parser = cli.parser()
    for name, made in zip(sys.argv[1:], (manual, completion_of_bash, completion_of_zsh)):
        write(name, made(parser))
