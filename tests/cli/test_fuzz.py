"""Any text as the value of an option ends in an answer or in one sentence, never a traceback."""

import contextlib
import io
import tempfile
import warnings

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotbeam_exu.cli import main

HOSTILE = st.sampled_from(
    ["", "-", "--", "nan", "inf", "-inf", "0", "-0.0", "-1", "1e-320", "1e308", "1e999", "0x10",
     "1_000", "2.5", "9" * 40, "9" * 400, "٣", "½", "[red]", "[/]", ":smile:", "\\", "%s", "{}",
     "ω", "a=b", "=", "true", "None", "1,2", "../x", "*", "💥", "-h", "\n", "\t1", " 2 "]
)  # fmt: skip
VALUES = (
    HOSTILE
    | st.integers(-3, 3).map(str)
    | st.floats(-5.0, 5.0).map("{:.2g}".format)
    | st.text(alphabet=st.characters(blacklist_characters="\x00"), max_size=6)
)

# What keeps a command cheap, and the options that are tried on it. A speed, a ramp or a duration
# that is drawn may cost what it likes: each run ends by its checks, and meshes are of one element.
RUN = ("run", "--elements", "1", "--step", "0.02", "--duration", "6", "--out", "{folder}/out")
COMMANDS = {
    "run": (RUN, ("--omega", "--ramp-time", "--element", "--option", "--frame", "--config",
                  "--rpm", "--speed")),
    "sweep": (("sweep", *RUN[1:], "--omega", "6", "--ramp-time", "3", "--jobs", "1", "--cache",
               "{folder}/cache"),
              ("--ramp-time", "--shard", "--option", "--element", "--frame")),
    "backbone": (("backbone", "--omega", "6", "--amplitude", "0.1"),
                 ("--omega", "--variant", "--amplitude", "--format", "--config")),
    "table": (("table",), ("", "--format")),
    "figure": (("figure", "none", "--out", "{folder}/out"), ("--jobs", "--dpi")),
    "explore": (("explore", "--out", "{folder}/page.pdf"), ("--jobs", "--cache")),
    "verify": (("verify", "--element", "none"), ("--element", "--config")),
    "campbell": (("campbell", "--points", "2", "--count", "1", "--orders", "1"),
                      ("--format", "--omega-min", "--points=")),
    "respond": (("respond", "--from", "1", "--to", "2", "--points", "2", "--damping-ratio", "0.1",
                 "--gravity", "--out", "{folder}/out"),
                ("--gravity", "--damping-ratio", "--omega", "--ripple", "--config")),
    "ramp": (("ramp", "--longest", "3", "--points", "0", "--finite-element-points", "0", "--out",
              "{folder}/out"),
             ("--omega", "--longest", "--points", "--element", "--elements", "--config")),
    "stability": (("stability", "--omega", "1", "--section", "tube", "--amplitude", "0.02",
                   "--out", "{folder}/out"),
                  ("--section", "--ratio", "--poisson-ratio", "--amplitude", "--mode", "--config")),
    "animate": (("animate", "--out", "{folder}/film.pdf"),
                ("--omega", "--ramp-time", "--duration", "--rate", "--slow-motion", "--config")),
}  # fmt: skip


@st.composite
def command_lines(draw):
    fixed, options = COMMANDS[draw(st.sampled_from(sorted(COMMANDS)))]
    tried = draw(st.lists(st.tuples(st.sampled_from(options), VALUES), min_size=1, max_size=2))
    given_last = [text for option, value in tried for text in (option, value) if text or value]
    # The value of an option that is fixed and tried is the one that is tried.
    names = {option for option, _ in tried}
    kept, skip = [], False
    for text in fixed:
        skip = skip or text in names
        if not skip:
            kept.append(text)
        elif not text.startswith("-"):
            skip = False
    return [*kept, *given_last]


def tried(arguments):
    """The exit code and the two streams of a command line in a folder of its own."""
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="\n") for _ in range(2))
    code = 0
    with (
        tempfile.TemporaryDirectory() as folder,
        contextlib.chdir(folder),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        warnings.catch_warnings(),
    ):
        try:
            main([text.replace("{folder}", folder) for text in arguments])
        except SystemExit as stop:
            code = stop.code or 0
    streams = []
    for stream in (out, err):
        stream.flush()
        streams.append(stream.buffer.getvalue().decode("utf-8", "replace"))
    return code, *streams


# 25 by default, 625 by `make test-all`.
@settings(
    max_examples=settings().max_examples ** 2 // 16, deadline=None, derandomize=True,
    suppress_health_check=list(HealthCheck),
)  # fmt: skip
@given(command_lines())
def test_a_command_line_answers_or_says_why_not(arguments):
    code, out, err = tried(arguments)
    assert code in (0, 1, 2), (arguments, code)
    assert "Traceback" not in out + err
    beside = ("warning:", "spin-ups:")  # not an error, but on the same stream
    sentences = [line for line in err.split("\n") if line and not line.startswith(beside)]
    if code == 0:
        assert sentences == [], arguments
    else:
        assert len(sentences) == 1, (arguments, sentences)
        assert sentences[0].startswith("rotbeam: ")
        assert len(sentences[0]) > len("rotbeam: x")


def test_no_arguments_and_no_command():
    assert tried([])[0] == 0
    assert tried(["rum"])[0] == 2
    assert tried(["run", "6"])[0] == 2
