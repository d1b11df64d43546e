"""The paper's claims judged by numbers with their uncertainty, and under other settings."""
