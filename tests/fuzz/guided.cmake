# SPDX-License-Identifier: LGPL-2.1-or-later
# Readers of files under libFuzzer, on demand: see guided.py. Only the rooms that they need are compiled, each source by itself and without the
# precompiled header.
option(MYOLINES_GUIDED_FUZZING "a program for fuzzing led by coverage (clang)" OFF)
if(NOT MYOLINES_GUIDED_FUZZING)
  return()
endif()
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  message(FATAL_ERROR "MYOLINES_GUIDED_FUZZING: libFuzzer comes with clang, -DCMAKE_CXX_COMPILER=clang++-14")
endif()
set(guided_sources ${CMAKE_SOURCE_DIR}/source/algebra/shared_file.cc ${CMAKE_SOURCE_DIR}/source/system/archive.cc
                   ${CMAKE_SOURCE_DIR}/source/cli/prm_file.cc ${CMAKE_BINARY_DIR}/version.cc)
foreach(file checkpoint manifest output_folder text_file library_versions)
  list(APPEND guided_sources ${CMAKE_SOURCE_DIR}/source/output/${file}.cc)
endforeach()
foreach(room base scene meshes)
  get_target_property(sources myolines_${room} SOURCES)
  list(APPEND guided_sources ${sources})
endforeach()
list(FILTER guided_sources EXCLUDE REGEX base/lanes.cc$) # no reader needs it, and clang 14 knows fewer features of processors
# Whether an object has the type that it is used as is not looked at where the types of systems would have to be linked for it.
set_source_files_properties(${CMAKE_SOURCE_DIR}/source/output/checkpoint.cc PROPERTIES COMPILE_OPTIONS -fno-sanitize=vptr)
add_library(guided_readers STATIC ${guided_sources})
add_dependencies(guided_readers myolines_version)
add_executable(guided_seeds fuzz/guided_seeds.cc)
target_link_libraries(guided_seeds guided_readers)
add_executable(guided EXCLUDE_FROM_ALL fuzz/guided.cc)
target_link_libraries(guided guided_readers ZLIB::ZLIB)
target_link_options(guided PRIVATE -fsanitize=fuzzer)
add_dependencies(guided guided_seeds)
set(guided_options -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g1 -O1 -w
                   -include ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/lanes_of_clang.h) # warnings are told by the builds with GCC
foreach(target guided_readers guided_seeds guided)
  myolines_target(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/include)
  target_compile_options(${target} PRIVATE ${guided_options})
  target_link_options(${target} PRIVATE ${guided_options})
endforeach()
