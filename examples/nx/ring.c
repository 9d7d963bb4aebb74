/* A token goes round the ring of nodes and every node adds its part. */
#include <stdio.h>
#include <cube.h>

#define TOKEN 10
#define ROUNDS 5

int main(void)
{
    long token, right;
    int me, nodes, round;

    me = mynode();
    nodes = numnodes();
    token = 0;
    for (round = 0; round < ROUNDS; round++) {
        if (me != 0)
            crecv(TOKEN, &token, sizeof token);
        token += me + 1;
        csend(TOKEN, &token, sizeof token, (me + 1) % nodes, 0);
        if (me == 0)
            crecv(TOKEN, &token, sizeof token);
    }
    if (me != 0)
        return 0;
    right = (long) ROUNDS * nodes * (nodes + 1) / 2;
    printf("ring: %ld after %d rounds of %d nodes, %s\n", token, ROUNDS, nodes, token == right ? "right" : "WRONG");
    return token != right;
}
