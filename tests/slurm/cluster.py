"""Slurm's controller and node daemon on this machine alone, for a test: no accounting, no authentication, ports on loopback."""
import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

TOOLS = ("slurmctld", "slurmd", "slurmstepd", "sbatch", "sinfo", "squeue")

CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
SlurmctldPort={port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
MailProg=/bin/true
ReturnToService=2
MinJobAge=60
{more}
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """What there must be; Debian has it in slurmctld, slurmd and slurm-client."""
    if os.geteuid() != 0:
        return "Slurm's daemons need root here"
    lacking = [tool for tool in TOOLS if not shutil.which(tool)]
    return f"not installed: {', '.join(lacking)}" if lacking else ""


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Cluster:
    """With both daemons at work inside of a `with`."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.daemons = []
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        text = CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.folder, port=free_port(), node_port=free_port(),
                                    cores=os.cpu_count(), more=os.environ.get("ROCKFOLD_SLURM_CONF", ""))
        (self.folder / "slurm.conf").write_text(text, encoding="utf-8")
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))

    def __enter__(self):
        for command in (["slurmctld", "-D"], ["slurmd", "-D", "-d", shutil.which("slurmstepd")]):
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if self.run("sinfo", "-h", "-o", "%T").stdout.strip() == "idle":
                return self
            time.sleep(0.5)
        logs = "\n".join(path.read_text(encoding="utf-8", errors="replace")[-3000:] for path in self.folder.glob("*.log"))
        self.__exit__()
        raise AssertionError("Slurm did not start:\n" + logs)

    def __exit__(self, *_):
        for daemon in self.daemons:
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(timeout=30)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def run(self, *command):
        return subprocess.run([str(word) for word in command], env=self.environment, capture_output=True, text=True, timeout=60, check=False)

    def wait_until_done(self, seconds):
        end = time.monotonic() + seconds
        while self.run("squeue", "-h").stdout.strip():
            assert time.monotonic() < end, self.run("squeue").stdout
            time.sleep(0.5)
