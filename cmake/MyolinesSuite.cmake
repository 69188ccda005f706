# SPDX-License-Identifier: LGPL-2.1-or-later
# myolines_add_integrator_suite(PROGRAM METHODS...): the program of GoogleTest, and a test of CTest of the same name, that puts methods
# through the suite that those in the library pass. METHOD.cc defines METHOD_entry(), case_METHOD.cc defines METHOD_cases(): what theory says of
# it, as the installed file integrators/cases.h of the suite explains.
function(myolines_add_integrator_suite program)
  find_package(GTest REQUIRED)
  set(suite ${MYOLINES_SUITE})
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_list.def)
  set(lines "")
  set(sources "")
  foreach(method IN LISTS ARGN)
    string(APPEND lines "MYOLINES_INTEGRATOR(${method})\n")
    list(APPEND sources ${method}.cc case_${method}.cc)
  endforeach()
  file(CONFIGURE OUTPUT ${list} CONTENT "${lines}" @ONLY)
  file(GLOB tests ${suite}/integrators/*.cc)
  add_executable(${program} ${sources} ${tests} ${suite}/test_main.cc)
  target_include_directories(${program} PRIVATE ${suite}/integrators)
  target_compile_definitions(${program} PRIVATE MYOLINES_SUITE_LIST="${list}")
  target_link_libraries(${program} PRIVATE Myolines::myolines GTest::gtest)
  add_test(NAME ${program} COMMAND ${program})
endfunction()
