/* Laplace's equation on a square, by Jacobi's method on a grid of nodes. The grid is laid into the cube by Gray
 * codes, so that neighbours in the grid are neighbours in the cube. Nodes beyond a power of two stay idle. On the
 * border u = x y, which solves the equation everywhere: the answer is known. */
#include <math.h>
#include <stdio.h>
#include <cube.h>

#define N 16       /* inner points a side */
#define EDGE 100   /* types of messages: the side they come from */
#define STEPS 2000 /* at most */
#define MAX(a, b) ((a) > (b) ? (a) : (b))
#define EVERY 20 /* steps from one look at the change to the next */

enum { NORTH, SOUTH, WEST, EAST };

static double u[N + 2][N + 2], v[N + 2][N + 2];
static int top, bottom, left, right; /* our points: top..bottom-1, left..right-1, counted from 1 */
static int neighbour[4];             /* -1: the border */

static double exact(int i, int j)
{
    return (double) i * j / ((N + 1) * (N + 1));
}

/* Node 2^dy gray(row) + gray(column) has the place (row, column) in a grid of 2^dx by 2^dy. */
static void find_place(int me, int nodes)
{
    int d, dx, dy, row, column, rows, columns;

    for (d = 0; 2 << d <= nodes; d++)
        ;
    dx = d / 2;
    dy = d - dx;
    rows = 1 << dx;
    columns = 1 << dy;
    if (me >= rows * columns)
        return;
    row = ginv(me >> dy);
    column = ginv(me & (columns - 1));
    neighbour[NORTH] = row == 0 ? -1 : (int) (gray(row - 1) << dy | gray(column));
    neighbour[SOUTH] = row == rows - 1 ? -1 : (int) (gray(row + 1) << dy | gray(column));
    neighbour[WEST] = column == 0 ? -1 : (int) (gray(row) << dy | gray(column - 1));
    neighbour[EAST] = column == columns - 1 ? -1 : (int) (gray(row) << dy | gray(column + 1));
    top = 1 + N * row / rows;
    bottom = 1 + N * (row + 1) / rows;
    left = 1 + N * column / columns;
    right = 1 + N * (column + 1) / columns;
}

/* One side's points: to the buffer, or from it. */
static int edge(double *buffer, int side, int outside, int in)
{
    int i, n = 0, line;

    if (side == NORTH || side == SOUTH) {
        line = side == NORTH ? top - outside : bottom - 1 + outside;
        for (i = left; i < right; i++, n++)
            if (in)
                u[line][i] = buffer[n];
            else
                buffer[n] = u[line][i];
    } else {
        line = side == WEST ? left - outside : right - 1 + outside;
        for (i = top; i < bottom; i++, n++)
            if (in)
                u[i][line] = buffer[n];
            else
                buffer[n] = u[i][line];
    }
    return n * (int) sizeof(double);
}

static void exchange(void)
{
    static const int opposite[4] = {SOUTH, NORTH, EAST, WEST};
    double buffer[N];
    int side, length;

    for (side = 0; side < 4; side++)
        if (neighbour[side] >= 0) {
            length = edge(buffer, side, 0, 0);
            csend(EDGE + opposite[side], buffer, length, neighbour[side], 0);
        }
    for (side = 0; side < 4; side++)
        if (neighbour[side] >= 0) {
            crecv(EDGE + side, buffer, sizeof buffer);
            edge(buffer, side, 1, 1);
        }
}

/* Returns the greatest change of our points. */
static double step(void)
{
    double change = 0;
    int i, j;

    for (i = top; i < bottom; i++)
        for (j = left; j < right; j++)
            v[i][j] = (u[i - 1][j] + u[i + 1][j] + u[i][j - 1] + u[i][j + 1]) / 4;
    for (i = top; i < bottom; i++)
        for (j = left; j < right; j++) {
            change = MAX(change, fabs(v[i][j] - u[i][j]));
            u[i][j] = v[i][j];
        }
    return change;
}

int main(void)
{
    double change = 1, error = 0, work;
    int i, j, steps;

    for (i = 0; i < N + 2; i++)
        for (j = 0; j < N + 2; j++)
            u[i][j] = i % (N + 1) == 0 || j % (N + 1) == 0 ? exact(i, j) : 0;
    for (i = 0; i < 4; i++)
        neighbour[i] = -1;
    find_place((int) mynode(), (int) numnodes());
    for (steps = 0; steps < STEPS && change > 1e-9; steps++) {
        exchange();
        change = step();
        if (steps % EVERY == 0)
            gdhigh(&change, 1, &work);
        else
            change = 1;
    }
    for (i = top; i < bottom; i++)
        for (j = left; j < right; j++)
            error = MAX(error, fabs(u[i][j] - exact(i, j)));
    gdhigh(&error, 1, &work);
    if (mynode() == 0)
        printf("jacobi: %d steps on %ld nodes, %s\n", steps, numnodes(), error < 1e-6 ? "right" : "WRONG");
    return error >= 1e-6;
}
