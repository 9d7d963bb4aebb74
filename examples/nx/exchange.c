/* Neighbours of the cube swap long messages head to head, both sending first: across every dimension in turn, until
 * everybody has what everybody had (an all-gather by dimension exchange). Nodes beyond a power of two get a copy. */
#include <stdio.h>
#include <cube.h>

#define WORDS 5000 /* a node's part */
#define PARTS 64   /* the most nodes */
#define SWAP 50
#define COPY 90

static int all[PARTS][WORDS];

int main(void)
{
    int me = mynode(), nodes = numnodes();
    int corners, bit, i, node, mine, theirs;
    long wrong = 0, work;

    for (corners = 1; corners * 2 <= nodes; corners *= 2)
        ;
    for (i = 0; i < WORDS; i++)
        all[me][i] = me * WORDS + i;
    if (me < corners)
        for (bit = 1; bit < corners; bit *= 2) {
            mine = me & ~(bit - 1);
            theirs = mine ^ bit;
            csend(SWAP + bit, all[mine], bit * (int) sizeof all[0], me ^ bit, 0);
            crecv(SWAP + bit, all[theirs], bit * (int) sizeof all[0]);
        }
    if (me == 0)
        for (node = corners; node < nodes; node++)
            csend(COPY, all, corners * (int) sizeof all[0], node, 0);
    if (me >= corners)
        crecv(COPY, all, corners * (int) sizeof all[0]);
    for (node = 0; node < corners; node++)
        for (i = 0; i < WORDS; i++)
            wrong += all[node][i] != node * WORDS + i;
    gisum(&wrong, 1, &work);
    if (me == 0)
        printf("exchange: %d parts of %d bytes on %d nodes, %ld words wrong\n", corners, (int) sizeof all[0], nodes,
               wrong);
    return wrong != 0;
}
