"""Bad input to the commands: one sentence each, exit code 2, and nothing written."""

import re
import shlex
from itertools import chain

import pytest

from rotbeam_exu.cli import _COMMANDS, app
from tests.beams import BLADE_TOML
from tests.files.test_beam_file import STATIONS

FILES = {
    "stations": STATIONS, "blade": BLADE_TOML, "slip": "[motion]\nomga = 6",
    "load": "[[loads]]\nkind = 'Gravity'\n",
    "motion": "[motion]\nomega = 4", "element": "[numerics]\nelement = 'cabel'",
    "frame": "[numerics]\nframe = 'rotated'",
}  # fmt: skip
RUN, SWEEP, RESPOND = "run ", "sweep --omega 6 --ramp-time 3 ", "respond --from 3.6 --to 4 "
COMMAND = "verify --command 'true {case} {elements} {step} {out}' -o mine"
STABILITY, GRAVITY = "stability --omega 2 ", f"{RESPOND}--gravity --damping-ratio 0.1 "
HELP = "requires an argument. rotbeam {} --help explains it"


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        # Numbers: what is none, and what would never end.
        ("run --elements 2.5", "it must be a whole number"),
        ("sweep --jobs 1e1", "it must be a whole number"),
        ("table nan", "it must be"),
        ("table 6", "it must be"),
        ("table every", "it must be"),
        ("animate --rate 0.6", "it must be a whole number"),
        ("animate --rate 0", "rate must be at least 1"),
        ("campbell --points ''", "it must be a whole number"),
        ("campbell --points 1", "points must be at least 2"),
        ("campbell --count 1000000000", "at most 256 functions are taken"),
        ("backbone --omega 6 --exact --functions 1000000", "at most 256 functions"),
        ("run --omega nan", "omega must be finite"),
        ("run --ramp-time -2", "ramp_time must be positive, got -2.0 s"),
        ("run --omega 0", "nothing oscillates: take a speed above zero, as 6 rad/s"),
        ("run --omega 6rpm", "in rad/s, as --omega, and 1 rpm is 0.10472 rad/s"),
        ("run --omega 60 rpm", "in rad/s, as --omega, and 1 rpm is 0.10472 rad/s"),
        ("sweep --omega 4 6Hz", "it must be a number, got '6Hz'; speeds are in rad/s"),
        ("campbell --omega-max 6 now", "no option takes 'now'"),
        ("run --rpm 60", "as --omega, and 1 rpm is 0.10472 rad/s"),
        ("sweep --hz=1.5", "1 hz is 6.28319 rad/s"),
        # Options: what is missing or unknown, and endings.
        ("run --speed 6", "--speed"),
        ("run --omega", f"--omega {HELP.format('run')}"),
        ("run --config none.toml", "there is no file none.toml"),
        ("run --config ../slip.toml", "unknown key 'omga' in [motion]; did you mean 'omega'?"),
        ("run --config ../element.toml", "unknown element 'cabel'"),
        ("run --config ../frame.toml", "unknown frame 'rotated'"),
        ("compare --config ../blade.toml", "for a [blade] take rotbeam backbone"),
        ("explore --config ../stations.toml", "the Explorer is of a straight blade in its plane"),
        ("verify --config ../stations.toml", "verify has references of a straight blade in its"),
        (
            "backbone --omega 1 --variant FrM --config ../stations.toml",
            ": leave the variants out",
        ),
        ("run --tip-force 1", "with --load-frequency"),
        ("respond --to 2", "give one load, --ripple, --tip-force, --distributed-force or"),
        ("figure", "NUMBER is missing. rotbeam figure --help explains it"),
        ("figure -- 7", "it must be 3, 4, 5, 8"),
        ("figure -- x", "it must be 3, 4, 5, 8"),
        ("figure 8 --style House", "house"),
        ("figure 8 --config ../blade.toml", "Unknown option: --config"),
        ("figure 13 --style sepia", "unknown style 'sepia'; known are house, journal, grey"),
        ("verify --command x", "give the folder of your submission with --out"),
        (f"{COMMAND} --element cable", "--command runs cases of the benchmark"),
        (f"{COMMAND} --config ../blade.toml", "--command runs cases of the benchmark"),
        (f"{COMMAND} --case S9", "there is no case 'S9': it must be L, S1"),
        (f"{COMMAND} --elements 2.5", "it must be a whole number"),
        (f"{COMMAND} --elements 0", "elements must be at least 1"),
        (f"{COMMAND} --step nan", "step must be finite"),
        (f"{COMMAND} --budget nan", "budget must be finite"),
        (f"{COMMAND} --seconds 1min", "it must be a number"),
        (f"{COMMAND} --memory 0", "memory must be positive"),
        ("verify --command 'none {case} {elements} {step}' -o mine", "no program 'none'"),
        ("verify --command 'true {case} {elements}' -o mine", "must have {case} and {elements}"),
        ("verify --element cabel", "unknown element 'cabel'; known are 'cable', "),
        ("backbone --omega 6 --variant frn", "variant must be one of "),
        ("backbone --omega 6 --mode 2 --variant FrE", "the reduced models are of lag 1"),
        ("backbone --omega 6 --format text", 'Choose from: "table", "csv"'),
        ("animate --beside cable", "linear"),
        ("animate --height 0.04 --out film.pvd", "give width too, or leave both out"),
        ("animate --out beam.avi", "the ending must be .gif or .mp4, or .pvd for ParaView"),
        (
            "run --element cable --config ../stations.toml",
            "on the command line --element space_exact",
        ),
        ("ramp --mode 'flap 1'", "no change of the speed excites flap 1 of this blade"),
        (f"{STABILITY}--config ../stations.toml", "planar motion is of a straight blade in its"),
        ("explore --out explorer.pdf", "the ending must be .html"),
        ("judge mine --report a.pdf", "the ending must be .html"),
        ("judge mine --json a.txt", "the ending must be .json"),
        ("judge none", "name that of the submission"),
        ("judge mine --run", "Unknown option: --run"),
        ("judge mine --case S9", "there is no case 'S9': it must be L, S1"),
        # Sweeps, meshes and ramps.
        (f"{SWEEP}--omega 4 4", "omegas holds 4 more than once"),
        (f"{SWEEP}--step nan", "step must be finite, got nan s"),
        (f"{SWEEP}--omega 0 4", "at omega = 0 rad/s the beam stays at rest"),
        (f"{SWEEP}--ramp-time 3 -3", "ramp_time must be positive, got -3.0 s"),
        ("converge --omega 0", "nothing oscillates"),
        ("converge --elements 1", "elements must be at least 2"),
        ("converge --tolerance 0", "tolerance"),
        ("ramp --omega 0", "nothing oscillates"),
        ("ramp --longest 1", "longest must be above 0.8 periods at rest"),
        ("ramp --points -1", "points must be at least 0"),
        ("ramp --element none", "element"),
        # The plane, and loads.
        ("stability --section tub", 'Choose from: "rectangle"'),
        (STABILITY, "give --section rectangle or --section tube"),
        (f"{STABILITY}--section tube --ratio 2", "give it with a --section that has both"),
        (f"{STABILITY}--section rectangle --ratio 0", "ratio must be positive"),
        (f"{STABILITY}--section tube --mode 0", "mode must be at least 1"),
        (f"{STABILITY}--section tube --amplitude 1.5", "must be below 1, got 1.5"),
        (f"{STABILITY}--section rectangle --config ../blade.toml", "give width in m, or ratio"),
        (f"{RESPOND}--omega 6", "or --gravity, got none"),
        (f"{RESPOND}--gravity --ripple 0.1", "got --ripple and --gravity"),
        (f"{RESPOND}--omega 6 --tip-force 0", "--tip-force 0 is no load"),
        (f"{RESPOND}--tip-force 1 --damping-ratio 0.1", "rotation speed in rad/s with --omega"),
        (f"{RESPOND}--omega 6 --tip-force 1", "is undamped"),
        (f"{RESPOND}--omega 6 --tip-force 1 --damping-ratio 0", "has no end at resonance"),
        (f"{RESPOND}--rippel 1", "Did you mean --ripple?"),
        (f"{RESPOND}--gravity --damping-ratio -0.1", "ratio must not be negative"),
        (f"{GRAVITY}--omega 6", "leave --omega out"),
        (f"{GRAVITY}--external-damping 1", "not both"),
        (f"{GRAVITY}--points 1", "points must be at least 2"),
        ("respond --from 3 --to 3 --gravity --damping-ratio 0", "--to must be above --from, got 3"),
    ],
)
def test_it_is_one_sentence_and_nothing_is_written(call, tmp_path, monkeypatch, command, sentence):
    for name, text in FILES.items():
        (tmp_path / f"{name}.toml").write_text(text)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    code, out, error = call(*shlex.split(command))
    assert (code, out) == (2, "")
    assert sentence in error
    assert error.startswith("rotbeam: ")
    assert len(error.strip().splitlines()) == 1
    assert not [path for path in tmp_path.glob("here/**/*") if path.is_file()]


def _numbers(command):
    """Names of a command's options whose value is a number."""
    arguments = app[command].assemble_argument_collection()
    return [
        (command, one.name)
        for one in arguments
        if one.parse and one.name.startswith("--") and re.search(r"int|float", str(one.hint))
    ]


OPTIONS = list(chain.from_iterable(map(_numbers, _COMMANDS)))


@pytest.mark.parametrize("text", ["None", "null"])
@pytest.mark.parametrize(("command", "option"), OPTIONS)
def test_none_is_no_number_and_not_the_default(call, tmp_path, monkeypatch, command, option, text):
    monkeypatch.chdir(tmp_path)
    needed = {"respond": {"--from": "3", "--to": "4"}, "fit": {"--free": "m"}}.get(command, {})
    first = {"figure": ["9"], "fit": ["measured.csv"]}.get(command, [])
    code, out, error = call(command, *first, *chain(*({**needed, option: text}).items()))
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert f"Invalid value for {option}: " in error
    assert text in error


def test_there_are_numbers_to_try():
    assert {("run", "--omega"), ("sweep", "--ramp-time"), ("respond", "--gravity")} <= {*OPTIONS}
