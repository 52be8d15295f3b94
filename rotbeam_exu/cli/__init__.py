"""The command line `rotbeam`. Only this package prints."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence

import cyclopts
from rich.console import Console

from analytic.input_checks import RotbeamWarning

from .. import __version__

app = cyclopts.App(
    name="rotbeam",
    help="The rotating cantilever beam benchmark: simulation, theory and the exact answer.",
    version=__version__,
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
for _command in (
    "run",
    "sweep",
    "backbone",
    "compare",
    "compare_modes",
    "figure",
    "table",
    "verify",
    "explore",
    "animate",
    "doctor",
):
    app.command(f"{__name__}.{_command}:{_command}", name=_command.replace("_", "-"))


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; bad input is one sentence and exit code 2, a failed run is 1."""
    errors = Console(stderr=True, highlight=False, soft_wrap=True)

    def one_line(message: Warning | str, *_: object) -> None:
        errors.print(f"[yellow]warning:[/] {message}")

    with warnings.catch_warnings():
        warnings.simplefilter("always", RotbeamWarning)
        warnings.showwarning = one_line  # type: ignore[assignment]
        try:
            app(arguments, exit_on_error=False, print_error=False)
        except (cyclopts.CycloptsError, ValueError, TypeError, OSError, ImportError) as error:
            errors.print(f"[red]rotbeam:[/] {_sentence(error)}", markup=True)
            sys.exit(2)
        except RuntimeError as error:
            errors.print(f"[red]rotbeam:[/] {_sentence(error)}")
            sys.exit(1)
        except KeyboardInterrupt:
            errors.print("[red]rotbeam:[/] interrupted; nothing was written")
            sys.exit(130)


def _sentence(error: BaseException) -> str:
    """Return the text of an error as one line, safe to print as markup."""
    return " ".join(str(error).split()).replace("[", "\\[")
