#include <cube.h>
#include <fcntl.h>
#include <errno.h>
#include <stdio.h>
int main(void){ int fd=open("/dev/full",O_WRONLY); long id; char b[100]; id=_iwrite(fd,b,100); if(_iowait(id)<0) {printf("errno %d\n",errno); nx_perror("disk");} if (mynode()==1) {cwrite(fd,b,100);} gsync(); return 0;}
