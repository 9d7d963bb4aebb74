# Programs of simulated ranks are libraries that smpirun loads.
add_library(smpi_rules MODULE smpi_rules.cpp)
target_link_libraries(smpi_rules PRIVATE mars_nx_rules mars_hal_smpi)
target_link_options(smpi_rules PRIVATE -Wl,--no-undefined)
