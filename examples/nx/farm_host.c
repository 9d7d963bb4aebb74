/* The host of a farm: counts the primes below LIMIT. It loads farm_node on all nodes and gives pieces of the work to
 * whoever asks. */
#include <stdio.h>
#include <cube.h>
#include "farm.h"

#define LIMIT 20000
#define SIZE 250
#define PRIMES 2262

int main(void)
{
    long piece[2], primes = 0, found, next = 0, node, working, pid, code, bad = 0;

    getcube("farm", "", NULL, 0);
    setpid(0);
    load("farm_node", -1, 0);
    for (working = numnodes(); working > 0;) {
        crecv(READY, &found, sizeof found);
        node = infonode();
        ctohl(&found, 1);
        primes += found;
        piece[0] = next;
        piece[1] = next + SIZE;
        htocl(piece, 2);
        csend(PIECE, piece, next < LIMIT ? sizeof piece : 0, node, 0);
        if (next >= LIMIT)
            working--;
        next += SIZE;
    }
    for (working = numnodes(); working > 0; working--) {
        waitone(-1, 0, &node, &pid, &code);
        if (code != 0) {
            printf("farm: node %ld ended with %ld\n", node, code);
            bad++;
        }
    }
    printf("farm: %ld primes below %d by %ld nodes, %s\n", primes, LIMIT, numnodes(),
           primes == PRIMES ? "right" : "WRONG");
    relcube("farm");
    return bad != 0 || primes != PRIMES;
}
