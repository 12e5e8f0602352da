"""A batch on Slurm by dask-jobqueue: jobs that live for a while, and hand over what they have not done.

pip install 'meshjig[batch]' dask-jobqueue; then python deploy/dask_jobqueue.py /data/scans /data/puzzles
"""

import sys

import dask
from dask_jobqueue import SLURMCluster
from distributed import Client

import meshjig

dask.config.set(
    {"distributed.scheduler.allowed-failures": 100, "distributed.scheduler.worker-ttl": "5 minutes"}
)
NO_LIMITS = [  # a scan has a limit of its own; Dask's would end those that are innocent
    f"export DASK_DISTRIBUTED__WORKER__MEMORY__{name}=False"
    for name in ("TARGET", "SPILL", "PAUSE", "TERMINATE")
]

if __name__ == "__main__":
    cluster = SLURMCluster(
        cores=1,
        processes=1,
        memory="5GB",
        walltime="04:00:00",
        job_script_prologue=NO_LIMITS,
        worker_extra_args=["--memory-limit", "0", "--lifetime", "210m", "--lifetime-stagger", "15m"],
    )
    cluster.scale(jobs=32)  # a fixed number: adapt() would take workers away that are at work
    with Client(cluster) as client:
        for record in meshjig.batch([sys.argv[1]], sys.argv[2], client=client, pieces=80, memory=4):
            print(record.name, record.outcome, record.sentence)
