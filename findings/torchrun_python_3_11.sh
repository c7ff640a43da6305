#!/usr/bin/env bash
# LibTorch 1.13's launcher (torch.distributed.run, torchrun) under Python 3.11, as Debian 12 ships both: it starts no worker with its
# default options, because --redirects 0 and --tee 0 name Std.NONE, which it looks for by iterating over the flag enumeration Std; from
# 3.11 on that leaves members of value zero out. `-r 1 -t 1` (or 2) works. 1.13 knows --no_python only, not --no-python.
#
# Debian 12: python3-torch 1.13.1+dfsg-4, python3 3.11.2. Seen here: without -r and -t
# "AttributeError: 'NoneType' object has no attribute 'get'"; with -r 1 -t 1 both ranks run.
set -euo pipefail

version=1.13.1+dfsg-4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# Needs what the package depends on, so it is installed into the system, not unpacked here.
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "python3-torch=$version" >/dev/null 2>&1
python=/usr/bin/python3
$python -c 'import sys, torch; print("Python", sys.version.split()[0], "torch", torch.__version__)'

launch() {
  $python -m torch.distributed.run --standalone --nproc_per_node 2 "$@" /bin/sh -c 'echo "rank $RANK of $WORLD_SIZE"' 2>&1 || true
}
launch --no_python | tee plain.txt | tail -1
launch --no_python -r 1 -t 1 | tee told.txt | grep -o 'rank [01] of 2' | sort -u
launch --no-python | tee dash.txt | tail -1

grep -q "'NoneType' object has no attribute 'get'" plain.txt || { echo "the defaults start workers now"; exit 1; }
[ "$(grep -c 'rank [01] of 2' told.txt)" -ge 2 ] || { echo "-r 1 -t 1 does not help any more"; exit 1; }
grep -q 'unrecognized arguments: --no-python' dash.txt || { echo "--no-python is known now"; exit 1; }
echo "as described"
