"""What a command costs before it does anything: CPU time of a process, whatever else runs."""

import resource
import subprocess
import sys

import pytest

pytestmark = pytest.mark.benchmarks


def cpu_time(line):
    """Least user and system time [s] of five processes; the first may have to compile."""
    taken = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [sys.executable, "-m", "rotbeam_exu.cli", *line.split()]
        subprocess.run(command, capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        taken.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(taken)


@pytest.mark.parametrize(
    ("line", "most"),
    [
        ("--help", 0.35),
        ("run --help", 0.6),
        ("ramp --help", 0.6),
        ("judge --help", 0.6),
        ("figure --help", 0.6),
        ("backbone --help", 0.6),
        ("backbone --omega 6", 0.8),
    ],
)
def test_a_command_starts_quickly(line, most):
    assert cpu_time(line) <= most
