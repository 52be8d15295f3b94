"""The command line `rotbeam`. Only this package prints.

A command imports its libraries when it runs, so that --help and theory are quick.
"""

from __future__ import annotations

import inspect
import math
import os
import re
import sys
import warnings
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import NoneType
from typing import get_args

import cyclopts

from analytic.warning import RotbeamWarning

from .. import __version__
from .endings import Messages, sentence_on, stopped_as_by_ctrl_c
from .output import ready_streams


def _refuse_none(
    _: cyclopts.App, __: tuple[str, ...], arguments: cyclopts.ArgumentCollection
) -> None:
    """Refuse None and null, which a script writes for a missing value; they mean the default."""
    for argument in arguments:
        if NoneType in get_args(argument.hint) and not {str, Path} & set(get_args(argument.hint)):
            for token in argument.tokens:
                if token.value.lower() in ("none", "null"):
                    raise ValueError(
                        f"{token.keyword} must have a value, got {token.value}: leave it out to "
                        "have the default"
                    )


app = cyclopts.App(
    name="rotbeam",
    help="The rotating cantilever beam benchmark: simulation, theory and the exact solution.",
    version=__version__,
    help_epilogue="rotbeam COMMAND --help has examples. Speeds are in rad/s, all else in SI units.",
    default_parameter=cyclopts.Parameter(negative=()),
    result_action="return_value",
    suppress_keyboard_interrupt=False,
    config=_refuse_none,
)
_COMMANDS = (
    "run", "reference", "ramp", "backbone", "campbell", "respond", "stability", "sweep",
    "converge", "compare", "figure", "table", "explore", "animate", "verify", "kit", "judge",
    "schema", "doctor",
)  # fmt: skip
"""In the order of the work; each is imported when it is called."""


def documented(command: str) -> tuple[str, tuple[str, ...]]:
    """Return a command's docstring ahead of its parameters, and its examples.

    The examples are the lines of the numpydoc section that begin with "$": command lines, which
    `tests/cli/test_examples.py` runs.
    """
    source = Path(__file__).with_name(f"{command}.py").read_text(encoding="utf-8")
    # Not by a parser: all commands' are read at each call of any, and --help is to be quick.
    (text,) = re.findall(rf'^def {command}\(.*?^    """(.*?)"""$', source, re.DOTALL | re.MULTILINE)
    said, _, rest = inspect.cleandoc(text).partition("Examples\n---")
    lines = (line.removeprefix("$ ") for line in rest.splitlines() if line.startswith("$ "))
    return said.partition("Parameters\n---")[0].strip(), tuple(lines)


for _order, _command in enumerate(_COMMANDS):
    _help, _examples = documented(_command)
    app.command(
        f"{__name__}.{_command}:{_command}", name=_command, help=_help, sort_key=_order,
        # Markdown, each in a line of its own: two spaces break one.
        help_epilogue="Examples:\n\n" + "  \n".join(_examples),
    )  # fmt: skip

app.register_install_completion_command("--complete", help="Let the shell complete commands.")

_SPEED_UNITS = {"--rpm": math.pi / 30.0, "--hz": 2.0 * math.pi, "--rps": 2.0 * math.pi}
"""Options that do not exist, and their units in rad/s."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; bad input is one sentence and exit code 2, a failed run is 1."""
    arguments = sys.argv[1:] if arguments is None else list(map(str, arguments))
    ready_streams()
    messages = Messages()

    def stop(text: str, code: int) -> None:
        with suppress(OSError):  # of a terminal that is closed
            messages.count()
            messages.say("rotbeam:", "red", text)
        sys.exit(128 + met[0] if met else code)

    with warnings.catch_warnings(), stopped_as_by_ctrl_c() as met:
        warnings.simplefilter("always", RotbeamWarning)
        warnings.showwarning = messages.warn  # type: ignore[assignment]
        try:
            app(arguments, exit_on_error=False, print_error=False)
            sys.stdout.flush()
            messages.count()
        except BrokenPipeError:
            # Who reads has read enough, as `head` does; the exit must not flush into it again.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            sys.exit(1)
        except cyclopts.UnknownOptionError as error:
            stop(_unknown_option(error), 2)
        except cyclopts.MissingArgumentError as error:
            command = " ".join(["rotbeam", *(error.command_chain or ())])
            stop(f"{error} {command} --help explains it", 2)
        except OverflowError as error:
            stop(f"a number is too large to compute with ({error})", 2)
        except OSError as error:
            stop(sentence_on(error), 2)
        except (cyclopts.CycloptsError, ValueError, TypeError, ImportError) as error:
            stop(str(error), 2)
        except MemoryError as error:
            stop(f"there is not enough memory ({error}): take fewer or shorter", 1)
        except RuntimeError as error:
            stop(str(error), 1)
        except KeyboardInterrupt as interrupt:
            stop(f"interrupted; {interrupt}" if interrupt.args and str(interrupt) else
                 "interrupted; nothing was written", 130)  # fmt: skip


def _unknown_option(error: cyclopts.UnknownOptionError) -> str:
    """Name a similar option, or the unit of a speed that was given in another one."""
    given = str(error.token.keyword or error.token.value).partition("=")[0].lower()
    if given in _SPEED_UNITS:
        unit = f"1 {given.lstrip('-')} is {_SPEED_UNITS[given]:.6g} rad/s"
        return f"there is no option {given}: speeds are in rad/s, as --omega, and {unit}"
    return f"{error} --help lists the options"
