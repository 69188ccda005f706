# SPDX-License-Identifier: LGPL-2.1-or-later
# Asks the GoogleTest program PROGRAM for its tests and writes the file OUTPUT for CTest, with one test per suite, or with WHOLE one of all: a
# process costs half a second of loading, so that cases share one. Each is named PREFIX.SUITE, or PREFIX; a table of its cases with their
# seconds goes to the folder RESULTS as JSON. COST tells CTest which to start first.
file(GLOB before ${RESULTS}/${PREFIX}.*.json)
if(before)
  file(REMOVE ${before}) # suites may have other names now
endif()
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed: ${failed}\n${listed}")
endif()
if(WHOLE)
  file(WRITE ${OUTPUT} "add_test([[${PREFIX}]] [[${PROGRAM}]] [[--gtest_output=json:${RESULTS}/${PREFIX}.all.json]])\n"
                       "set_tests_properties([[${PREFIX}]] PROPERTIES LABELS unit TIMEOUT 1200 COST ${COST})\n")
  return()
endif()
string(REPLACE "\n" ";" lines "${listed}")
set(text "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.( *#.*)?$") # cases are indented
    set(suite ${CMAKE_MATCH_1})
    string(REPLACE "/" "_" file ${suite})
    string(APPEND text "add_test([[${PREFIX}.${suite}]] [[${PROGRAM}]] [[--gtest_filter=${suite}.*]] [[--gtest_output=json:${RESULTS}/${PREFIX}.${file}.json]])\n"
                       "set_tests_properties([[${PREFIX}.${suite}]] PROPERTIES LABELS unit TIMEOUT 1200 COST ${COST})\n")
  endif()
endforeach()
file(WRITE ${OUTPUT} "${text}")
