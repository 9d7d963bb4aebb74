/* A counter that all nodes share. Node 0 keeps it and hands out numbers from a handler, while it works itself:
 * whoever is done with a piece of work takes the next number. masktrap keeps the handler out while node 0 takes
 * a number for itself. */
#include <stdio.h>
#include <cube.h>

#define ASK 1
#define ANSWER 2
#define PIECES 500

static long counter; /* node 0's */
static long question;

static void hand_out(long type, long length, long node, long pid)
{
    (void) type;
    (void) length;
    csend(ANSWER, &counter, sizeof counter, node, pid);
    counter++;
    hrecv(ASK, &question, sizeof question, hand_out); /* a handler is called once: ask again */
}

static long next_number(void)
{
    long number = 0, mask;

    if (mynode() == 0) {
        mask = masktrap(1);
        number = counter++;
        masktrap(mask);
    } else
        csendrecv(ASK, &number, sizeof number, 0, 0, ANSWER, &number, sizeof number);
    return number;
}

int main(void)
{
    long n, sums[2], work[2]; /* how many pieces were done, and the sum of their numbers */

    if (mynode() == 0)
        hrecv(ASK, &question, sizeof question, hand_out);
    gsync();
    sums[0] = sums[1] = 0;
    while ((n = next_number()) < PIECES) {
        sums[0]++;
        sums[1] += n;
        flick(); /* the work; the handler is called inside NX calls */
    }
    gisum(sums, 2, work);
    if (mynode() == 0)
        printf("counter: %ld pieces done by %ld nodes, %s\n", sums[0], numnodes(),
               sums[1] == (long) PIECES * (PIECES - 1) / 2 ? "each once" : "NOT each once");
    return sums[0] != PIECES || sums[1] != (long) PIECES * (PIECES - 1) / 2;
}
