#!/bin/bash
#SBATCH --job-name=blocks-workers
#SBATCH --cpus-per-task=1
#SBATCH --output=workers-%a.log
# Workers for scripts/study.sh on a cluster, as an array of Slurm jobs that meet by a scheduler file:
#	sbatch --array=0-31 --time=24:00:00 scripts/workers.sh FOLDER
#	scripts/study.sh ensemble tension seeds=500 scheduler=FOLDER/scheduler.json tls=FOLDER
# FOLDER must be seen by all nodes, and so must this checkout, built. Job 0 also runs the scheduler, so with it all end; when another job ends only the run
# that it was doing is done again. Whoever reaches a scheduler can run code as you: connections are encrypted, and only those with the certificate in FOLDER,
# which is made once and readable for you alone, are accepted. Without Slurm a single call serves as well; BLOCKS_HOST is the address to listen on.
set -euo pipefail
[ $# = 1 ] || { echo "usage: sbatch --array=0-N scripts/workers.sh FOLDER" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
umask 077
number="${SLURM_ARRAY_TASK_ID:-0}"
host=()
[ -z "${BLOCKS_HOST:-}" ] || host=(--host "$BLOCKS_HOST")
tls=(--tls-ca-file certificate.pem --tls-cert certificate.pem --tls-key key.pem)

if [ "$number" = 0 ]; then
	[ -f certificate.pem ] || openssl req -x509 -newkey rsa:3072 -nodes -days 3650 -subj /CN=blocks -keyout key.pem -out certificate.pem 2> /dev/null
	rm -f scheduler.json # of an earlier array
	/usr/bin/python3 -m distributed.cli.dask_scheduler --protocol tls --port 0 "${host[@]}" "${tls[@]}" --scheduler-file scheduler.json \
		--dashboard-address 127.0.0.1:0 --no-dashboard &
	scheduler=$!
	trap 'kill $scheduler 2>/dev/null || true' EXIT
fi
for _ in $(seq 600); do
	[ ! -s scheduler.json ] || break
	sleep 1
done
[ -s scheduler.json ] || { echo "no scheduler has appeared in $PWD/scheduler.json within 10 minutes" >&2; exit 1; }
/usr/bin/python3 -m distributed.cli.dask_worker --scheduler-file scheduler.json --protocol tls "${host[@]}" "${tls[@]}" --nthreads 1 --memory-limit 0 \
	--no-dashboard --dashboard-address 127.0.0.1:0 --death-timeout 300 &
worker=$!
trap 'kill $worker ${scheduler:-} 2>/dev/null || true' EXIT
trap 'exit 143' TERM INT
wait $worker
