C     Every call of NX that Fortran has, once: each node counts what is
C     wrong, the program ends with their sum.
      PROGRAM CALLS
      INCLUDE 'fcube.h'
      COMMON /COUNTS/ NWRONG
      INTEGER ALL, WORK
      NWRONG = 0
      CALL TMESS
      CALL TASYNC
      CALL TPROBE
      CALL THAND
      CALL TSUMS
      CALL TINTS
      CALL TCOLL
      CALL TFILES
      CALL TPARAG
      CALL TSELF
      ALL = NWRONG
      CALL GISUM(ALL, 1, WORK)
      IF (MYNODE() .EQ. 0) WRITE (*, 10) NUMNODES(), ALL
   10 FORMAT ('calls:', I3, ' nodes,', I4, ' wrong')
      IF (ALL .NE. 0) STOP 1
      END

      SUBROUTINE EXPECT(OK, WHAT)
      INCLUDE 'fcube.h'
      LOGICAL OK
      CHARACTER*(*) WHAT
      COMMON /COUNTS/ NWRONG
      IF (OK) RETURN
      NWRONG = NWRONG + 1
      WRITE (*, *) 'node ', MYNODE(), ': ', WHAT
      END

      SUBROUTINE TMESS
      INCLUDE 'fcube.h'
      INTEGER NEXT, LAST, GOT
      CHARACTER*5 WORD
      NEXT = MOD(MYNODE() + 1, NUMNODES())
      LAST = MOD(MYNODE() + NUMNODES() - 1, NUMNODES())
      CALL CSEND(7, 100 + MYNODE(), 4, NEXT, 0)
      CALL CRECV(7, GOT, 4)
      CALL EXPECT(GOT .EQ. 100 + LAST, 'crecv')
      CALL EXPECT(INFOCOUNT() .EQ. 4, 'infocount')
      CALL EXPECT(INFONODE() .EQ. LAST, 'infonode')
      CALL EXPECT(INFOTYPE() .EQ. 7, 'infotype')
      CALL EXPECT(INFOPID() .EQ. 0, 'infopid')
      CALL EXPECT(CSENDRECV(8, 'hello', 5, NEXT, 0, 8, WORD, 5) .EQ. 5,
     1            'csendrecv')
      CALL EXPECT(WORD .EQ. 'hello', 'csendrecv''s answer')
C     A set of types, as a negative number.
      CALL CSEND(2, 5, 4, MYNODE(), 0)
      CALL CRECV(-2147483641, GOT, 4)
      CALL EXPECT(GOT .EQ. 5, 'a set of types')
      CALL GSENDX(9, MYNODE(), 4, NEXT, 1)
      CALL CRECV(9, GOT, 4)
      CALL EXPECT(GOT .EQ. LAST, 'gsendx')
      END

      SUBROUTINE TASYNC
      INCLUDE 'fcube.h'
      INTEGER IN, OUT, GOT, DONE
      DOUBLE PRECISION X
      IN = IRECV(20, X, 8)
      CALL EXPECT(MSGDONE(IN) .EQ. 0, 'msgdone')
      OUT = ISEND(20, 2.5D0, 8, MYNODE(), 0)
      CALL MSGWAIT(OUT)
   10 DONE = MSGDONE(IN)
      IF (DONE .EQ. 0) GO TO 10
      CALL EXPECT(X .EQ. 2.5D0, 'irecv')
      IN = ISENDRECV(21, 6, 4, MYNODE(), 0, 21, GOT, 4)
      CALL MSGWAIT(IN)
      CALL EXPECT(GOT .EQ. 6, 'isendrecv')
      IN = IRECV(22, GOT, 4)
      CALL MSGCANCEL(IN)
      END

      SUBROUTINE TPROBE
      INCLUDE 'fcube.h'
      CALL EXPECT(IPROBE(-1) .EQ. 0, 'iprobe of nothing')
      CALL CSEND(30, 1, 4, MYNODE(), 0)
      CALL CPROBE(30)
      CALL EXPECT(INFOCOUNT() .EQ. 4, 'cprobe')
      CALL EXPECT(IPROBE(-1) .EQ. 1, 'iprobe')
      CALL FLUSHMSG(30, -1, -1)
      CALL EXPECT(IPROBE(30) .EQ. 0, 'flushmsg')
      END

C     A handler that is sent its own node's messages.
      SUBROUTINE HANDLE(TYPE, LENGTH, NODE, PID)
      INTEGER TYPE, LENGTH, NODE, PID
      COMMON /HANDLED/ NTIMES, NLAST(4)
      NTIMES = NTIMES + 1
      NLAST(1) = TYPE
      NLAST(2) = LENGTH
      NLAST(3) = NODE
      NLAST(4) = PID
      END

      SUBROUTINE AWAIT(N)
      COMMON /HANDLED/ NTIMES, NLAST(4)
   10 CALL FLICK
      IF (NTIMES .LT. N) GO TO 10
      END

      SUBROUTINE THAND
      INCLUDE 'fcube.h'
      EXTERNAL HANDLE
      COMMON /HANDLED/ NTIMES, NLAST(4)
      INTEGER IN(2), OLD, I
      NTIMES = 0
      CALL HRECV(40, IN, 8, HANDLE)
      OLD = MASKTRAP(1)
      CALL EXPECT(OLD .EQ. 0, 'masktrap')
      CALL CSEND(40, 77, 4, MYNODE(), 0)
      DO 10 I = 1, 10
         CALL FLICK
   10 CONTINUE
      CALL EXPECT(NTIMES .EQ. 0, 'masktrap(1) keeps handlers out')
      OLD = MASKTRAP(0)
      CALL EXPECT(OLD .EQ. 1, 'masktrap(0)')
      CALL AWAIT(1)
      CALL EXPECT(IN(1) .EQ. 77, 'hrecv')
      CALL EXPECT(NLAST(1) .EQ. 40 .AND. NLAST(2) .EQ. 4 .AND.
     1   NLAST(3) .EQ. MYNODE() .AND. NLAST(4) .EQ. 0, 'its arguments')
      CALL HSEND(41, 78, 4, MYNODE(), 0, HANDLE)
      CALL AWAIT(2)
      CALL CRECV(41, IN, 8)
      CALL EXPECT(IN(1) .EQ. 78, 'hsend')
      CALL HSENDRECV(42, 79, 4, MYNODE(), 0, 42, IN, 8, HANDLE)
      CALL AWAIT(3)
      CALL EXPECT(IN(1) .EQ. 79, 'hsendrecv')
      END

      SUBROUTINE TSUMS
      INCLUDE 'fcube.h'
      DOUBLE PRECISION D(2), DW(2)
      REAL R(2), RW(2)
      INTEGER N
      N = NUMNODES()
      D(1) = MYNODE()
      D(2) = 1
      CALL GDSUM(D, 2, DW)
      CALL EXPECT(D(1) .EQ. N * (N - 1) / 2 .AND. D(2) .EQ. N, 'gdsum')
      D(1) = 2
      CALL GDPROD(D, 1, DW)
      CALL EXPECT(D(1) .EQ. 2D0 ** N, 'gdprod')
      D(1) = MYNODE()
      CALL GDHIGH(D, 1, DW)
      CALL EXPECT(D(1) .EQ. N - 1, 'gdhigh')
      D(1) = -MYNODE()
      CALL GDLOW(D, 1, DW)
      CALL EXPECT(D(1) .EQ. 1 - N, 'gdlow')
      R(1) = MYNODE()
      CALL GSSUM(R, 1, RW)
      CALL EXPECT(R(1) .EQ. N * (N - 1) / 2, 'gssum')
      R(1) = 2
      CALL GSPROD(R, 1, RW)
      CALL EXPECT(R(1) .EQ. 2.0 ** N, 'gsprod')
      R(1) = MYNODE()
      CALL GSHIGH(R, 1, RW)
      CALL EXPECT(R(1) .EQ. N - 1, 'gshigh')
      R(1) = -MYNODE()
      CALL GSLOW(R, 1, RW)
      CALL EXPECT(R(1) .EQ. 1 - N, 'gslow')
      END

C     Neighbouring elements show whether each has four bytes.
      SUBROUTINE TINTS
      INCLUDE 'fcube.h'
      INTEGER I(3), W(3), N
      N = NUMNODES()
      I(1) = MYNODE()
      I(2) = -1
      I(3) = 2000000000
      CALL GISUM(I, 2, W)
      CALL EXPECT(I(1) .EQ. N * (N - 1) / 2 .AND. I(2) .EQ. -N .AND.
     1            I(3) .EQ. 2000000000, 'gisum')
      I(1) = -2
      CALL GIPROD(I, 1, W)
      CALL EXPECT(I(1) .EQ. (-2) ** N, 'giprod')
      I(1) = MYNODE() - 3
      CALL GIHIGH(I, 1, W)
      CALL EXPECT(I(1) .EQ. N - 4, 'gihigh')
      I(1) = MYNODE() - 3
      CALL GILOW(I, 1, W)
      CALL EXPECT(I(1) .EQ. -3, 'gilow')
      I(1) = -1 - 2 ** MYNODE()
      CALL GIAND(I, 1, W)
      CALL EXPECT(I(1) .EQ. -(2 ** N), 'giand')
      I(1) = 2 ** MYNODE()
      CALL GIOR(I, 1, W)
      CALL EXPECT(I(1) .EQ. 2 ** N - 1, 'gior')
      I(1) = 2 ** MYNODE() + 2 ** N
      CALL GIXOR(I, 1, W)
      CALL EXPECT(I(1) .EQ. 2 ** N - 1 + 2 ** N * MOD(N, 2), 'gixor')
      CALL TLOGIC(N)
      END

      SUBROUTINE TLOGIC(N)
      INCLUDE 'fcube.h'
      LOGICAL L(2), W(2)
      L(1) = .TRUE.
      L(2) = MYNODE() .NE. 0
      CALL GLAND(L, 2, W)
      CALL EXPECT(L(1) .AND. .NOT. L(2), 'gland')
      L(1) = .FALSE.
      L(2) = MYNODE() .EQ. 0
      CALL GLOR(L, 2, W)
      CALL EXPECT(.NOT. L(1) .AND. L(2), 'glor')
      L(1) = .TRUE.
      CALL GLXOR(L, 1, W)
      CALL EXPECT(L(1) .EQV. MOD(N, 2) .EQ. 1, 'glxor')
      END

C     The longer of two vectors.
      INTEGER FUNCTION LONGER(X, Y)
      REAL X(2), Y(2)
      LONGER = 0
      IF (X(1) ** 2 + X(2) ** 2 .GE. Y(1) ** 2 + Y(2) ** 2) RETURN
      X(1) = Y(1)
      X(2) = Y(2)
      END

      SUBROUTINE TCOLL
      INCLUDE 'fcube.h'
      EXTERNAL LONGER
      REAL X(2), WORK(2)
      INTEGER Y(100), LENGTHS(64), I, COUNT
      X(1) = MYNODE()
      X(2) = 1
      CALL GOPF(X, 8, WORK, LONGER)
      CALL EXPECT(X(1) .EQ. NUMNODES() - 1 .AND. X(2) .EQ. 1, 'gopf')
      CALL GCOL(MYNODE(), 4, Y, 400, COUNT)
      CALL EXPECT(COUNT .EQ. 4 * NUMNODES(), 'gcol''s length')
      DO 10 I = 1, NUMNODES()
         CALL EXPECT(Y(I) .EQ. I - 1, 'gcol')
         LENGTHS(I) = 4
   10 CONTINUE
      CALL GCOLX(10 * MYNODE(), LENGTHS, Y)
      DO 20 I = 1, NUMNODES()
         CALL EXPECT(Y(I) .EQ. 10 * (I - 1), 'gcolx')
   20 CONTINUE
      END

      SUBROUTINE TFILES
      INCLUDE 'fcube.h'
      CHARACTER*8 TEXT
      INTEGER PLACE(2), ID, DONE, N
      N = NUMNODES()
      OPEN (11, FILE = 'fortran_calls.out', FORM = 'UNFORMATTED',
     1      ACCESS = 'STREAM')
      CALL SETIOMODE(11, 3)
      CALL EXPECT(IOMODE(11) .EQ. 3, 'iomode')
      WRITE (TEXT, '(A4, I4)') 'node', MYNODE()
      CALL CWRITE(11, TEXT, 8)
      ID = IWRITE(11, TEXT, 8)
      CALL IOWAIT(ID)
      CALL GSYNC
      CALL EXPECT(ISEOF(11) .EQ. 1, 'iseof')
      CALL SETIOMODE(11, 0)
      PLACE(1) = 8 * (N + MOD(MYNODE() + 1, N))
      PLACE(2) = 0
      CALL ESEEK(11, PLACE, 0, PLACE)
      CALL EXPECT(PLACE(1) .EQ. 8 * (N + MOD(MYNODE() + 1, N)), 'eseek')
      ID = IREAD(11, TEXT, 8)
   10 DONE = IODONE(ID)
      IF (DONE .EQ. 0) GO TO 10
      READ (TEXT, '(4X, I4)') ID
      CALL EXPECT(ID .EQ. MOD(MYNODE() + 1, N), 'what was written')
      PLACE(1) = 0
      CALL ESEEK(11, PLACE, 0, PLACE)
      CALL CREAD(11, TEXT, 8)
      CALL EXPECT(TEXT .EQ. 'node   0', 'cread')
      CALL EXPECT(LSIZE(11, 0, 0) .EQ. 16 * N, 'lsize')
      CLOSE (11)
      CALL GSYNC
      END

C     What the Paragon added.
      SUBROUTINE XHANDL(TYPE, LENGTH, NODE, PTYPE, NUMBER)
      INTEGER TYPE, LENGTH, NODE, PTYPE, NUMBER
      COMMON /HANDLED/ NTIMES, NLAST(4)
      NTIMES = NTIMES + 1
      NLAST(1) = TYPE
      NLAST(2) = NUMBER
      END

      SUBROUTINE TPARAG
      INCLUDE 'fnx.h'
      EXTERNAL XHANDL
      COMMON /HANDLED/ NTIMES, NLAST(4)
      INTEGER INFO(8), FIRST(8), SECOND(8), GOT, OTHER, ME, BOTH
      INTEGER I, PLAIN, TOLD
      ME = MYNODE()
C     Of a type that its name does not imply.
      CALL EXPECT(GRAY(3) .EQ. 2, 'fnx.h')
      CALL CSEND(60, 5, 4, ME, 0)
      CALL CPROBEX(60, ME, 0, INFO)
      CALL EXPECT(INFO(1) .EQ. 60 .AND. INFO(2) .EQ. 4 .AND.
     1   INFO(3) .EQ. ME .AND. INFO(4) .EQ. 0, 'cprobex')
      CALL EXPECT(IPROBEX(61, ME, 0, INFO) .EQ. 0, 'iprobex')
      INFO(1) = 0
      CALL CRECVX(-1, GOT, 4, ME, 0, INFO)
      CALL EXPECT(GOT .EQ. 5 .AND. INFO(1) .EQ. 60, 'crecvx')
      CALL EXPECT(INFOPTYPE() .EQ. 0 .AND. MYPTYPE() .EQ. 0, 'ptypes')
      BOTH = MSGMERGE(IRECVX(62, GOT, 4, ME, -1, FIRST),
     1                IRECVX(63, OTHER, 4, ME, -1, SECOND))
      CALL CSEND(63, 7, 4, ME, 0)
      CALL CSEND(62, 6, 4, ME, 0)
      CALL MSGWAIT(BOTH)
      CALL EXPECT(GOT .EQ. 6 .AND. OTHER .EQ. 7, 'msgmerge')
      CALL EXPECT(FIRST(1) .EQ. 62 .AND. FIRST(2) .EQ. 4, 'irecvx')
      DO 10 I = 1, 2
         SECOND(1) = 0
         IF (I .EQ. 2) PLAIN = IRECV(66, GOT, 4)
         TOLD = IRECVX(67, OTHER, 4, ME, -1, SECOND)
         IF (I .EQ. 1) PLAIN = IRECV(66, GOT, 4)
         BOTH = MSGMERGE(PLAIN, TOLD)
         CALL CSEND(66, 6, 4, ME, 0)
         CALL CSEND(67, 7, 4, ME, 0)
         CALL MSGWAIT(BOTH)
         CALL EXPECT(SECOND(1) .EQ. 67, 'irecvx, merged with irecv')
   10 CONTINUE
      CALL MSGIGNORE(IRECVX(64, GOT, 4, ME, -1, INFO))
      NTIMES = 0
      CALL HRECVX(65, OTHER, 4, ME, 0, XHANDL, 1234)
      CALL HSENDX(65, 8, 4, ME, 0, XHANDL, 4321)
      CALL AWAIT(2)
      CALL EXPECT(OTHER .EQ. 8 .AND. (NLAST(2) .EQ. 1234 .OR.
     1   NLAST(2) .EQ. 4321), 'hrecvx, hsendx')
      CALL CSEND(64, 9, 4, ME, 0)
      CALL GSYNC
      END

      SUBROUTINE TSELF
      INCLUDE 'fcube.h'
      INTEGER TICKS(2), LATER
      DOUBLE PRECISION T
      CALL EXPECT(MYHOST() .NE. MYNODE(), 'myhost')
      CALL EXPECT(MYPID() .EQ. 0, 'mypid')
      CALL EXPECT(2 ** NODEDIM() .GE. NUMNODES(), 'nodedim')
      CALL EXPECT(GRAY(5) .EQ. 7 .AND. GINV(7) .EQ. 5, 'gray, ginv')
      T = DCLOCK()
      LATER = MCLOCK()
      CALL HWCLOCK(TICKS)
      CALL EXPECT(DCLOCK() .GE. T .AND. MCLOCK() - LATER .GE. 0,
     1            'clocks')
      CALL LED(1)
      CALL LED(0)
      END
