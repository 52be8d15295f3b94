"""The benchmark: its cases, references and judge, the kit, and our own elements as entries.

A submission flows from the top down:

1. `case`, `space_cases`, `cases`: a task, and the list of all. A case answers for its kind.
2. `submission`: a code's declaration, the rows of its tables and its runs, from either door:
   `submission_files` reads and writes the folder of an author (`kit` is what the author has),
   `verify` calls a code that runs here, as `entries` wraps our own elements, and has it judged.
3. `shipped`, `references`: the exact answer of a case, from the package's file or computed.
4. `error_models`, `convergence`: the limit of all runs of one quantity, with its uncertainty.
5. `outcomes`, `history`: what the limit says of a quantity; the quantities of a history.
6. `judgement`: all cases of a submission by stated thresholds.
7. `mistakes`: what explains a large error.

`assessment` stands apart: a single run of our own against the exact beam.
"""
