/* C = A B. Each node keeps some rows of A and of C; the rows of B go round the ring, and while a node works
 * with those it has, the next are on their way to it. */
#include <stdio.h>
#include <cube.h>

#define N 60
#define ROWS 10 /* the type of a message with rows of B, and the step it is for */

static double a[N][N], b[2][N][N], c[N][N];

static int first_row(int node, int nodes)
{
    return N * node / nodes;
}

/* C += A B, as far as the rows of B that `owner` began with go. */
static void multiply(double rows[N][N], int owner, int me, int nodes)
{
    int i, j, k, first = first_row(owner, nodes);

    for (i = first_row(me, nodes); i < first_row(me + 1, nodes); i++)
        for (k = first; k < first_row(owner + 1, nodes); k++)
            for (j = 0; j < N; j++)
                c[i][j] += a[i][k] * rows[k - first][j];
}

/* Of our rows of C: a[i][k] = i + k and b[k][j] = k - j have a product in closed form. */
static long count_wrong(int me, int nodes)
{
    long sum = 0, squares = 0, wrong = 0;
    int i, j, k;

    for (k = 0; k < N; k++) {
        sum += k;
        squares += k * k;
    }
    for (i = first_row(me, nodes); i < first_row(me + 1, nodes); i++)
        for (j = 0; j < N; j++)
            wrong += c[i][j] != (double) (squares + (i - j) * sum - (long) N * i * j);
    return wrong;
}

int main(void)
{
    int me = mynode(), nodes = numnodes();
    int i, j, step, owner, now = 0;
    long in = 0, out = 0, wrong, work;

    for (i = first_row(me, nodes); i < first_row(me + 1, nodes); i++)
        for (j = 0; j < N; j++) {
            a[i][j] = i + j;
            b[0][i - first_row(me, nodes)][j] = i - j;
        }
    for (step = 0; step < nodes; step++) {
        owner = (me + step) % nodes;
        if (step < nodes - 1) {
            in = irecv(ROWS + step, b[1 - now], sizeof b[0]);
            out = isend(ROWS + step, b[now],
                        (first_row(owner + 1, nodes) - first_row(owner, nodes)) * (int) sizeof b[0][0],
                        (me + nodes - 1) % nodes, 0);
        }
        multiply(b[now], owner, me, nodes);
        if (step < nodes - 1) {
            msgwait(out);
            msgwait(in);
        }
        now = 1 - now;
    }
    wrong = count_wrong(me, nodes);
    gisum(&wrong, 1, &work);
    if (me == 0)
        printf("matrix: %d by %d on %d nodes, %ld elements wrong\n", N, N, nodes, wrong);
    return wrong != 0;
}
