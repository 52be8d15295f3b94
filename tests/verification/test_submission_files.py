"""A submission reads back as it was written; a malformed one gives sentences, all at once."""

import math
import re
import shutil
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from analytic.theory import Theory
from rotbeam_exu.verification.cases import VERSION
from rotbeam_exu.verification.submission import Declaration, Row, Run, Submission
from rotbeam_exu.verification.submission_files import digests, read_submission, write_submission
from rotbeam_exu.verification.submission_files.faults import MalformedSubmissionError

DECLARATION = Declaration(
    code="Balken", version="2.1", url="https://example.org", licence="MIT", element="B22",
    machine="one core", remarks='of "two\nlines", and\ta tail', authors=("A. Å.", "B"),
    theory=Theory(rotary_inertia=True, shear=0.3205, engesser=True), inextensible=True,
    order=4.0, order_in_step=2.0, benchmark=VERSION,
)  # fmt: skip


def history(case, elements, step, duration=15.0, **rest):
    time = np.arange(0.0, duration + 0.01, 0.02)
    return Run(
        case=case, elements=elements, step=step, time=time, q=np.sin(3.1 * time) / 3.0,
        file=f"{case}/m{elements:03d}_h{step:.0e}.csv".replace("e-0", "e-"), **rest,
    )  # fmt: skip


def whole():
    empty = np.empty(0)
    runs = (
        history("S1", 8, 1e-3, dof=36, wall=1.25, cpu=1.0),
        history("S1", 16, 1e-3, remark="slow, but sure"),
        Run(case="S1", elements=32, step=1e-3, time=empty, q=empty, failure='no "licence", so',
            file="S1/m032_h1e-3.csv"),
        history("S1+h", 16, 5e-4),
        history("S2", 16, 2e-3, 20.0),
    )  # fmt: skip
    rows = (
        Row(elements=8, speed=0.0, values=(2.90928123456,)),
        Row(elements=8, speed=8.0, failure="buckles"),
        Row(case="B", elements=8, speed=2.0, amplitude=0.1, values=(3.14159265358,)),
    )
    return Submission(declaration=DECLARATION, rows=rows, runs=runs)


@pytest.fixture
def good(tmp_path):
    """A folder with a whole submission."""
    return write_submission(whole(), tmp_path / "good")


FILES = ["entry.toml", "L.csv", "B.csv", "runs.csv", "S1/m008_h1e-3.csv", "S2/m016_h2e-3.csv",
         "F.csv", "P.csv", "W/m016_h1e-3.csv", "L/m016_w6.csv"]  # fmt: skip


@pytest.fixture
def of_every_kind(tmp_path):
    """A folder with all kinds of files: tables and a history in space, a free vibration."""
    plane, time = whole(), np.arange(0.0, 20.01, 0.02)
    tip = np.outer(np.sin(3.1 * time[:751]), (0.1, 0.02, 0.3))
    turning = Row(case="F", elements=8, speed=1.0, number=7, values=(61.803398875,))
    mine = replace(
        plane,
        rows=(
            *plane.rows,
            turning,
            Row(case="P", elements=8, speed=1.0, values=(1e-3 / 3, 0.1 / 3, 0.7 / 3)),
        ),
        runs=(*plane.runs, Run(case="W", elements=16, step=1e-3, time=time[:751], q=tip)),
    )
    folder = write_submission(mine, tmp_path / "every")
    (folder / "L").mkdir()
    free = np.column_stack([time, 0.01 * np.cos(3.73 * time)])
    np.savetxt(folder / "L/m016_w6.csv", free, "%.12g", ",", header="time,q", comments="")
    assert set(FILES) <= set(digests(folder, read_submission(folder)))
    return folder


def faults_of(folder):
    with pytest.raises(MalformedSubmissionError) as caught:
        read_submission(folder)
    return list(map(str, caught.value.faults))


def same(one, two):
    if isinstance(one, np.ndarray):
        return np.array_equal(one, two)
    return one == two or (isinstance(one, float) and math.isnan(one) and math.isnan(two))


def test_what_is_written_reads_back_to_the_last_bit(good):
    wrote, read = whole(), read_submission(good)
    assert read.declaration == wrote.declaration
    assert len(read.runs) == len(wrote.runs)
    for ours, theirs in zip(wrote.runs + wrote.rows, read.runs + read.rows, strict=True):
        for name in vars(ours):
            assert same(getattr(ours, name), getattr(theirs, name)), (ours, name)


def test_bernoulli_euler_reads_back(tmp_path):
    plain = replace(whole(), declaration=Declaration(code="a", benchmark=VERSION))
    assert read_submission(write_submission(plain, tmp_path)).declaration == plain.declaration


def test_shear_may_be_given_as_its_author_has_it(good):
    text = (good / "entry.toml").read_text("utf-8").replace("share = 0.3205", "k_s = 5e-1\nnu=0.25")
    (good / "entry.toml").write_text(text, "utf-8")
    assert read_submission(good).declaration.theory.shear == pytest.approx(0.2)


def test_line_ends_comments_a_mark_at_the_beginning_and_rates_change_nothing(good):
    before = read_submission(good)
    for path in good.rglob("*.csv"):
        text = "# by hand\r\n\r\n" + path.read_text("utf-8").replace("\n", "\r\n# more\r\n")
        if path.name == "m016_h1e-3.csv":
            text = text.replace("time,q", "time,q,q_dot").replace("\r\n# more", ",0.5\r\n# more")
            text = text.replace("q_dot,0.5", "q_dot")
        path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    after = read_submission(good)
    assert after.rows == before.rows
    assert np.array_equal(after.runs[1].q, before.runs[1].q)


def test_a_number_in_quotes_is_the_same_number_in_every_table(good):
    """Some languages write each cell in quotes, which is CSV too."""
    before = read_submission(good)
    for file in ("L.csv", "B.csv", "S1/m008_h1e-3.csv", "S1/m016_h1e-3.csv"):
        head, *rows = (good / file).read_text("utf-8").split()
        quoted = [",".join(f'"{cell}"' for cell in row.split(",")) for row in rows]
        (good / file).write_text("\n".join([head, *quoted]), "utf-8")
    after = read_submission(good)
    assert after.rows == before.rows
    for one, two in zip(before.runs, after.runs, strict=True):
        assert same(one.q, two.q)


def test_samples_beyond_the_end_are_left_out(tmp_path):
    longer = replace(whole(), runs=(history("S1", 8, 1e-3, 16.0),))
    assert read_submission(write_submission(longer, tmp_path)).runs[0].time[-1] == 15.0


def test_files_are_known_by_their_digests(good):
    found = digests(good, read_submission(good))
    assert set(found) == {
        "entry.toml", "L.csv", "B.csv", "runs.csv", "S1/m008_h1e-3.csv", "S1/m016_h1e-3.csv",
        "S1+h/m016_h5e-4.csv", "S2/m016_h2e-3.csv",
    }  # fmt: skip
    assert all(len(digest) == 64 for digest in found.values())


def test_two_runs_of_one_name_are_refused(tmp_path):
    twice = replace(whole(), runs=whole().runs[:1] * 2)
    with pytest.raises(ValueError, match=r"two runs would be S1/m008_h1e-3\.csv"):
        write_submission(twice, tmp_path)


def lines(*which):
    """Change the lines of a text: (number, change)."""

    def changed(text):
        rows = text.split("\n")
        for number, change in which:
            rows[number - 1] = change(rows[number - 1])
        return "\n".join(rows)

    return changed


def numbers(form):
    """Write the numbers of a history in another form."""

    def changed(text):
        head, *rows = text.strip().split("\n")
        return "\n".join([head, *(",".join(form % float(x) for x in r.split(",")) for r in rows)])

    return changed


S1 = "S1/m008_h1e-3.csv"
FAULTS = [
    (S1, lambda text: text.replace(",", ";"), ":1: the header is split by semicolons"),
    (S1, lambda text: text.replace("time,q", "time,Q"), ":1: unknown column 'Q'; did you mean 'q'"),
    (S1, lambda text: text.replace("time,q", "time [ms],q [m]"), "write it in [s]"),
    (S1, lambda text: text.replace("time,q\n", ""), ":1: there is no header"),
    (S1, lambda text: "time,q\n", ":1: has a header and no rows"),
    (S1, lambda text: "", "is empty"),
    (S1, lines((7, lambda row: row.split(",")[0])), ":7: has 1 cell, the header 2"),
    (S1, lines((7, lambda row: row + ","), (9, lambda row: row + ",")), "(and so in 1 more)"),
    (S1, lines((7, lambda row: "0.1,nan")), ":7: q: 'nan' is not finite"),
    (S1, lines((7, lambda row: "0.1,1.5D-01")), ":7: q: '1.5D-01' has Fortran's exponent D"),
    (S1, lines((7, lambda row: "0.1,0x1p3")), ":7: q: '0x1p3' is no number"),
    (S1, lines((7, lambda row: "0.1,1e999")), ":7: q: '1e999' is not finite"),
    (S1, lines((7, lambda row: "0.1,1e300")), ":7: q is 1e+300 m, of a beam of"),
    (S1, lines((7, lambda row: "0.02,0.5")), ":7: time must increase, but 0.02 s follows 0.08 s"),
    (S1, lambda text: "\n".join(text.split("\n")[:500]), ":500: ends at 9.96 s"),
    (S1, lambda text: "time,q\n" + "\n".join(text.split("\n")[30:]), ":2: begins at 0.58 s"),
    (
        S1,
        lambda text: "time,q\n" + "\n".join(text.split("\n")[1::5]),
        "samples are 100 ms apart (and so in 149 more), at most 20 ms",
    ),
    (
        S1,
        numbers("%.4g"),
        "column 'q' is written to 4 digits, at least 5 are needed and 8 lose nothing: write %.10g",
    ),
    ("S1+h/m016_h5e-4.csv", None, "there is no such file"),
    ("runs.csv", None, "runs.csv: there is no such file"),
    ("runs.csv", lines((2, lambda row: "# " + row)), f"{S1}: stands in no row of runs.csv"),
    ("runs.csv", lambda text: text.replace("S1/m008", "S5/m008"), ":2: 'S5' is no case"),
    ("runs.csv", lambda text: text.replace("S1/m008", "../m008"), ":2: '..' is no case"),
    ("runs.csv", lambda text: text.replace("m008_h1e-3.csv", "8.csv"), "write S1/m032_h1e-3.csv"),
    ("runs.csv", lambda text: text.replace("csv,8,", "csv,9,"), "name says 8 elements and a step"),
    ("runs.csv", lambda text: text.replace("csv,8,0.001", "csv,8,1"), "a step of 0.001, the row"),
    ("runs.csv", lambda text: text.replace("csv,8,", "csv,8.5,"), "must be a whole number"),
    ("runs.csv", lambda text: text.replace("8,0.001,,", "8,,1e-3,"), "a step of 0.001, the row"),
    (
        "runs.csv",
        lambda text: text.replace("8,0.001,,", "8,1e-3,1e-6,"),
        "a step of 0.001, the row does not",
    ),
    (
        "runs.csv",
        lambda text: text.replace("S1/m008_h1e-3.csv,8,0.001,", "S1/m008_t1e-6.csv,8,,1e-6"),
        "a step and a tolerance of S1",
    ),
    ("runs.csv", lambda text: text + text.split("\n")[1], "stand in line 2: keep one"),
    ("L.csv", lambda text: text.replace("8,0.0,", "8,5.0,"), ":2: speed 5 is not asked for: hand"),
    ("L.csv", lambda text: text.replace("2.90928123456", "2.909"), "written to 4 digits"),
    ("L.csv", lambda text: text.replace("2.9", "-2.9"), ":2: frequency must be positive"),
    ("L.csv", lambda text: text + text.split("\n")[1], ":4: the same row stands above"),
    ("B.csv", lambda text: text.replace("0.1,", "0.17,"), "amplitude 0.17 is not asked for"),
    ("P.csv", lambda text: text.replace(",twist", ",turn"), "there is no column twist"),
    ("P.csv", lambda text: text.replace("8,1.0", "8,5"), "speed 5 is not asked for"),
    ("P.csv", lambda text: re.sub(r"(3{4})\d+", r"\1", text), "write %.10g (and so in 1 more)"),
    ("F.csv", lambda text: text.replace(",7,", ",9,"), "number 9 is not asked for"),
    ("F.csv", lambda text: text.replace("61.803398875", "61.8"), "is written to 3"),
    ("W/m016_h1e-3.csv", lambda text: text.replace("lag", "q"), ":1: unknown column 'q'"),
    ("entry.toml", None, "there is no such file"),
    ("entry.toml", lambda text: text + "\norder =", "is not valid TOML"),
    ("entry.toml", lambda text: "kode = 'a'\n" + text, "unknown key 'kode'; did you mean"),
    ("entry.toml", lambda text: text.replace(f'"{VERSION}"', "1.0"), "benchmark must be text"),
    ("entry.toml", lambda text: text.replace(f'"{VERSION}"', '"0.9"'), f"judge knows {VERSION}"),
    ("entry.toml", lambda text: text.replace('"inextensible"', '"3d"'), "unknown tag '3d'"),
    ("entry.toml", lambda text: text.replace("share = 0.3205", "nu=1"), "[shear] takes k_s and nu"),
    (
        "entry.toml",
        lambda text: text.replace("Engesser", "Haringx"),
        "must be Reissner or Engesser",
    ),
    (
        "entry.toml",
        lambda text: text.replace("order = 4.0", "order = -4"),
        "must be from 0.1 to 20",
    ),
    ("entry.toml", lambda text: text.replace("order = 4.0", "order = 'a'"), "must be a number"),
]


@pytest.mark.parametrize(("file", "change", "said"), FAULTS, ids=[said for *_, said in FAULTS])
def test_faults_have_their_place_and_a_remedy(of_every_kind, file, change, said):
    path = of_every_kind / file
    if change is None:
        path.unlink()
    else:
        text = path.read_text("utf-8")
        assert change(text) != text
        path.write_text(change(text), "utf-8", newline="\n")
    found = faults_of(of_every_kind)
    assert any(said in fault for fault in found), found
    assert len(found) < 6


def test_all_faults_are_told_at_once(good):
    (good / "entry.toml").write_text("code = 3\n", "utf-8")
    (good / S1).unlink()
    (good / "L.csv").write_bytes(b"\xff\xfe\x00")
    (good / "S1+h" / "m016_h5e-4.csv").unlink()
    (good / "S1+h" / "m016_h5e-4.csv").mkdir()
    (good / "l.csv").write_text("", "utf-8")
    (good / "S11").mkdir()
    shutil.copy(good / "runs.csv", good / "S11" / "m001_h1.csv")
    found = "\n".join(faults_of(good))
    for said in (
        "entry.toml: code must be text", "entry.toml: there is no benchmark",
        f"{S1}: there is no such file", "L.csv: is not text", "S1+h/m016_h5e-4.csv: is a folder, ",
        "l.csv: is a table that nobody asked for; did you mean L.csv?",
        "S11: is the folder of no case; did you mean S1?",
    ):  # fmt: skip
        assert said in found


def rounding_of(folder, time, form, step="1e-3"):
    """What is read to be lost of sin t by the form of its times."""
    rows = (f"{form % t},{np.sin(t):.10g}" for t in time)
    (folder / S1).unlink()
    name = S1.replace("1e-3", step)
    (folder / name).write_text("\n".join(["time,q", *rows]), "utf-8")
    text = (folder / "runs.csv").read_text("utf-8")
    text = text.replace(f"{S1},8,0.001", f"{name},8,{float(step)}")
    (folder / "runs.csv").write_text(text, "utf-8")
    return read_submission(folder).runs[0].rounding


def test_even_times_may_be_short_and_uneven_ones_are_off(good):
    """0.02 k is exact in four digits; what a step control chose is off by half its last decimal."""
    time = np.linspace(0.0, 15.0, 901) ** 1.02 * 15.0 / 15.0**1.02
    assert rounding_of(good, 0.02 * np.arange(751.0), "%.4g") == 0.0
    assert rounding_of(good, time, "%.10g") == 0.0
    assert rounding_of(good, time, "%.7g") == pytest.approx(5e-6, rel=1e-3)  # of 1 m/s
    assert rounding_of(good, time, "%.5g") == pytest.approx(5e-4, rel=3e-2)  # so are gaps of 17 ms
    with pytest.raises(MalformedSubmissionError, match="column 'time' is written to 4 digits, at"):
        rounding_of(good, np.unique(np.round(time, 2)), "%.4g")


def test_whole_steps_are_exact_however_uneven(good):
    """14.992 is a whole number of milliseconds; of tenths of one it may be another number."""
    time = 1e-3 * np.unique(np.append(np.cumsum(np.tile([8, 12, 16], 420))[:1249], [0, 15000]))
    time = time[time <= 15.0]
    assert np.ptp(np.diff(time)) > 1e-3
    assert rounding_of(good, time, "%.5g") == 0.0
    assert rounding_of(good, time, "%.5g", step="1e-4") == pytest.approx(5e-4, rel=3e-2)


def test_few_digits_widen_the_floor_by_what_they_lose(good):
    before = read_submission(good)
    few = (good / S1).read_text("utf-8")
    (good / S1).write_text(numbers("%.6g")(few), "utf-8")
    table = (good / "L.csv").read_text("utf-8")
    (good / "L.csv").write_text(table.replace("2.90928123456", "2.9093"), "utf-8")
    after = read_submission(good)
    lost = np.abs(after.runs[0].q - before.runs[0].q).max()
    assert 0.9 * after.runs[0].rounding < lost <= after.runs[0].rounding < 1e-6
    off = abs(after.rows[0].values[0] - before.rows[0].values[0])
    assert off < after.rows[0].rounding[0] == pytest.approx(5e-5)
    assert (before.runs[0].rounding, before.rows[0].rounding) == (0.0, ())


def test_nothing_to_judge(tmp_path):
    (tmp_path / "entry.toml").write_text('benchmark = "1.0"\ncode = "a"\n', "utf-8")
    assert "there is nothing to judge" in faults_of(tmp_path)[0]
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        read_submission(tmp_path / "none")


CELLS = ["nan", "-inf", "1e999", "1e308", "-1e308", "", "0", "-1", "1,2", '"', '""', "1_0", "1;2",
         "1,5", "٣", "0x10", "1+2j", "True", "S1", "#", "\t", "9" * 5000, "1e", "..", "\0", "a\rb",
         "[[", "= =", "5e-324", "\u2028", "{}", "m1_h1.csv", "1.0D+00"]  # fmt: skip


@st.composite
def mutation(draw):
    """A file and a change of its bytes: bytes to bytes, None to remove, "folder" to replace it."""
    file = draw(st.sampled_from(FILES))
    kind = draw(st.sampled_from(["cut", "cell", "line", "bytes", "swap", "gone", "folder", "all"]))
    place, other = draw(st.integers(0, 10**6)), draw(st.integers(0, 10**6))
    cell, junk = draw(st.sampled_from(CELLS)), draw(st.binary(max_size=40))
    mark = draw(st.sampled_from([b";", b"\t", b" ", b"\r", b"", b"\xef\xbb\xbf"]))

    def change(raw):
        rows = raw.split(b"\n")
        at = place % len(rows)
        if kind == "cell":
            cells = rows[at].split(b",")
            cells[other % len(cells)] = cell.encode("utf-8", "surrogatepass")
            rows[at] = b",".join(cells)
        elif kind == "line":
            rows[at : at + other % 3] = [rows[other % len(rows)]] * (1 + other % 2)
        elif kind == "swap":
            return raw.replace(b",", mark) if place % 2 else mark + raw
        else:
            where = place % (len(raw) + 1)
            return raw[:where] + (b"" if kind == "cut" else junk + raw[where + other % 9 :])
        return b"\n".join(rows)

    return file, {"gone": None, "folder": "folder", "all": lambda raw: junk}.get(kind, change)


@settings(
    deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)  # fmt: skip
@given(mutations=st.lists(mutation(), min_size=1, max_size=4))
def test_malformed_submissions_give_sentences(of_every_kind, tmp_path_factory, mutations):
    """Never a traceback: it reads, or each fault names a file and says what is wrong."""
    folder = tmp_path_factory.mktemp("mutated") / "copy"
    shutil.copytree(of_every_kind, folder)
    for file, change in mutations:
        path = folder / file
        if not path.is_file():
            continue
        raw = path.read_bytes()
        path.unlink()
        if change == "folder":
            path.mkdir()
        elif change is not None:
            path.write_bytes(change(raw))
    try:
        read_submission(folder)
        faults = None
    except MalformedSubmissionError as error:
        faults = error.faults
    shutil.rmtree(folder)
    assert faults != ()
    for fault in faults or ():
        assert len(fault.said) > 15
        assert str(fault).isprintable()
        assert "Error" not in str(fault)


def test_a_submission_is_written_beside_other_files_and_not_over_another(submitted, tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "notes.txt").write_text("mine", "utf-8")
    write_submission(submitted(), folder)
    assert {path.name for path in folder.iterdir()} == {
        "notes.txt", "entry.toml", "L.csv", "runs.csv", "S1"
    }  # fmt: skip
    with pytest.raises(FileExistsError, match=r"holds entry.toml already: choose another folder"):
        write_submission(submitted(), folder)
