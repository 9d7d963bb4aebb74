C     Pi, as the area below 4 / (1 + x * x) from 0 to 1: strips dealt
C     out to the nodes, one global sum.
      PROGRAM PI
      INCLUDE 'fcube.h'
      INTEGER STRIPS, I
      PARAMETER (STRIPS = 100000)
      DOUBLE PRECISION X, SUM, WORK
      SUM = 0
      DO 10 I = MYNODE(), STRIPS - 1, NUMNODES()
         X = (I + 0.5D0) / STRIPS
         SUM = SUM + 4 / (1 + X * X)
   10 CONTINUE
      CALL GDSUM(SUM, 1, WORK)
      IF (MYNODE() .NE. 0) STOP
      SUM = SUM / STRIPS
      WRITE (*, 20) SUM, NUMNODES()
   20 FORMAT ('pi: ', F10.8, ' by', I3, ' nodes')
      IF (ABS(SUM - 3.14159265358979D0) .GE. 1D-9) STOP 1
      END
