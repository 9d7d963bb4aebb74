C     Heat along a rod whose ends are kept at 0 and at 1: the rod is cut
C     into a piece a node, and nodes swap the values at the cuts after
C     every step. In the end the heat grows evenly from end to end.
      PROGRAM HEAT
      INCLUDE 'fcube.h'
      INTEGER N, LEFT, RIGHT
      PARAMETER (N = 24, LEFT = 101, RIGHT = 102)
      DOUBLE PRECISION U(0:N + 1), V(N), CHANGE, ERROR, WORK
      INTEGER ME, NODES, FIRST, LAST, STEP, MID(2), I
      ME = MYNODE()
      NODES = NUMNODES()
      FIRST = 1 + N * ME / NODES
      LAST = N * (ME + 1) / NODES
      DO 10 I = 0, N + 1
         U(I) = 0
   10 CONTINUE
      U(N + 1) = 1
      DO 50 STEP = 1, 10000
C        What comes from the left is posted before anything is sent.
         IF (ME .GT. 0) MID(1) = IRECV(RIGHT, U(FIRST - 1), 8)
         IF (ME .LT. NODES - 1) MID(2) = IRECV(LEFT, U(LAST + 1), 8)
         IF (ME .GT. 0) CALL CSEND(LEFT, U(FIRST), 8, ME - 1, 0)
         IF (ME .LT. NODES - 1) CALL CSEND(RIGHT, U(LAST), 8, ME + 1, 0)
         IF (ME .GT. 0) CALL MSGWAIT(MID(1))
         IF (ME .LT. NODES - 1) CALL MSGWAIT(MID(2))
         CHANGE = 0
         DO 20 I = FIRST, LAST
            V(I) = (U(I - 1) + U(I + 1)) / 2
            CHANGE = MAX(CHANGE, ABS(V(I) - U(I)))
   20    CONTINUE
         DO 30 I = FIRST, LAST
            U(I) = V(I)
   30    CONTINUE
         IF (MOD(STEP, 50) .EQ. 0) THEN
            CALL GDHIGH(CHANGE, 1, WORK)
            IF (CHANGE .LT. 1D-9) GO TO 60
         END IF
   50 CONTINUE
   60 ERROR = 0
      DO 70 I = FIRST, LAST
         ERROR = MAX(ERROR, ABS(U(I) - DBLE(I) / (N + 1)))
   70 CONTINUE
      CALL GDHIGH(ERROR, 1, WORK)
      IF (ME .EQ. 0) WRITE (*, 80) STEP, NODES
   80 FORMAT ('heat:', I6, ' steps on', I3, ' nodes')
      IF (ERROR .GE. 1D-6) STOP 1
      END
