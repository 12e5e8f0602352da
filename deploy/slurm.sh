#!/bin/bash
# A batch as an array of jobs, a core each: sbatch deploy/slurm.sh /data/scans /data/puzzles --pieces 80
# Submitted again, it does what is missing. No Dask is needed.
#SBATCH --job-name=meshjig
#SBATCH --array=1-32
#SBATCH --cpus-per-task=1
#SBATCH --mem=5G
#SBATCH --time=12:00:00
#SBATCH --signal=B:TERM@30
#SBATCH --requeue
set -euo pipefail

scans=$1 puzzles=$2
shift 2
exec meshjig batch "$scans" -o "$puzzles" --memory 4 \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" "$@"
