"""The judge is handed the folders of strangers: no pipe, link or flood of faults gets through."""

import os
import signal

import pytest

from rotbeam_exu.verification.submission import Declaration, Row, Submission
from rotbeam_exu.verification.submission_files import (
    digests,
    read_submission,
    write_submission,
)
from rotbeam_exu.verification.submission_files.faults import LARGEST, MalformedSubmissionError
from rotbeam_exu.verification.submission_files.tables import number

SECRET = "example.org,password,hunter2\n"
ENTRY = 'benchmark = "1.0"\ncode = "mine"\n'
TABLE = "elements,speed,frequency\n8,6.0,3.731123456\n"
ROW = "S1/m008_h1e-3.csv,8,1e-3\n"


@pytest.fixture(autouse=True)
def in_time():
    """Nothing here takes more than a few seconds; a pipe would be waited for without end."""

    def late(*_):
        pytest.fail("the judge hangs")

    former = signal.signal(signal.SIGALRM, late)
    signal.alarm(60)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, former)


@pytest.fixture
def mine(tmp_path):
    """A submission of one frequency, beside which there is a file that is none of its business."""
    (tmp_path / "secret").write_text(SECRET, "utf-8")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "m008_h1e-3.csv").write_text(SECRET, "utf-8")
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "entry.toml").write_text(ENTRY, "utf-8")
    (folder / "L.csv").write_text(TABLE, "utf-8")
    return folder


def faults_of(folder):
    with pytest.raises(MalformedSubmissionError) as caught:
        read_submission(folder)
    return list(map(str, caught.value.faults))


def put(folder, file, kind):
    """Put something in the place of a file that is no file of the folder."""
    path = folder / file
    path.unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "link":
        path.symlink_to(folder.parent / "secret")
    else:
        path.symlink_to("../../mine/../secret" if "/" in file else "../secret")


@pytest.mark.parametrize("kind", ["pipe", "device", "link", "relative link"])
def test_only_regular_files_below_the_folder_are_read(mine, kind):
    """Neither waited for nor read: a pipe never ends, and a link shows cells of other files."""
    (mine / "S1").mkdir()
    (mine / "runs.csv").write_text("file,elements,step\n" + ROW, "utf-8")
    put(mine, "S1/m008_h1e-3.csv", kind)
    said = {"pipe": "a pipe or a device: put"}.get(kind, "is a link that leads out of the")
    names = ["L.csv", "S1/m008_h1e-3.csv"]
    put(mine, "L.csv", kind)
    found = faults_of(mine)
    assert [fault.partition(": ")[0] for fault in found] == names
    assert all(said in fault for fault in found)
    for file in ("entry.toml", "runs.csv"):
        put(mine, file, kind)
        names.append(file)
    found = faults_of(mine)
    assert {fault.partition(": ")[0] for fault in found} == set(names)
    assert not any(word in fault for fault in found for word in SECRET.strip().split(","))


def test_a_folder_that_leads_out_is_not_looked_into(mine, tmp_path):
    """Not even for the names of its files."""
    (mine / "S1").symlink_to(tmp_path / "outside")
    (mine / "data").symlink_to(tmp_path / "outside")  # belongs to no case, and is left alone
    said = "S1: is a link that leads out of the folder: put what it names in its place"
    assert faults_of(mine) == [said]
    (mine / "runs.csv").write_text("file,elements,step\n" + ROW, "utf-8")
    found = faults_of(mine)
    assert found[0].startswith("S1/m008_h1e-3.csv: is a link that leads out")
    assert not any(word in fault for fault in found for word in SECRET.strip().split(","))


def test_a_link_within_the_folder_is_a_file_of_it(mine, tmp_path):
    before = read_submission(mine)
    (mine / "tables").mkdir()
    (mine / "L.csv").rename(mine / "tables" / "L.txt")
    (mine / "L.csv").symlink_to(mine / "tables" / "L.txt")
    (tmp_path / "link").symlink_to(mine)  # nor is it held against the folder that it is one
    found = read_submission(tmp_path / "link")
    assert found.rows == before.rows
    assert set(digests(mine, found)) == {"entry.toml", "L.csv"}


def test_too_much_is_not_read(mine):
    with (mine / "L.csv").open("wb") as file:
        file.truncate(10**12)
    assert faults_of(mine) == [
        f"L.csv: has more than {LARGEST:,} bytes: hand in what the kit asks for, and sample less "
        "often"
    ]


FLOODS = {
    "rows": ("L.csv", TABLE + "x,y,z\n" * 2_000, r":3: elements: 'x' .* 1,999 more\)"),
    "different rows": (
        "L.csv",
        TABLE + "".join(f"8,{k}.5,'{k:x}\"\n" for k in range(1_000)),
        r":3: speed 0\.5 is not asked for: .*999 more\)",
    ),
    "short rows": ("L.csv", TABLE + "x\n" * 2_000, r":3: has 1 cell, .* 1,999 more\)"),
    "no rows of CSV": ("L.csv", TABLE + 'a"b"c,"\n' * 2_000, r"no row of CSV.* 1,999 more\)"),
    "columns": ("L.csv", ",".join(f"c{k}" for k in range(10**6)), r":1: has 7,888,889 letters"),
    "alike columns": ("L.csv", TABLE.replace("\n", ",x" * 4000 + "\n"), r"column 'x' occurs twice"),
    "names": ("entry.toml", ENTRY.replace("mine", "x" * 2_000_000), r"code has 2,000,000 letters"),
    "authors": (
        "entry.toml",
        ENTRY + f"authors = {['a'] * 10**5}",
        r"authors must be a short list",
    ),
    "long key": ("entry.toml", "k" * 2_000_000 + " = 1", r"unknown key 'kkk"),
    "file names": (
        "runs.csv",
        "file,elements,step\n" + f"S1/m1_h{'1' * 9000}.csv,1,1\n" * 99,
        r"98",
    ),
    "runs": ("runs.csv", "file,elements,step\n" + "x,y,z\n" * 2_000, r"'x' is no case.*1,999"),
    "keys": ("entry.toml", "".join(f"k{k}=1\n" for k in range(300)), r"'k0'.* 299 more"),
    "nesting": ("entry.toml", "a = " + "[" * 30_000, r"is not valid TOML: "),
}


@pytest.mark.parametrize(("file", "text", "said"), FLOODS.values(), ids=FLOODS)
def test_floods_of_faults_are_a_few_sentences_in_seconds(mine, file, text, said):
    (mine / file).write_text(text, "utf-8")
    with pytest.raises(MalformedSubmissionError, match=said) as caught:
        read_submission(mine)
    assert len(caught.value.faults) <= 12
    assert len(str(caught.value)) < 3000


@pytest.mark.parametrize(
    "cell", ["1" * 200_000 + "x", "." + "1" * 200_000 + "e", "1" * 10**5 + "d"]
)
def test_a_number_without_end_is_no_number_at_once(cell):
    """Each digit was tried as the last one before the point, and after it: 2e10 ways."""
    with pytest.raises(ValueError, match="is no number"):
        number("q", cell)


@pytest.mark.parametrize("code", ["", " ", "   ", "\\n", "\\t \\u3000"])
def test_a_code_has_a_name(mine, code):
    (mine / "entry.toml").write_text(f'benchmark = "1.0"\ncode = "{code}"\n', "utf-8")
    (fault,) = faults_of(mine)
    assert fault == 'entry.toml: there is no code: write code = "name of your code"'


def test_a_fault_in_several_files_is_told_of_each(tmp_path):
    row = Row(elements=8, speed=6.0, values=(3.731123456,))
    submission = Submission(declaration=Declaration(code="a"), rows=(row,))
    folder = write_submission(submission, tmp_path / "mine")
    names = [f"S1/m{k:03d}_h1e-3.csv" for k in (8, 16, 32)]
    rows = (f"{name},{int(name[4:7])},1e-3" for name in names)
    (folder / "runs.csv").write_text("\n".join(["file,elements,step", *rows]), "utf-8")
    assert faults_of(folder) == [f"{name}: there is no such file" for name in names]
