# Has every compilation, link and test recorded (record, costs.py). CMake reads this file at the end of project(), as
# -DCMAKE_PROJECT_INCLUDE names it.
set(log ${PROJECT_BINARY_DIR}/costs.log)
set(MARS_TEST_RECORDER ${CMAKE_CURRENT_LIST_DIR}/record ${log} test)
set_property(GLOBAL PROPERTY RULE_LAUNCH_COMPILE "${CMAKE_CURRENT_LIST_DIR}/record ${log} compile <TARGET_NAME>")
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_CURRENT_LIST_DIR}/record ${log} link <TARGET_NAME>")
