# Asks the GoogleTest program PROGRAM for its tests and writes the file OUTPUT for CTest, with one test per suite: a process costs half a
# second of loading, so that the cases of a suite share one. Each is named PREFIX.SUITE; a table of its cases with their seconds goes to the
# folder RESULTS as JSON. COST tells CTest which to start first.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed: ${failed}\n${listed}")
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
