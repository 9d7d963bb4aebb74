# NX for other people's programs: the library, and apart from it what building such programs needs: headers,
# and how pkg-config and CMake find it.
get_target_property(nx_headers mars_nx HEADERS)
install(TARGETS mars_nx EXPORT mars-nx
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mars-nx NAMELINK_COMPONENT mars-nx-dev)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME mars-nx-dev)
install(FILES ${nx_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mars-nx)

set(nx_package ${CMAKE_INSTALL_LIBDIR}/cmake/mars-nx)
install(EXPORT mars-nx NAMESPACE mars-nx:: FILE mars-nx-config.cmake DESTINATION ${nx_package})
include(CMakePackageConfigHelpers)
write_basic_package_version_file(mars-nx-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/mars-nx-config-version.cmake DESTINATION ${nx_package})

# The prefix from where the file is: an installation can be moved as a whole.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig
           OUTPUT_VARIABLE nx_prefix)
configure_file(mars-nx.pc.in mars-nx.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/mars-nx.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME mars)
