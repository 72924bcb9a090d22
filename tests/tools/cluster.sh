# cluster.sh -- a sweep by GNU parallel, and by a real Slurm of one node on the loopback address: the same bytes as here.
#
# Needs parallel; slurm-wlm and munge (Debian).  Slurm's three servers run with files of their own and end with the test.
. tests/tools/lib.sh
need_program cluster
cd "$work" || exit 1
PATH=$BUILD:$PATH
servers=
stop() { for pid in $servers; do kill "$pid" 2>/dev/null; done; wait 2>/dev/null; rm -rf "$work"; }
trap stop EXIT

fmdsub new controller >deck.yaml
over="--over L=0.5:2:12"
fmdsub sweep -q $over --of 'max(pin.angle), last(late)' -o here.csv deck.yaml 2>err
ended "here" 0 $? here.csv err

# ---- GNU parallel, as the manual has it, without hosts ----
if command -v parallel >/dev/null; then
    fmdsub sweep $over --of 'max(pin.angle), last(late)' --list deck.yaml >commands
    parallel --will-cite --workdir . --joblog log -j 2 <commands >rows 2>err
    fmdsub sweep --merge $over --of 'max(pin.angle), last(late)' -o parallel.csv rows 2>>err
    same "GNU parallel" here.csv parallel.csv
    expect "GNU parallel: a job a point, all well" "12 0" "$(awk 'NR > 1 { n++; bad += $7 != 0 } END { print n, bad + 0 }' log)" log
else
    skip "GNU parallel" "it is not installed"
fi

# ---- Slurm ----
for tool in munged slurmctld slurmd sbatch; do
    command -v $tool >/dev/null || [ -x /usr/sbin/$tool ] || { skip "Slurm" "$tool is not installed (Debian: slurm-wlm, munge)"; exit 0; }
done
PATH=$PATH:/usr/sbin
me=$(id -un) node=$(hostname -s)
mkdir state spool
chmod 755 "$work"
dd if=/dev/urandom of=munge.key bs=1 count=1024 2>/dev/null
chmod 600 munge.key
cat >slurm.conf <<CONF
ClusterName=loop
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/backfill
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=10 State=UP OverSubscribe=YES
CONF
SLURM_CONF=$work/slurm.conf
export SLURM_CONF
munged --force --foreground --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munge.pid" \
    --log-file="$work/munge.log" --seed-file="$work/munge.seed" >munge.out 2>&1 &
servers="$servers $!"
sleep 1
slurmctld -D -i -f "$SLURM_CONF" >ctld.log 2>&1 &
servers="$! $servers"
slurmd -D -f "$SLURM_CONF" -N "$node" >slurmd.log 2>&1 &
servers="$! $servers"
n=0
while [ $n -lt 60 ] && ! sinfo -h -o %T 2>/dev/null | grep -q idle; do sleep 0.5; n=$((n + 1)); done
expect "Slurm: a node that is idle" idle "$(sinfo -h -o %T 2>&1 | head -n 1)" ctld.log slurmd.log munge.out
fmdsub sweep $over --of 'max(pin.angle), last(late)' --slurm 4 -o table.csv deck.yaml >job.sh
timeout 120 sbatch --wait job.sh >sbatch.log 2>&1
expect "Slurm: an array of four tasks" 0 $? sbatch.log ctld.log slurmd.log
fmdsub sweep --merge $over --of 'max(pin.angle), last(late)' -o table.csv table.csv.[0-9]* 2>err
same "Slurm" here.csv table.csv
