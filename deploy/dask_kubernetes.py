"""A batch on Kubernetes by dask-kubernetes, from a bucket to a bucket.

pip install 'meshjig[batch,s3]' dask-kubernetes; the operator of dask-kubernetes has to run in the cluster.
"""

from dask_kubernetes.operator import KubeCluster, make_cluster_spec
from distributed import Client

import meshjig

SETTINGS = {
    "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "100",
    "DASK_DISTRIBUTED__WORKER__MEMORY__TARGET": "False",  # a scan has a limit of its own
    "DASK_DISTRIBUTED__WORKER__MEMORY__SPILL": "False",
    "DASK_DISTRIBUTED__WORKER__MEMORY__PAUSE": "False",
    "DASK_DISTRIBUTED__WORKER__MEMORY__TERMINATE": "False",
}

if __name__ == "__main__":
    spec = make_cluster_spec(
        name="meshjig",
        image="registry.example.org/meshjig:0.1.0",
        n_workers=32,
        env=SETTINGS,
        worker_command=["dask", "worker", "--nthreads", "1", "--memory-limit", "0"],
        resources={"requests": {"cpu": "1", "memory": "5Gi"}, "limits": {"memory": "5Gi"}},
    )
    for group in (spec["spec"]["scheduler"], spec["spec"]["worker"]):
        for container in group["spec"]["containers"]:
            container["envFrom"] = [{"secretRef": {"name": "s3-keys"}}]
    with KubeCluster(custom_cluster_spec=spec) as cluster, Client(cluster) as client:
        for record in meshjig.batch(
            ["s3://scans/"], "s3://puzzles/first", client=client, pieces=80, memory=4
        ):
            print(record.name, record.outcome, record.sentence)
