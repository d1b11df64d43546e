"""timings.csv: what the jobs of each rule took."""

from dataclasses import dataclass

from foldshell.records.entry import COUNT, entry


@dataclass(frozen=True, kw_only=True)
class TimingRow:
    """The jobs of one rule, or of all."""

    rule: str = entry("name of the rule, `all` for every job")
    jobs: int = entry("jobs", COUNT)
    wall_s: float = entry("wall time of all its jobs", "s")
    wall_mean_s: float = entry("mean wall time of a job", "s")
    wall_max_s: float = entry("longest wall time of a job", "s")
    rss_max_mb: float | None = entry(
        "largest memory of a job; empty where it was too short to be measured", "MB", default=None
    )
    after_loops_s: float = entry("wall time of these jobs after the last loop has ended", "s")
    alone_s: float = entry("of that, the time in which nothing else ran: what one core does", "s")
