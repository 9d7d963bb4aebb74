C     The host of fortran_calls: makes a cube, loads it, waits.
      PROGRAM HOST
      INCLUDE 'fcube.h'
      CHARACTER*40 NODES
      INTEGER I, NODE, PID, CODE
      NODES = 'fortran_calls'
      CALL GETCUBE('calls', ' ', ' ', 0)
      CALL SETPID(0)
      CALL LOAD(NODES, -1, 0)
      DO 10 I = 1, NUMNODES() - 1
         CALL WAITONE(-1, 0, NODE, PID, CODE)
         IF (NODE .LT. 0 .OR. PID .NE. 0 .OR. CODE .NE. 0) STOP 1
   10 CONTINUE
      CALL WAITALL(-1, 0)
      CALL KILLCUBE(-1, -1)
      CALL RELCUBE('calls')
      END
