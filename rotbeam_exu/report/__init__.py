"""What is shown of a judgement: one HTML page, a JSON document, a row of LaTeX, a badge."""
