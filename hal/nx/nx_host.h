/* NX/2: what a host program does with its cube of nodes, in the order in which programs do it: getcube or attachcube,
 * setpid, load, csend and crecv, waitall or waitone, killcube, relcube. The cube is made of the nodes that this job was
 * started with (mars-nx run --nodes 8 ..., or mpirun). A host that loads none itself lets all begin with the
 * program they were started for when it first sends, receives, waits or ends; after a load none begins by itself.
 *
 * pid is 0, node and pid -1 mean all. Failures are as in nx_messages.h. Of the calls here, a node may use only
 * killproc and killcube, which there end the whole job. */
#pragma once

#include "nx_errno.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NAMELEN 16 /* characters of a cube's name, with its end */

/* Makes the first nodes of the job the cube, `name`. cubetype: "8" or "d3" for eight nodes, what follows is ignored;
 * NULL or "" for all there are. More than there are: EQNODE. srmname and keep are ignored. */
void getcube(const char* name, const char* cubetype, const char* srmname, long keep);
/* As getcube with all nodes, unless the cube of that name is there already. */
void attachcube(const char* name);
/* Ends what still runs on the nodes and gives the cube up; NULL or "": whatever its name. */
void relcube(const char* name);

/* Of the host process, which has it for mypid() and accepts messages to any pid; 0 or more. A node's is 0. */
void setpid(long pid);

/* Starts the program `file` on `node`: the file as given, or one of its name beside the host program. Under MPI,
 * which has started the nodes already, it must be the program that they run; it goes on now. What is sent to a node
 * whose program has ended is nobody's, unless the sender was loaded after that end: then the node's next program gets
 * it. */
void load(const char* file, long node, long pid);

/* Waits until the programs loaded on `node` have ended. */
void waitall(long node, long pid);
/* Waits until one of them has, and returns which; each end is reported once. *ccode is the exit code, or minus the
 * number of the signal of which it died. */
void waitone(long node, long pid, long* cnode, long* cpid, long* ccode);

/* Ends the process on a node at once; under MPI at its next NX call. killcube also throws away all messages that are on
 * their way. */
void killproc(long node, long pid);
void killcube(long node, long pid);

/* A cube that is held. */
struct cubetable {
  char cubename[NAMELEN];
  char cubetype[NAMELEN];
  char srmname[NAMELEN];
  long nodes;
};
/* Describes the first `slots` of the cubes that there are, which is one here at most; returns how many there are. */
long cubeinfo(struct cubetable table[], long slots, long global);

/* The twins. */
long _getcube(const char* name, const char* cubetype, const char* srmname, long keep);
long _attachcube(const char* name);
long _relcube(const char* name);
long _setpid(long pid);
long _load(const char* file, long node, long pid);
long _waitall(long node, long pid);
long _waitone(long node, long pid, long* cnode, long* cpid, long* ccode);
long _killproc(long node, long pid);
long _killcube(long node, long pid);
long _cubeinfo(struct cubetable table[], long slots, long global);

#ifdef __cplusplus
}
#endif
