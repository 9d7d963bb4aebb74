# libmars-nx-fortran: NX for Fortran programs, in front of libmars-nx. To build it takes no Fortran compiler.
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/libmars-nx-fortran.map CONTENT "{ global: [a-z]*_; local: *; };\n")
add_library(mars_nx_fortran SHARED
  nx/fortran_files.cpp nx/fortran_global.cpp nx/fortran_host.cpp nx/fortran_messages.cpp
  nx/fortran_paragon.cpp)
target_include_directories(mars_nx_fortran
  PRIVATE ${PROJECT_SOURCE_DIR}
  INTERFACE $<BUILD_INTERFACE:${CMAKE_CURRENT_LIST_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mars-nx-fortran>)
target_link_libraries(mars_nx_fortran PUBLIC mars_nx)
# Programs give one call buffers of many types, which gfortran takes for a mistake since version 10.
target_compile_options(mars_nx_fortran INTERFACE $<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-std=legacy>)
target_link_options(mars_nx_fortran PRIVATE
  -Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/libmars-nx-fortran.map -Wl,--no-undefined)
set_target_properties(mars_nx_fortran PROPERTIES
  OUTPUT_NAME mars-nx-fortran EXPORT_NAME nx-fortran VERSION ${PROJECT_VERSION} SOVERSION 0
  LINK_DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/libmars-nx-fortran.map
  INSTALL_RPATH $ORIGIN)
set_property(TARGET mars_nx_fortran PROPERTY HEADERS ${CMAKE_CURRENT_LIST_DIR}/fcube.h ${CMAKE_CURRENT_LIST_DIR}/fnx.h)
