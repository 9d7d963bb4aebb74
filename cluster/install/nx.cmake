# NX for other people's programs. Component mars-nx: the library and the program that starts them. Component
# mars-nx-dev: headers, files for pkg-config and CMake, a manual page for each call.
get_target_property(nx_headers mars_nx HEADERS)
install(TARGETS mars_nx EXPORT mars-nx
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mars-nx NAMELINK_COMPONENT mars-nx-dev)
install(TARGETS mars-nx RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mars-nx)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME mars-nx-dev)
install(FILES ${nx_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mars-nx)

# The same for Fortran: a library in front of that one, and the files that programs include.
get_target_property(fortran_headers mars_nx_fortran HEADERS)
install(TARGETS mars_nx_fortran EXPORT mars-nx
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mars-nx NAMELINK_COMPONENT mars-nx-dev)
install(FILES ${fortran_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mars-nx-fortran)

set(nx_package ${CMAKE_INSTALL_LIBDIR}/cmake/mars-nx)
install(EXPORT mars-nx NAMESPACE mars-nx:: FILE mars-nx-config.cmake DESTINATION ${nx_package})
include(CMakePackageConfigHelpers)
write_basic_package_version_file(mars-nx-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/mars-nx-config-version.cmake DESTINATION ${nx_package})

install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/nx/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/mars-nx/examples
        FILES_MATCHING PATTERN "*.[cfh]" PATTERN README.md)
foreach(package mars-nx mars-nx-dev)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
          COMPONENT ${package})
endforeach()

# The prefix is relative to the file, so an installation can be moved as a whole.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig
           OUTPUT_VARIABLE nx_prefix)
foreach(file mars-nx.pc mars-nx-fortran.pc)
  configure_file(${file}.in ${file} @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

# The manual: the pages here, filled in with the prototypes of the headers. A page that describes several calls is
# installed under the name of each call and of each twin.
find_program(AWK awk REQUIRED)
get_target_property(nx_calls mars_nx CALLS)
file(GLOB pages CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/man/nx/*)
set(filled "")
foreach(page IN LISTS pages)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  cmake_path(GET page FILENAME file)
  set(result ${CMAKE_CURRENT_BINARY_DIR}/${file}.gz)
  add_custom_command(OUTPUT ${result}
    COMMAND ${AWK} -f ${CMAKE_CURRENT_SOURCE_DIR}/man/nx_manual.awk ${nx_headers} ${page} > ${file}
    COMMAND ${GZIP} -9n < ${file} > ${result}
    DEPENDS ${nx_headers} ${page} man/nx_manual.awk
    VERBATIM)
  list(APPEND filled ${result})

  file(STRINGS ${page} names REGEX "^\\.Nm [a-z]")
  list(TRANSFORM names REPLACE "^\\.Nm ([a-z0-9_]+).*" "\\1")
  set(twins ${names})
  list(TRANSFORM twins PREPEND _)
  set(also "")
  foreach(name IN LISTS names twins)
    if(name IN_LIST nx_calls AND NOT file MATCHES "^${name}\\.")
      list(APPEND also ${name}.3nx.gz)
    endif()
  endforeach()
  string(REGEX REPLACE ".*\\.([0-9]).*" "\\1" section ${file})
  install_as(${result} ${CMAKE_INSTALL_MANDIR}/man${section} ${also})
endforeach()
add_custom_target(nx_manual ALL DEPENDS ${filled})

# Everything that the two components install.
add_custom_target(nx DEPENDS mars-nx mars_nx mars_nx_fortran nx_manual)
if(TARGET nx_option_list)
  add_dependencies(nx nx_option_list)
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME mars)
