/* The values of errno after a call's twin returned -1. The names are NX's; the numbers are ours, beyond those of the
 * system. */
#pragma once

#include <errno.h>

#define EQMSGLONG 3001 /* a message longer than the receive's buffer */
#define EQTYPE 3002    /* a message type or typesel that is reserved */
#define EQNODE 3003    /* no such node, or one that cannot be meant here */
#define EQPID 3004     /* no such process on the node */
#define EQLEN 3005     /* a length that is negative, or too long to carry */
#define EQMID 3006     /* a message id that stands for nothing */
#define EQNOMID 3007   /* all message ids are in use */
#define EQPBUF 3008    /* no pointer where a buffer is needed */

#ifdef __cplusplus
extern "C" {
#endif

/* Prints `text`, and why the last twin of this process failed, to standard error. */
void nx_perror(const char* text);

#ifdef __cplusplus
}
#endif
