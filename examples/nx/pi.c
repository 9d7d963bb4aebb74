/* Pi, as the area below 4 / (1 + x * x) from 0 to 1: strips dealt out to the nodes, one global sum. */
#include <math.h>
#include <stdio.h>
#include <cube.h>

#define STRIPS 100000

int main(void)
{
    double x, sum, work;
    int i, right;

    sum = 0;
    for (i = mynode(); i < STRIPS; i += numnodes()) {
        x = (i + 0.5) / STRIPS;
        sum += 4 / (1 + x * x);
    }
    gdsum(&sum, 1, &work);
    if (mynode() != 0)
        return 0;
    sum /= STRIPS;
    right = fabs(sum - 3.14159265358979) < 1e-9;
    printf("pi: %.8f by %ld nodes, %s\n", sum, numnodes(), right ? "right" : "WRONG");
    return !right;
}
