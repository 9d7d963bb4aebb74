/* What the farm's host and nodes say to each other. */
#define READY 1 /* node to host: the number of primes in the piece just done, 0 at first */
#define PIECE 2 /* host to node: first number and the one after the last; none: enough */
