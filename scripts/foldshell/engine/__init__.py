"""What knows how the workflow runs: jobs, imports, records, progress, timings, forks.

`fork_client.ForkServer` starts a process (`fork_server.py`) that has imported the libraries of the
jobs already and runs scripts in forks of itself: Python, numpy and the rest of the imports take
some 0.25 s of a processor, and a study has a thousand jobs.
"""
