#!/usr/bin/env python3
"""What NX's calls cost beside MPI's own: csend and crecv against MPI_Send and
MPI_Recv, gdsum against MPI_Allreduce, best and middle of 200 rounds in turn, in
one run each; and the share of a core that a waiting host uses."""
import argparse
import os
import subprocess
import sys


def main():
    parser = argparse.ArgumentParser(prog="mars bench messages", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--nodes", type=int, nargs="+", default=[1, 2, 4, 8],
                        help="one: ping-pong with the host; more: their sums")
    wanted = parser.parse_args()
    program = os.path.join(wanted.build, "bench", "messages", "bench-messages")
    if not os.path.exists(program):
        sys.exit("bench-messages was not built: it needs MPI (./bootstrap)")
    root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    for nodes in wanted.nodes:
        command = ["mpirun", "--bind-to", "none", "--oversubscribe", "-n", str(nodes + 1), program]
        subprocess.run(command, check=True, env={**os.environ, **root})


if __name__ == "__main__":
    sys.exit(main())
