/* One file for all nodes, in each of the four I/O modes of the Concurrent File System. */
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <cube.h>

#define LINES 10
#define RECORD 16 /* bytes a record */

static long wrong;

static void expect(int holds, const char *what)
{
    if (holds)
        return;
    printf("shared_file: node %ld: %s\n", mynode(), what);
    wrong++;
}

/* Every node calls, also where the file is there already. */
static int open_file(const char *name, int mode)
{
    int fd = open(name, O_RDWR | O_CREAT, 0644);

    if (fd < 0)
        perror(name);
    setiomode(fd, mode);
    return fd;
}

/* Mode 3: records of one length, in order of the nodes, without a word between them. */
static void write_records(const char *name)
{
    char record[40];
    int fd = open_file(name, 3), i;

    for (i = 0; i < LINES; i++) {
        sprintf(record, "%4d, node %4ld\n", i, mynode());
        cwrite(fd, record, RECORD);
    }
    close(fd);
    gsync();
}

/* Mode 0: everybody reads where it likes. */
static void check_records(const char *name)
{
    char record[40], right[40];
    int fd = open_file(name, 0), i;
    esize_t place;
    long node = (mynode() + 1) % numnodes(), id;

    for (i = 0; i < LINES; i++) {
        place.slow = (i * numnodes() + node) * RECORD;
        place.shigh = 0;
        eseek(fd, place, SEEK_SET);
        id = iread(fd, record, RECORD); /* and something useful meanwhile */
        sprintf(right, "%4d, node %4ld\n", i, node);
        expect(iowait(id) == RECORD && memcmp(record, right, RECORD) == 0, "a record is wrong");
    }
    close(fd);
    gsync();
}

/* Mode 1: who is first takes the next record, until there are none. */
static void share_records(const char *name)
{
    char record[RECORD];
    int fd = open_file(name, 1);
    long taken = 0, work;

    while (cread(fd, record, RECORD) == RECORD)
        taken++;
    expect(iseof(fd) == 1, "not at the end");
    gisum(&taken, 1, &work);
    expect(taken == LINES * numnodes(), "records were lost, or taken twice");
    close(fd);
    gsync();
}

/* Mode 2: as long as each node likes, in order of the nodes. */
static void append_text(const char *name)
{
    char text[100];
    int fd = open_file(name, 2);
    esize_t end;

    end.slow = end.shigh = 0;
    eseek(fd, end, SEEK_END);
    memset(text, 'a' + (int) (mynode() % 26), sizeof text);
    cwrite(fd, text, mynode() % 10);
    expect(iseof(fd) || mynode() != numnodes() - 1, "not at the end");
    close(fd);
    gsync();
}

static void check_text(const char *name)
{
    char text[100];
    int fd = open_file(name, 0);
    esize_t place;
    long i, before = 0;

    for (i = 0; i < mynode(); i++)
        before += i % 10;
    place.slow = LINES * numnodes() * RECORD + before;
    place.shigh = 0;
    eseek(fd, place, SEEK_SET);
    expect(cread(fd, text, mynode() % 10) == mynode() % 10, "the text is too short");
    for (i = 0; i < mynode() % 10; i++)
        expect(text[i] == 'a' + mynode() % 26, "the text is wrong");
    close(fd);
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "shared_file.out";
    long work;

    if (mynode() == 0)
        unlink(name);
    gsync();
    write_records(name);
    check_records(name);
    share_records(name);
    append_text(name);
    check_text(name);
    gisum(&wrong, 1, &work);
    if (mynode() == 0) {
        printf("shared_file: %ld nodes, four modes, %ld things wrong\n", numnodes(), wrong);
        unlink(name);
    }
    return wrong != 0;
}
