"""The command line `rotbeam`. Only this package prints.

What a command computes with is imported when it runs, so that --help and theory are quick.
"""

from __future__ import annotations

import difflib
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
    """Refuse None and null, which a script writes for what it lacks: they would be the default."""
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
    help="The rotating cantilever beam benchmark: simulation, theory and the exact answer.",
    version=__version__,
    help_epilogue="rotbeam COMMAND --help has examples. Speeds are in rad/s, all else in SI units.",
    default_parameter=cyclopts.Parameter(negative=()),
    result_action="return_value",
    suppress_keyboard_interrupt=False,
    config=_refuse_none,
)
_COMMANDS = (
    "run", "reference", "ramp", "backbone", "campbell", "respond", "stability", "sweep",
    "compare", "figure", "table", "explore", "animate", "verify", "kit", "judge", "doctor",
)  # fmt: skip
"""In the order of the work; each is imported when it is called."""


def documented(command: str) -> tuple[str, tuple[str, ...]]:
    """Return what a command's docstring says ahead of its parameters, and its examples.

    The examples are the lines of the numpydoc section that begin with "$": command lines,
    each of which `tests/cli/test_examples.py` runs.
    """
    source = Path(__file__).with_name(f"{command}.py").read_text(encoding="utf-8")
    # Not by a parser: all commands' are read at each call of any, and --help is to be quick.
    (text,) = re.findall(rf'^def {command}\(.*?^    """(.*?)"""$', source, re.DOTALL | re.MULTILINE)
    said, _, rest = inspect.cleandoc(text).partition("Examples\n---")
    lines = (line.removeprefix("$ ") for line in rest.splitlines() if line.startswith("$ "))
    return said.partition("Parameters\n---")[0].strip(), tuple(lines)


def epilogue(examples: tuple[str, ...]) -> str:
    """Return examples as Markdown, each in a line of its own: two spaces break one."""
    return "Examples:\n\n" + "  \n".join(examples) if examples else ""


for _order, _command in enumerate(_COMMANDS):
    _help, _examples = documented(_command)
    app.command(
        f"{__name__}.{_command}:{_command}",
        name=_command, help=_help, help_epilogue=epilogue(_examples), sort_key=_order,
    )  # fmt: skip

_SPEED_UNITS = {"rpm": math.pi / 30.0, "hz": 2.0 * math.pi, "rps": 2.0 * math.pi}
"""Options that are none, and what one of their units is in rad/s."""


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
            stop(_unknown_option(error, arguments), 2)
        except cyclopts.MissingArgumentError as error:
            stop(_missing(error), 2)
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


def _missing(error: cyclopts.MissingArgumentError) -> str:
    """Say what has to be given, and where it is explained."""
    assert error.argument is not None
    command = " ".join(["rotbeam", *(error.command_chain or ())])
    name = error.argument.name
    if error.keyword is not None:
        what = f"{error.keyword} needs a value"
    elif error.argument.field_info.is_positional:
        what = f"give {name.lstrip('-').upper()}"
    else:
        what = f"give {name}"
    return f"{what}; {command} --help tells of it"


def _unknown_option(error: cyclopts.UnknownOptionError, arguments: Sequence[str]) -> str:
    """Name a similar option only if it is similar, and a speed in rad/s if it was one in rpm."""
    given = str(error.token.keyword or error.token.value).partition("=")[0]
    name = given.lstrip("-").lower()
    if name in _SPEED_UNITS:
        return f"there is no option {given}: {_in_radians(given, name, arguments)}"
    known = {
        option.lstrip("-")
        for argument in error.argument_collection or ()
        for option in argument.names
    }
    close = [option for option in sorted(known) if name and option.startswith(name)]
    close += difflib.get_close_matches(name, sorted(known), n=1, cutoff=0.75)
    if name == "speed" and "omega" in known:
        close = ["omega"]
    hint = f"did you mean --{close[0]}?" if close else "--help lists what there is"
    return f"there is no option {given}; {hint}"


def _in_radians(given: str, name: str, arguments: Sequence[str]) -> str:
    """Say how to give a rotation speed that was given in another unit."""
    at = next(i for i, text in enumerate(arguments) if text.split("=")[0] == given)
    value = arguments[at].partition("=")[2] or "".join(arguments[at + 1 : at + 2])
    try:
        speed = f"{float(value) * _SPEED_UNITS[name]:.6g}"
    except ValueError:
        return f"speeds are in rad/s, and 1 {name} is {_SPEED_UNITS[name]:.6g} rad/s"
    return f"speeds are in rad/s, and {value} {name} are --omega {speed}"
