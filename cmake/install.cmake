# SPDX-License-Identifier: LGPL-2.1-or-later
# What `cmake --install` copies, and the Debian packages that `cpack` makes of it. Component runtime: program, library, manual page,
# completion, scenes, pages, licence. Component development: headers, package configuration, name of the library for linkers. Component
# python: the Python package.
include(CMakePackageConfigHelpers)

# One library of all rooms, with the symbols of our name space alone: what it has of templates of others stays inside. The program
# has the rooms inside and does not need it: it runs wherever it is copied to.
add_library(myolines_library SHARED)
foreach(room ${rooms})
  target_sources(myolines_library PRIVATE $<TARGET_OBJECTS:myolines_${room}>)
endforeach()
target_sources(myolines_library PRIVATE $<TARGET_OBJECTS:myolines_instruction_sets>)
myolines_target(myolines_library)
target_link_libraries(myolines_library ${MYOLINES_LIBRARIES_OF_OTHERS})
set(symbols ${CMAKE_CURRENT_LIST_DIR}/exported_symbols.map)
target_link_options(myolines_library PRIVATE -Wl,--version-script=${symbols})
set_target_properties(myolines_library PROPERTIES OUTPUT_NAME myolines LINK_DEPENDS ${symbols} LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

install(TARGETS myolines RUNTIME COMPONENT runtime)
install(TARGETS myolines_library LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/myolines DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  PATTERN pch.h EXCLUDE)

# The program prints its manual page and completion.
install(CODE "
  foreach(what manual completion)
    execute_process(COMMAND \"$<TARGET_FILE:myolines>\" \${what} OUTPUT_FILE \"${CMAKE_BINARY_DIR}/\${what}.txt\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()" COMPONENT runtime)
install(FILES ${CMAKE_BINARY_DIR}/manual.txt RENAME myolines.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
install(FILES ${CMAKE_BINARY_DIR}/completion.txt RENAME myolines DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT runtime)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/input DESTINATION ${CMAKE_INSTALL_DATADIR}/myolines COMPONENT runtime)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/doc DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime PATTERN check EXCLUDE)

# find_package(Myolines)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Myolines)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/MyolinesConfig.cmake.in ${CMAKE_BINARY_DIR}/MyolinesConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/MyolinesConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/MyolinesConfig.cmake ${CMAKE_BINARY_DIR}/MyolinesConfigVersion.cmake ${CMAKE_BINARY_DIR}/MyolinesHeaders.cmake
              ${CMAKE_CURRENT_LIST_DIR}/MyolinesPlugin.cmake ${CMAKE_CURRENT_LIST_DIR}/MyolinesSuite.cmake
              ${CMAKE_CURRENT_LIST_DIR}/plugin_source.cc.in ${CMAKE_CURRENT_LIST_DIR}/instruction_sets.cmake
  DESTINATION ${package_folder} COMPONENT development)

# The suite for methods of one's own, in the folders that its includes expect.
set(suite ${CMAKE_INSTALL_DATADIR}/myolines/suite)
foreach(file cases.h closed_forms.cc contract.cc error_control.cc exact.h experiment.h measured.h verification.cc)
  install(FILES ${CMAKE_SOURCE_DIR}/tests/integrators/${file} DESTINATION ${suite}/integrators COMPONENT development)
endforeach()
install(FILES ${CMAKE_SOURCE_DIR}/tests/support/drives.h ${CMAKE_SOURCE_DIR}/tests/support/solvers.h DESTINATION ${suite}/support
  COMPONENT development)
install(FILES ${CMAKE_SOURCE_DIR}/tests/test_main.cc DESTINATION ${suite} COMPONENT development)

if(MYOLINES_PYTHON)
  add_subdirectory(python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The Myolines developers")
set(CPACK_PACKAGE_CONTACT "The Myolines developers <maintainers@myolines.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "muscle dynamics by the method of lines")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Any time integrator runs any model: program, library, scenes and pages.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and CMake package of the library: systems and integrators of one's own.")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME myolines)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "openmpi-bin, gnuplot-nox | gnuplot, libopenblas0, libjs-three, libjs-chart.js")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmyolines-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libgtest-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "myolines (= ${PROJECT_VERSION}), libdeal.ii-dev, trilinos-all-dev, libsundials-dev, libopenmpi-dev")
if(MYOLINES_PYTHON)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The library from Python: scenes, runs, simulations to step, systems as operators, fits.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-myolines)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "myolines (= ${PROJECT_VERSION}), python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy, python3-scipy")
endif()
include(CPack)
