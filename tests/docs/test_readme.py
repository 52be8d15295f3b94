"""What the README claims."""

import re
from pathlib import Path

import pytest

from analytic import periodic_orbits, reduced_model

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_lambda_table_is_computed(beam):
    """Every entry is what the code gives, to the digits shown."""
    header = re.search(r"^\| ω \[rad/s\] \|(.*)\|$", README, re.MULTILINE).group(1)
    names = [name.strip() for name in header.split("|")]
    rows = re.findall(r"^\| ([2468]) \|(.*)\|$", README, re.MULTILINE)
    assert [row[0] for row in rows] == ["2", "4", "6", "8"]
    for omega, cells in rows:
        for name, cell in zip(names, cells.split("|"), strict=True):
            found = (
                periodic_orbits(beam, float(omega), [0.05]).lambda_omega
                if name == "exact"
                else reduced_model(beam, float(omega), name).lambda_omega
            )
            assert f"{found:.5f}" == cell.strip(), (omega, name)


def test_the_python_block_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for block in re.findall(r"```python\n(.*?)```", README, re.DOTALL):
        exec(compile(block, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "frequency 0.99789" in printed
    assert (tmp_path / "run.nc").exists()


def test_the_toml_block_is_the_reference_beam(beam, tmp_path):
    from rotbeam_exu.config import load_beam

    block = re.search(r"```toml\n(.*?)```", README, re.DOTALL).group(1)
    (tmp_path / "beam.toml").write_text(block, encoding="utf-8")
    assert load_beam(tmp_path / "beam.toml") == beam


@pytest.mark.parametrize("link", re.findall(r"\]\(((?!http)[^)#]+)\)", README))
def test_links_resolve(link):
    assert (Path(__file__).parents[2] / link).exists()
