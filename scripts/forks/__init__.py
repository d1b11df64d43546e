"""Scripts run in forks of one process that has imported their libraries already.

`client.ForkServer` starts that process (`server.py`) and asks it to run a script. Python, numpy and
the rest of the imports take some 0.25 s of a processor, and a study has a thousand jobs.
"""
