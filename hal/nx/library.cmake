# libmars-nx: NX as a library for others, in C and C++. It exports what its headers declare and nothing else.
file(GLOB nx_headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/nx_*.h)
foreach(umbrella cube mesh nx)
  list(APPEND nx_headers ${CMAKE_CURRENT_LIST_DIR}/${umbrella}.h)
endforeach()

set(nx_calls "")
set(nx_variables "")
foreach(header IN LISTS nx_headers)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  file(READ ${header} text)
  string(REGEX MATCHALL "\n[a-z][a-z_ *]*[ *][a-z0-9_]+\\(" declarations "${text}")
  list(TRANSFORM declarations REPLACE ".*[ *]([a-z0-9_]+)\\(" "\\1")
  list(APPEND nx_calls ${declarations})
  string(REGEX MATCHALL "\nextern [a-z][a-z_ *]*[ *][a-z0-9_]+" variables "${text}")
  list(TRANSFORM variables REPLACE ".*[ *]" "")
  list(APPEND nx_variables ${variables})
endforeach()
list(JOIN nx_calls "; " names)
list(JOIN nx_variables "; " variables)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/libmars-nx.map CONTENT "{ global: @names@; @variables@; local: *; };\n" @ONLY)

# Its parts can be in a shared library, and lose nothing by it.
foreach(part IN LISTS parts_of_nx)
  set_target_properties(${part} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${part} PRIVATE -fno-semantic-interposition -ftls-model=initial-exec)
endforeach()

# A program's own functions may have names of NX (load, gray): calls within the library stay within.
add_library(mars_nx SHARED ${CMAKE_CURRENT_LIST_DIR}/program.cpp ${CMAKE_CURRENT_LIST_DIR}/host_calls.cpp $<TARGET_OBJECTS:mars_hal>)
target_include_directories(mars_nx PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(mars_nx PRIVATE ${parts_of_nx})
target_link_options(mars_nx PRIVATE
  -Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/libmars-nx.map -Wl,-Bsymbolic-functions -Wl,--no-undefined)
if(MARS_HAVE_MPI)
  target_compile_definitions(mars_nx PRIVATE MARS_NX_MPI)
endif()
set_target_properties(mars_nx PROPERTIES
  OUTPUT_NAME mars-nx EXPORT_NAME nx VERSION ${PROJECT_VERSION} SOVERSION 0
  LINK_DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/libmars-nx.map)
target_include_directories(mars_nx INTERFACE
  $<BUILD_INTERFACE:${CMAKE_CURRENT_LIST_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mars-nx>)
set_target_properties(mars_nx PROPERTIES HEADERS "${nx_headers}" CALLS "${nx_calls}")
