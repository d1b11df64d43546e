"""The final state of a design: fields, lines, history, mesh error, the row of the summary."""
