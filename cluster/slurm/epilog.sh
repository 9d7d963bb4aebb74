#!/bin/sh
# A sample for slurm.conf: Epilog=/etc/slurm/epilog.sh. Slurm runs it as root on each machine of a job that has ended.
# Once the user has no process left on the machine, it removes what killed processes of Open MPI and MARS left there:
# folders of sessions and segments of shared memory. It always ends with 0, because Slurm drains a machine whose epilog
# fails.
uid=$SLURM_JOB_UID
pgrep -u "$uid" >/dev/null
[ $? = 1 ] || exit 0 # 0: some are there; 2 and more: pgrep cannot say
find /dev/shm /tmp -maxdepth 1 -uid "$uid" \
  \( -name 'vader_segment.*' -o -name 'ompi.*' -o -name 'mars.*.??????' \) -exec rm -rf -- {} +
exit 0
