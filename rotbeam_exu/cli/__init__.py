"""The command line `rotbeam`. Only this package prints, and the bar of a film that is drawn.

A command imports its libraries when it runs, so that --help and theory are quick.
"""

from __future__ import annotations

import inspect
import os
import re
import signal
import sys
import textwrap
import traceback
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import cyclopts

from analytic.warning import RotbeamWarning

from .. import __version__
from .output import print_message, write_utf8

app = cyclopts.App(
    name="rotbeam",
    help="The rotating cantilever beam benchmark: simulation, theory and the exact solution.",
    version=__version__,
    help_epilogue="rotbeam COMMAND --help has examples. Speeds are in rad/s, all else in SI units.",
    default_parameter=cyclopts.Parameter(negative=()),
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
_COMMANDS = {
    "run": "run", "reference": "run", "ramp": "ramp", "backbone": "backbone",
    "campbell": "campbell", "respond": "respond", "stability": "stability", "sweep": "sweep",
    "converge": "sweep", "compare": "paper", "figure": "paper", "table": "paper",
    "explore": "explore", "animate": "animate", "verify": "verify", "kit": "judge",
    "judge": "judge", "schema": "doctor", "doctor": "doctor", "blade": "blade",
    "report": "report", "sensitivity": "sensitivity", "fit": "fit",
}  # fmt: skip
"""Modules of the commands, in the order of the work; each is imported when it is called."""


def documented(command: str) -> tuple[str, tuple[str, ...]]:
    """Return a command's docstring ahead of its parameters, and its examples.

    The examples are the lines of the numpydoc section that begin with "$": command lines, which
    `tests/cli/test_examples.py` runs.
    """
    source = Path(__file__).with_name(f"{_COMMANDS[command]}.py").read_text(encoding="utf-8")
    # Not by a parser: all commands' are read at each call of any, and --help is to be quick.
    (text,) = re.findall(rf'^def {command}\(.*?^    """(.*?)"""$', source, re.DOTALL | re.MULTILINE)
    said, _, rest = inspect.cleandoc(text).partition("Examples\n---")
    lines = (line.removeprefix("$ ") for line in rest.splitlines() if line.startswith("$ "))
    return said.partition("Parameters\n---")[0].strip(), tuple(lines)


for _order, (_command, _module) in enumerate(_COMMANDS.items()):
    _help, _examples = documented(_command)
    app.command(
        f"{__name__}.{_module}:{_command}",
        name=_command, help=_help, sort_key=_order,
        # Markdown, each in a line of its own: two spaces break one.
        help_epilogue="Examples:\n\n" + "  \n".join(_examples),
    )  # fmt: skip

app.register_install_completion_command("--complete", help="Let the shell complete commands.")

INTERNAL = 70
"""Exit code of an error of the program itself, EX_SOFTWARE of sysexits.h."""

UNREAD = 141
"""Exit code where nobody reads on, as a shell has it of SIGPIPE."""

_FORESEEN = (
    cyclopts.CycloptsError, ImportError, MemoryError, OSError, OverflowError, RuntimeError,
    TypeError, ValueError,
)  # fmt: skip
"""Errors with a sentence for the user, on input or on a run that fails."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; bad input is one sentence and exit code 2, a failed run is 1.

    An error of the program itself is INTERNAL.
    """
    arguments = sys.argv[1:] if arguments is None else list(map(str, arguments))
    write_utf8()
    with warnings.catch_warnings(), _ctrl_c_noted() as met:
        warnings.simplefilter("always", RotbeamWarning)
        # Each sentence once; Python's own memory of them ends with every `catch_warnings` within.
        say = cache(lambda text: print_message("warning:", "yellow", text))
        warnings.showwarning = lambda message, *_: say(str(message))
        try:
            app(arguments, exit_on_error=False, print_error=False)
            sys.stdout.flush()
        except BrokenPipeError:
            # Who reads has read enough, as `head` does; the exit must not flush into it again.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            sys.exit(UNREAD)
        except (Exception, KeyboardInterrupt) as error:
            is_end = isinstance(error, KeyboardInterrupt) or not met
            text, code = _ending(error if is_end else KeyboardInterrupt())
            print_message("rotbeam:", "red", text)
            sys.exit(code)


@contextmanager
def _ctrl_c_noted() -> Iterator[list[int]]:
    """Give a list that Ctrl-C joins: Exudyn reports a failed import, or an error of its own."""
    met: list[int] = []

    def note(number: int, _: object) -> None:
        met.append(number)
        raise KeyboardInterrupt

    ours = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if ours:
        signal.signal(signal.SIGINT, note)
    try:
        yield met
    finally:
        if ours:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def _ending(error: BaseException) -> tuple[str, int]:
    """Return the sentence on an error, and the exit code."""
    if isinstance(error, KeyboardInterrupt):
        return f"interrupted; {str(error) or 'nothing was written'}", 130
    if isinstance(error, cyclopts.UnknownOptionError | cyclopts.UnusedCliTokensError):
        return _not_taken(error), 2
    if isinstance(error, cyclopts.MissingArgumentError):
        command = " ".join(["rotbeam", *(error.command_chain or ())])
        missing = str(error)
        if error.keyword is None and error.argument is not None and "Did you" not in missing:
            missing = f"{error.argument.name} is missing."
        return f"{missing} {command} --help explains it", 2
    if isinstance(error, OSError) and error.filename:
        return f"{error.filename}: {error.strerror}", 2
    if isinstance(error, _FORESEEN):
        return str(error), 1 if isinstance(error, RuntimeError) else 2
    return _internal(error.__cause__ or error), INTERNAL


def _internal(error: BaseException) -> str:
    """Return the sentence on an error that is no user's: what, and the last places in the code."""
    places = traceback.extract_tb(error.__traceback__)[-3:]
    said = textwrap.shorten(f"{type(error).__name__}: {error}", 200)
    trace = ", ".join(f"{Path(one.filename).name}:{one.lineno}" for one in places)
    return f"internal error, not of your input: {said} ({trace}); please report it with the command"


def _not_taken(error: cyclopts.UnknownOptionError | cyclopts.UnusedCliTokensError) -> str:
    """Name a similar option, or the unit of a speed that was given in another one."""
    from .options import SPEED_UNITS, in_rad_per_second

    if isinstance(error, cyclopts.UnusedCliTokensError):
        words = error.unused_tokens or []
        units = [word for word in words if word.lower() in SPEED_UNITS]
        return in_rad_per_second(units[0]) if units else f"no option takes {' '.join(words)!r}"
    given = str(error.token.keyword or error.token.value).partition("=")[0].lower()
    if (unit := given.lstrip("-")) in SPEED_UNITS:
        return f"there is no option {given}: {in_rad_per_second(unit)}"
    return f"{error} --help lists the options"
