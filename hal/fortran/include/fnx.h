! What Fortran programs of the Paragon include: the same as fcube.h.
      INCLUDE 'fcube.h'
