/* NX/2: files that many nodes work on at once, as the Concurrent File System of the iPSC/2 had them. A file is a
 * descriptor of open(2), which each node opens for itself, without O_APPEND where it shares the pointer; a
 * descriptor's mode is 0 until setiomode, and again after close(2). Lengths and places are bytes. Failures are as
 * in nx_messages.h; errno then is the system's (EBADF, ENOSPC ...), or EINVAL for what nodes do not agree about.
 *
 * Modes of a file:
 * 0  every node has a pointer of its own, the one that read(2), write(2) and lseek(2) move;
 * 1  all nodes share one pointer, first come, first served: what each reads or writes is a range of its own.
 *    Nobody waits for what another node does. Where nodes run on several machines, the pointer lies in a small
 *    hidden file beside the shared one: its folder must be writable, and the file system have locks;
 * 2  all nodes share one pointer and call together: their ranges lie in order of the nodes, each as long as its
 *    node says;
 * 3  as 2, but all ranges are equally long, for good: the first call after setiomode says how long. Nobody waits
 *    for anybody after that, and a call with another length fails on the node that makes it. */
#pragma once

#include "nx_errno.h"
#include "nx_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { M_UNIX = 0, M_LOG = 1, M_SYNC = 2, M_RECORD = 3 }; /* the modes, by the names they had later */
enum { SIZE_SET = 0, SIZE_CUR = 1, SIZE_END = 2 };        /* for lsize */

/* Reads or writes at the file's pointer, which moves on; returns how many bytes were moved. Reading ends early
 * where the file ends, and only there: see iseof. */
long cread(int fd, void* buf, long len);
long cwrite(int fd, const void* buf, long len);

/* Start to read or write, and return an id; the pointer moves on at once, `buf` is the call's until the id is
 * free. One after the other is done while the program goes on. Files without places (pipes) cannot do this. */
long iread(int fd, void* buf, long len);
long iwrite(int fd, const void* buf, long len);
/* Waits for what an id stands for, frees it, and returns how many bytes were moved. */
long iowait(long id);
/* 1 and the id is free, or 0: not yet. */
long iodone(long id);

/* 1 if the pointer is at the end of the file or beyond, else 0. */
long iseof(int fd);

/* Moves the pointer, as lseek(2) with SEEK_SET, SEEK_CUR or SEEK_END, and returns where it then is. `slow` is the
 * lower 32 bits of a place, `shigh` what is above. In modes 2 and 3 all nodes call, for the same place. */
esize_t eseek(int fd, esize_t offset, int whence);

/* Makes a file at least `offset` bytes long (SIZE_SET), or `offset` bytes beyond its pointer (SIZE_CUR) or its
 * end (SIZE_END); never shorter. Returns the file's size. */
long lsize(int fd, long offset, int whence);

/* All nodes call, with the same mode. Their pointers stay where they are: at the same place, but for mode 0. */
void setiomode(int fd, int mode);
long iomode(int fd);

/* The twins. */
long _cread(int fd, void* buf, long len);
long _cwrite(int fd, const void* buf, long len);
long _iread(int fd, void* buf, long len);
long _iwrite(int fd, const void* buf, long len);
long _iowait(long id);
long _iodone(long id);
long _iseof(int fd);
esize_t _eseek(int fd, esize_t offset, int whence); /* a failure: both parts are -1 */
long _lsize(int fd, long offset, int whence);
long _setiomode(int fd, int mode);
long _iomode(int fd);

#ifdef __cplusplus
}
#endif
