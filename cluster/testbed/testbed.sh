#!/usr/bin/env bash
# A virtual Beowulf on one machine: head n0 and hosts n1 to n4 of two processors each, with sshd and Slurm.
# Every host has its own name, network, processes, /tmp, /run and /dev/shm. All hosts share the rest of the file
# system, as if by NFS, and this file's checkout even if it is below /tmp. All hosts run on this machine's
# processors, so the testbed shows behaviour, not speed. Slurm's jobs in the partition urgent preempt those in main.
#
#   testbed.sh up                   start it (ends a running one first)
#   testbed.sh exec HOST COMMAND    run a command on a host, in this folder
#   testbed.sh cut HOST             pull a host's network cable
#   testbed.sh join HOST            plug it in again
#   testbed.sh firewall HOST        drop all that a host sends by TCP, but ssh
#   testbed.sh lift HOST            lift its firewall
#   testbed.sh slow HOST RATE       limit the rate at which a host receives, e.g. to 10mbit; full: no limit
#   testbed.sh kill HOST            cut a host's power: everything on it is gone until the next up
#   testbed.sh down                 end it and remove everything
#
# Needs root and, on Debian: slurmctld slurmd slurm-client munge openssh-server openmpi-bin iproute2.
# To run several at a time, give each a name: TESTBED=name.
set -euo pipefail

name=${TESTBED:-mars}
# Not in /tmp, because every host has its own. Programs refuse keys in folders that others can write to.
dir=/var/tmp/testbed-$name
checkout=$(cd "$(dirname "$0")/../.." && pwd -P)
hosts="n0 n1 n2 n3 n4"
workers="n1 n2 n3 n4"
export SLURM_CONF=$dir/slurm.conf

give_up() { echo "testbed: $*" >&2; exit 1; }

check_needs() {
  [ "$(id -u)" = 0 ] || give_up "needs root: it makes namespaces"
  local command missing=""
  for command in slurmctld slurmd srun munged /usr/sbin/sshd ssh-keygen mpirun ip tc nsenter unshare pgrep; do
    command -v "$command" >/dev/null || missing="$missing $command"
  done
  [ -z "$missing" ] || give_up "not installed:$missing (Debian: apt-get install slurmctld slurmd slurm-client" \
    "munge openssh-server openmpi-bin iproute2 procps)"
}

# A host is one process with its own namespaces; everything on the host ends with that process. Its last word names
# the testbed: after this machine was switched off, a file may hold the number of another process.
is_host() { grep -qszxF "testbed-$name" "/proc/$1/cmdline"; }
pid_of() {
  local pid
  pid=$(cat "$dir/pid/$1" 2>/dev/null || echo none)
  is_host "$pid" || give_up "no host $1 (testbed.sh up starts all)"
  echo "$pid"
}

# Runs a command on host $1. The switch is only a network: at_switch.
on() {
  local pid
  pid=$(pid_of "$1")
  shift
  nsenter --target "$pid" --net --uts --mount --ipc --pid --wd="$PWD" \
    env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 HOME=/root "$@"
}
at_switch() { nsenter --target "$(pid_of switch)" --net "$@"; }
start_daemon() {
  local host=$1
  shift
  on "$host" setsid "$@" >"$dir/log/$host.$(basename "$1")" 2>&1 </dev/null &
}

# pgrep finds the new process's number on the machine; inside its namespace the number may differ.
start_namespaces() {
  local host=$1
  shift
  setsid unshare --net "$@" --fork --kill-child sh -c 'sleep infinity & wait' "testbed-$name" </dev/null >/dev/null \
    2>&1 &
  local outer=$!
  until pgrep -P "$outer" >"$dir/pid/$host"; do
    kill -0 "$outer" 2>/dev/null || give_up "cannot make namespaces for $host; see: unshare --net $*"
    sleep 0.05
  done
}

# Keeps the checkout mounted elsewhere while the host's own folders, which may cover it, are mounted.
own_folders() {
  local host=$1 folder
  on "$host" mount --bind "$checkout" "$dir/checkout"
  for folder in /tmp /dev/shm /run; do on "$host" mount -t tmpfs tmpfs "$folder"; done
  on "$host" mkdir -p "$checkout"
  on "$host" mount --move "$dir/checkout" "$checkout"
}

start_host() {
  local host=$1 number=${1#n}
  start_namespaces "$host" --uts --mount --ipc --pid --mount-proc
  at_switch ip link add "$host" type veth peer name eth0 netns "$(pid_of "$host")"
  at_switch ip link set "$host" master bridge up
  own_folders "$host"
  on "$host" sh -euc "
    hostname $host
    ip address add 10.77.0.1$number/24 dev eth0; ip link set eth0 up; ip link set lo up
    mount --bind $dir/hosts /etc/hosts; mount --bind $dir/ssh /root/.ssh
    mkdir -p /run/sshd /run/munge"
}

# All that a host sends by TCP goes where nobody listens. Rules of routing do that without another package.
firewall() {
  on "$1" sh -euc "
    ip link add nowhere type veth peer name nobody
    ip link set nobody up; ip link set nowhere arp off up
    ip route add default dev nowhere table 22
    ip rule add pref 1 ipproto tcp sport 22 lookup main; ip rule add pref 2 ipproto tcp dport 22 lookup main
    ip rule add pref 3 ipproto tcp lookup 22"
}
lift_firewall() { on "$1" sh -euc "for each in 1 2 3; do ip rule delete pref \$each; done; ip link delete nowhere"; }

write_settings() {
  { echo "127.0.0.1 localhost"; for host in $hosts; do echo "10.77.0.1${host#n} $host"; done; } >"$dir/hosts"
  for host in $workers; do echo "$host slots=2"; done >"$dir/hostfile"
  ssh-keygen -q -t ed25519 -N '' -f "$dir/ssh/id_ed25519"
  ssh-keygen -q -t ed25519 -N '' -f "$dir/host_key"
  cp "$dir/ssh/id_ed25519.pub" "$dir/ssh/authorized_keys"
  printf 'StrictHostKeyChecking no\nUserKnownHostsFile /dev/null\nLogLevel ERROR\n' >"$dir/ssh/config"
  (umask 077 && head -c 1024 /dev/urandom >"$dir/munge.key")
  cat >"$SLURM_CONF" <<SETTINGS
ClusterName=testbed
SlurmctldHost=n0
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
MpiDefault=pmix
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
SlurmdTimeout=15
KillWait=5
MessageTimeout=5
SlurmctldPidFile=/run/slurmctld.pid
SlurmdPidFile=/run/slurmd.pid
SlurmdSpoolDir=$dir/spool/%n
StateSaveLocation=$dir/state
NodeName=n[1-4] CPUs=2 RealMemory=2000 State=UNKNOWN
SchedulerParameters=sched_interval=2,bf_interval=2,sched_min_interval=0
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
PartitionName=main Nodes=n[1-4] Default=YES MaxTime=INFINITE State=UP PriorityTier=1 GraceTime=10
PartitionName=urgent Nodes=n[1-4] MaxTime=INFINITE State=UP PriorityTier=2
SETTINGS
}

start_daemons() {
  local host
  for host in $hosts; do
    start_daemon "$host" munged --foreground --force --key-file="$dir/munge.key" --seed-file=/run/munge/seed \
      --pid-file=/run/munge/munged.pid --log-file=/run/munge/munged.log
    start_daemon "$host" /usr/sbin/sshd -D -h "$dir/host_key" -o StrictModes=no -o PermitRootLogin=yes \
      -o UsePAM=no -o PidFile=none -o AuthorizedKeysFile=/root/.ssh/authorized_keys
  done
  for host in $hosts; do wait_for 10 on "$host" munge -n; done
  start_daemon n0 slurmctld -D
  for host in $workers; do start_daemon "$host" slurmd -D -N "$host"; done
  wait_for 30 all_idle
}

all_idle() { [ "$(on n0 sinfo --noheader --states=idle --format=%D)" = 4 ]; }

# Waits at most $1 seconds until a command succeeds.
wait_for() {
  local seconds=$1 end
  shift
  end=$((SECONDS + seconds))
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || give_up "after $seconds seconds still not: $*; its logs: $dir/log"
    sleep 0.1
  done
}

up() {
  check_needs
  down
  trap '[ $? = 0 ] || stop_all' EXIT
  trap 'exit 130' INT TERM HUP
  mkdir -p "$dir"/{pid,log,spool,state,ssh,checkout} /root/.ssh
  chmod 700 "$dir" "$dir/ssh"
  write_settings
  start_namespaces switch --pid
  at_switch ip link add bridge type bridge
  at_switch ip link set bridge up
  local host
  for host in $hosts; do start_host "$host"; done
  start_daemons
  echo "testbed $name: head n0, hosts n1 n2 n3 n4; hostfile $dir/hostfile; logs $dir/log"
}

# Ends every host, in whatever state; keeps the logs.
stop_all() {
  local file pid
  for file in "$dir"/pid/*; do
    pid=$(cat "$file" 2>/dev/null || echo none)
    if is_host "$pid"; then kill -9 "$pid" 2>/dev/null || true; fi
    rm -f "$file"
  done
}

down() {
  stop_all
  rm -rf "$dir"
}

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; }

command=${1:-help}
[ $# = 0 ] || shift
case "$command:$#" in
  up:0) up ;;
  down:0) down ;;
  exec:0 | exec:1) give_up "exec what? testbed.sh exec HOST COMMAND" ;;
  exec:*) on "$@" ;;
  cut:1) at_switch ip link set "$1" down ;;
  join:1) at_switch ip link set "$1" up ;;
  firewall:1) firewall "$1" ;;
  lift:1) lift_firewall "$1" ;;
  slow:2)
    at_switch tc qdisc del dev "$1" root 2>/dev/null || true
    [ "$2" = full ] || at_switch tc qdisc add dev "$1" root tbf rate "$2" burst 64kb latency 400ms ;;
  kill:1) kill -9 "$(pid_of "$1")" && rm -f "$dir/pid/$1" ;;
  help:0 | -h:0 | --help:0) usage ;;
  *) usage >&2; exit 2 ;;
esac
