"""Excel workbooks: thicknesses written and read back, history, design, summary."""
