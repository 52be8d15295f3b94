"""`rotbeam report`: a blade on one page, and its numbers as CSV."""

from __future__ import annotations

from .job import Results, require_writable, write_text
from .output import counter, print_written
from .request import Request, uses


@uses("omega", "tolerance", "theory")
def report(request: Request, *, results: Results = Results()) -> None:
    """Write a blade's report: a page to print, and CSV tables.

    Sections and mass, modes with names and shapes, Campbell diagram, steady state over the speed,
    root loads over a turn under the weight. What has no answer is stated there.

    Examples
    --------
    $ rotbeam report --omega 2 -o mine
    $ rotbeam report --config blade.toml -o mine
    """
    from ..report.blade import blade_page, blade_parts

    name = request.config.stem if request.config else "paper-beam"
    page = results.out / f"report-{name}.html"
    require_writable(page, force=results.force)
    omega = request.omega
    parts, count = [], 5
    with counter("parts") as done:
        for part in blade_parts(request.blade, omega, request.theory, request.tolerance):
            parts.append(part)
            done(len(parts), count)
    files, written = {}, [page]
    for kind, data in (one for part in parts for one in part.data.items()):
        made = results.tables(f"{name}-{kind}", data)
        files[kind] = ", ".join(one.name for one in made if one.suffix == ".csv")
        written += made
    write_text(blade_page(parts, f"Blade {name}", omega, request.theory, files), page)
    print_written(written)
