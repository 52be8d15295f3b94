"""The request of a command as one value: its options, over a file, over the paper's values."""

from __future__ import annotations

import inspect
import math
import sys
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import wraps
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from analytic import Beam, Blade, Theory
from analytic.input_checks import positive
from analytic.loads import Load
from analytic.warning import warn

from ..files.beam_file import RunFile, load_run_file
from ..files.beam_tables import NUMERICS, THEORY, require_keys
from ..runs.attributes import blade_attributes, theory_attributes
from .motion import ChosenMotion, chosen_motion, refuse_rest
from .options import KINDS, OPTIONS, blade_of, deviations_of, loads_of

if TYPE_CHECKING:
    from ..fem.case import RunCase
    from ..fem.elements import Formulation

_GROUPS: dict[str, tuple[str, ...]] = {
    "mesh": ("element", "elements"),
    "discretization": ("element", "elements", "step", "duration", "frame"),
    "section": ("section", "ratio"),
    "load": (*KINDS, "loads of a file"),
    "loads": (*KINDS, "load_frequency"),
    "damping": ("damping_ratio", "external_damping"),
}
"""Words for `uses` that stand for several options."""

_KEYS = {
    "omega": "motion.omega", "speed": "motion.omega", "ramp_time": "motion.ramp_time",
    "load_frequency": "loads", "loads of a file": "loads", "theory": "theory",
    **{key: f"numerics.{key}" for key in NUMERICS.optional},
}  # fmt: skip
"""Tables or keys of a file that options replace."""

_PAPER = {"element": "cable", "elements": 16, "frame": "inertial"}


@dataclass(frozen=True, kw_only=True)
class Request:
    """Blade, theory, loads and numbers that a command was asked for.

    Parameters
    ----------
    config
        The file, if one was given.
    blade
        The file's or the paper's blade, with section and damping of the options.
    theory
        The options' over the file's.
    loads
        Those of the options, or else those of the file.
    uncertainty
        Standard deviations of the blade's numbers.
    options
        Options that were given, by name.
    values
        Numbers and names: options over [motion] and [numerics], over the paper's mesh.
    """

    config: Path | None
    blade: Blade
    theory: Theory
    loads: Sequence[Load]
    uncertainty: Mapping[str, float]
    options: Mapping[str, Any]
    values: Mapping[str, Any]

    @property
    def omega(self) -> float:
        """Rotation speed [rad/s], which is not guessed."""
        if "omega" not in self.values:
            raise ValueError(
                "give the rotation speed in rad/s with --omega, or as omega in [motion] of --config"
            )
        return float(self.values["omega"])

    @property
    def tolerance(self) -> float | None:
        """Largest error of the exact blade; None is that of the function."""
        given = self.values.get("tolerance")
        return None if given is None else positive("tolerance", given)

    def scatter(self, pairs: Sequence[str], length: float | None) -> tuple[dict[str, float], float]:
        """Return deviations by name and their correlation length, of options or of the file."""
        file = dict(self.uncertainty)
        of_file = file.pop("length", math.inf)
        return deviations_of("scatter", pairs) or file, of_file if length is None else length

    @property
    def motion(self) -> ChosenMotion:
        """The spin-up, its end and step, completed by the paper's ratios to ω_0."""
        names = "omega", "ramp_time", "duration", "step"
        return chosen_motion(self.blade, **{n: self.values[n] for n in names if n in self.values})

    @property
    def mesh(self) -> str:
        """Formulation and number of elements as part of a file's name."""
        return f"{self.values['element'].rpartition(':')[2]}-{self.values['elements']}"

    @property
    def section(self) -> str:
        """Shape and ratio of the section as part of a file's name."""
        ratio = f"-{self.options['ratio']:g}" if "ratio" in self.options else ""
        return f"{self.options.get('section', 'given')}{ratio}"

    def case(self, motion: ChosenMotion | None = None) -> RunCase:
        """Return the case of a run of this motion, or of another one."""
        from ..fem.case import RunCase

        harmonic = any(load.varied == "frequency" for load in loads_of(self.options))
        if harmonic and "load_frequency" not in self.options:
            raise ValueError("give the frequency of the load in rad/s with --load-frequency")
        run, mesh = motion or self.motion, {n: self.values[n] for n in ("elements", "frame")}
        refuse_rest(run.spin_up.omega)
        return RunCase(
            blade=self.blade, spin_up=run.spin_up, duration=run.duration, step=run.step,
            element=element_of(self.values["element"]), loads=self.loads, **mesh,
        )  # fmt: skip

    def inputs(self, **more: Any) -> dict[str, Any]:
        """Return the inputs of an answer: blade, theory and more."""
        return {**blade_attributes(self.blade), **theory_attributes(self.theory), **more}


def uses(*names: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the options that it names, and hand it a `Request` in their place.

    `names` are options, words of `_GROUPS`, and keys of a file that have no option, as
    "motion.omega". Of other tables of a file the command uses nothing, and a warning says so.
    """
    words = [word for name in names for word in _GROUPS.get(name, (name,))]
    keys = [_KEYS.get(word, word) for word in words if word in _KEYS or word not in OPTIONS]
    tables = dict.fromkeys(key.partition(".")[0] for key in keys)
    options = [_option(word, OPTIONS[word]) for word in words if word in OPTIONS]
    options.append(_config(tables))

    def wrapped(command: Callable[..., None]) -> Callable[..., None]:
        @wraps(command)
        def with_request(*files: Any, config: Path | None = None, **arguments: Any) -> None:
            mine = {word: arguments.pop(word) for word in words if word in arguments}
            command(_request(config, _configured(config, keys), mine), *files, **arguments)

        of_command = inspect.signature(command)
        _, *others = of_command.parameters.values()
        several = sorted([*options, *others], key=lambda one: one.kind)  # files come first
        signature = of_command.replace(parameters=several)
        vars(with_request)["__signature__"] = signature
        with_request.__annotations__ = {n: of.annotation for n, of in signature.parameters.items()}
        return with_request

    return wrapped


def _option(name: str, kind: Any) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=kind)


def _config(tables: Iterable[str]) -> inspect.Parameter:
    """Return the parameter of the file, with the tables of a run that it may have."""
    titles = ", ".join(f"[[{one}]]" if one == "loads" else f"[{one}]" for one in tables)
    more = f", optionally {titles}; options given here replace its values" if titles else ""
    alone = "Or a blade alone: BeamDyn's primary file, HAWC2's .htc, a CSV of stations."
    text = f"TOML file with [beam] or [blade]{more}. {alone} Without a file: the paper's beam."
    return _option("config", Annotated[Path | None, Parameter(help=text)])


def _request(config: Path | None, file: RunFile, arguments: Mapping[str, Any]) -> Request:
    """Return options and a file as one value, or refuse them."""
    options = {name: of for name, of in arguments.items() if of is not None and of is not False}
    if "speed" in options:
        options["omega"] = options.pop("speed")
    return Request(
        config=config,
        blade=blade_of(file.blade, options),
        theory=Theory(**{**file.theory, **_theory(options.get("theory", ()))}),
        loads=loads_of(options) or file.loads,
        uncertainty=file.uncertainty,
        options=options,
        values={**_PAPER, **_element_of(file.blade), **file.numerics, **file.motion, **options},
    )


def _element_of(blade: Blade) -> dict[str, str]:
    """Return the element of a table of stations, in place of the paper's: it bends in space."""
    return {"element": "space_exact"} if blade.table else {}


def _theory(pairs: Sequence[str]) -> dict[str, Any]:
    """Return the arguments of a `Theory` in the pairs of --theory, which are lines of TOML."""
    try:
        values = tomllib.loads("\n".join(pairs))
    except tomllib.TOMLDecodeError as error:
        raise ValueError(
            f"--theory takes key=value as in a file, as trapeze=false shear=0.3, got "
            f"{' '.join(pairs)!r}: {error}"
        ) from error
    require_keys(values, THEORY, "--theory")
    return values


def _configured(config: Path | None, uses: Sequence[str]) -> RunFile:
    """Return the tables and keys of a file that a command uses; without one, the paper's beam.

    A warning names what it does not use, unless it uses the speed of a motion alone.
    """
    file = RunFile(blade=Beam.reference()) if config is None else load_run_file(config)
    kept: dict[str, Any] = {}
    for name in (one.name for one in fields(file) if one.name not in ("blade", *uses)):
        given = getattr(file, name)
        keys = [use.removeprefix(f"{name}.") for use in uses if use.startswith(f"{name}.")]
        spare = [key for key in given if key not in keys]
        if not spare:
            continue
        whole = name == "loads"
        kept[name] = () if whole else {key: given[key] for key in keys if key in given}
        if not (keys and name == "motion"):
            what = "[[loads]]" if whole else f"{', '.join(spare)} of [{name}]"
            warn(f"{config}: this command does not use {what}")
    return replace(file, **kept)


def element_of(name: str) -> Formulation:
    """Return the formulation of a name, or of one's own class as module:Class.

    Only for names of the command line, whose user may run any code.
    """
    from ..fem.elements import Formulation, formulation

    module, colon, kind = name.partition(":")
    if not colon:
        return formulation(name)
    if (here := str(Path.cwd())) not in sys.path:
        sys.path.append(here)  # where a sweep's workers find it, too
    try:
        cls = getattr(import_module(module), kind)
        if not (isinstance(cls, type) and issubclass(cls, Formulation)):
            raise TypeError("it is no class that inherits from Formulation")
        return formulation(cls())
    except (AttributeError, ImportError, TypeError) as error:
        raise ValueError(
            f"no element can be made of {name}: {error}; give module:Class, the module in this "
            "folder or installed"
        ) from error
