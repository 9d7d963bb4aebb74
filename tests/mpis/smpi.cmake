# Programs of simulated ranks are libraries that smpirun loads: cluster/platforms/simulate starts them.
foreach(program rules times)
  add_library(smpi_${program} MODULE smpi_${program}.cpp)
  target_link_libraries(smpi_${program} PRIVATE mars_nx_calls mars_hal_smpi)
  target_link_options(smpi_${program} PRIVATE -Wl,--no-undefined)
endforeach()
target_link_libraries(smpi_rules PRIVATE mars_nx_rules)
target_sources(smpi_times PRIVATE times.cpp)
mars_program(simulated_times simulated_times.cpp LINKS mars_nx_calls mars_hal_simulated)
target_sources(simulated_times PRIVATE times.cpp)

mars_put_off(smpi_rules smpi_times simulated_times)

mars_add_script(smpi_test smpi_test.py ${PROJECT_SOURCE_DIR}/cluster/platforms/simulate $<TARGET_FILE:smpi_rules>
  $<TARGET_FILE:smpi_times> $<TARGET_FILE:simulated_times>)
