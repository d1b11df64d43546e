"""The configuration and the table of designs, checked once and typed; what each stage is told."""
