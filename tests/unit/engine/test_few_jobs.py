"""A scheduler looks at the jobs of the highest rank."""

from foldshell.engine.few_jobs import look_at_few


class Scheduler:
    """With jobs that could run, and others that are left."""

    def __init__(self, jobs):
        self.jobs = jobs

    @property
    def ready(self):
        return list(self.jobs)

    @property
    def left(self):
        return [*self.jobs, "later"]


def test_few_of_the_highest_rank_or_all_where_they_are_few():
    many, three, other = Scheduler(range(100)), Scheduler([5, 1, 3]), Scheduler(range(100))
    for scheduler in (many, three):
        look_at_few(scheduler, "ready", "left", lambda job: job % 50, 4)
    assert sorted(many.ready) == [48, 49, 98, 99] and many.left == []
    assert three.ready == [5, 1, 3]
    assert len(other.ready) == 100 and other.left[-1] == "later"
