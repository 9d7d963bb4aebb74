/* A node of the farm: see farm_host.c. */
#include <cube.h>
#include "farm.h"

static int is_prime(long n)
{
    long divisor;

    for (divisor = 2; divisor * divisor <= n; divisor++)
        if (n % divisor == 0)
            return 0;
    return n > 1;
}

int main(void)
{
    long piece[2], found = 0, n;

    for (;;) {
        csend(READY, &found, sizeof found, myhost(), 0);
        crecv(PIECE, piece, sizeof piece);
        if (infocount() == 0)
            return 0;
        found = 0;
        for (n = piece[0]; n < piece[1]; n++)
            found += is_prime(n);
    }
}
