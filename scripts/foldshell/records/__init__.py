"""The typed record of every result file: each field with unit, meaning and words in one place."""
