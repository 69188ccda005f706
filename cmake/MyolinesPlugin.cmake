# SPDX-License-Identifier: LGPL-2.1-or-later
# myolines_add_plugin(NAME FILES...): the plug-in NAME.so of sources like those that are built in. Each thing that they bring is a function
# without arguments that returns an entry, `IntegratorEntry houbolt_entry()`; they are found in the sources by this form.
# NAME has small letters, digits and hyphens. `cmake --install` puts the plug-in where the program looks for it, if the prefix is the same.
set(MYOLINES_PLUGIN_SOURCE ${CMAKE_CURRENT_LIST_DIR}/plugin_source.cc.in)

function(myolines_add_plugin name)
  if(NOT name MATCHES "^[a-z0-9][a-z0-9-]*$")
    message(FATAL_ERROR "myolines_add_plugin: \"${name}\" is no name of a plug-in: small letters, digits and hyphens")
  endif()
  set(declarations "")
  set(additions "")
  foreach(file IN LISTS ARGN)
    get_filename_component(file ${file} ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${file} heads REGEX "^ *[A-Za-z0-9]+Entry +[a-z0-9_]+\\(\\)$")
    foreach(head IN LISTS heads)
      string(STRIP "${head}" head)
      string(REGEX REPLACE "^.* " "" call "${head}")
      string(APPEND declarations "  ${head};\n")
      string(APPEND additions "  entries.add(myolines::${call});\n")
    endforeach()
  endforeach()
  if(additions STREQUAL "")
    message(FATAL_ERROR "myolines_add_plugin(${name}): no source has a line like \"IntegratorEntry my_method_entry()\"")
  endif()
  configure_file(${MYOLINES_PLUGIN_SOURCE} ${CMAKE_CURRENT_BINARY_DIR}/${name}_plugin.cc @ONLY)
  add_library(${name} MODULE ${ARGN} ${CMAKE_CURRENT_BINARY_DIR}/${name}_plugin.cc)
  # What it needs of Myolines is in the program that loads it.
  target_link_libraries(${name} PRIVATE Myolines::headers)
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  install(TARGETS ${name} LIBRARY DESTINATION ${MYOLINES_PLUGIN_FOLDER})
endfunction()
