"""A Slurm of one node, this machine, without accounting: `one_node_slurm.py start|stop FOLDER`.

From the Debian packages slurmctld, slurmd, slurm-client and munge. All its files are in the folder;
/etc/slurm/slurm.conf is a link to it while it runs: jobs that Snakemake starts lose SLURM_CONF.
"""

import contextlib
import getpass
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

LINK = Path("/etc/slurm/slurm.conf")
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel")
CONFIG = """\
ClusterName=onenode
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
AccountingStorageType=accounting_storage/none
MinJobAge=600
KillWait=2
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE OverTimeLimit=0 State=UP
"""


def why_not() -> str:
    """Return why a Slurm cannot be started on this machine, empty where it can."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    missing = [program for program in PROGRAMS if not shutil.which(program, path=path)]
    if missing:
        return f"no {', '.join(missing)}: apt-get install slurmctld slurmd slurm-client munge"
    if os.geteuid():
        return "slurmd runs jobs as root only"
    return f"{LINK} is there: this machine has a Slurm already" if LINK.exists() else ""


def start(folder: Path, cores: int = 2, memory_mb: int = 8000) -> None:
    """Start the three daemons in a folder.

    Raises `RuntimeError` where the node is not idle within 30 s.
    """
    folder = folder.resolve()
    for name in ("state", "spool"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    folder.chmod(0o755)
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o600)
    host, user = socket.gethostname(), getpass.getuser()
    port, node_port = _free_ports()
    config = folder / "slurm.conf"
    fields = {"host": host, "user": user, "cores": cores, "memory": memory_mb}
    config.write_text(CONFIG.format(folder=folder, port=port, node_port=node_port, **fields))
    LINK.parent.mkdir(parents=True, exist_ok=True)
    LINK.unlink(missing_ok=True)
    LINK.symlink_to(config)
    own = os.environ | {"PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
    names = ("key-file=munge.key", "socket=munge.socket", "pid-file=munged.pid")
    names += ("log-file=munged.log", "seed-file=munged.seed")
    munge = [f"--{name.replace('=', f'={folder}/')}" for name in names]
    subprocess.run(["munged", "--force", *munge], env=own, check=True)
    subprocess.run(["slurmctld", "-f", str(config)], env=own, check=True)
    subprocess.run(["slurmd", "-f", str(config)], env=own, check=True)
    for _ in range(60):
        state = subprocess.run(["sinfo", "-h", "-o", "%T"], env=own, capture_output=True, text=True)
        if state.stdout.strip() == "idle":
            return
        time.sleep(0.5)
    stop(folder)
    raise RuntimeError(f"the node is {state.stdout.strip() or state.stderr.strip()}")


def stop(folder: Path) -> None:
    """End jobs and daemons of a folder."""
    if LINK.resolve() == (folder / "slurm.conf").resolve():
        subprocess.run(["scancel", "--user", getpass.getuser()], capture_output=True)
        LINK.unlink()
    for name in ("slurmd", "slurmctld", "munged"):
        with contextlib.suppress(OSError, ValueError):
            process = int((folder / f"{name}.pid").read_text())
            os.kill(process, signal.SIGTERM)
            for _ in range(50):
                os.kill(process, 0)
                time.sleep(0.1)


@contextlib.contextmanager
def one_node(folder: Path, cores: int = 2, memory_mb: int = 8000) -> Iterator[None]:
    """Run a Slurm that ends with the block."""
    start(folder, cores, memory_mb)
    try:
        yield
    finally:
        stop(folder)


def count_submissions(folder: Path) -> int:
    """Return how many jobs the Slurm of a folder was asked for."""
    log = (folder / "slurmctld.log").read_text()
    return log.count("_slurm_rpc_submit_batch_job: JobId=")


def _free_ports() -> list[int]:
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(2)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("start", "stop"):
        sys.exit(__doc__)
    if sys.argv[1] == "stop":
        stop(Path(sys.argv[2]))
    elif reason := why_not():
        sys.exit(reason)
    else:
        start(Path(sys.argv[2]))
