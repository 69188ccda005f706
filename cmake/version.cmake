# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes OUTPUT, a C++ source that holds VERSION, the git hash of SOURCE and a checksum of its headers, and HEADERS, a CMake file with that
# checksum. Leaves alone what is right already.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty
                OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(GLOB_RECURSE headers RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h)
list(SORT headers)
set(sums "")
foreach(header IN LISTS headers)
  file(SHA256 ${SOURCE}/include/${header} sum)
  string(APPEND sums "${header} ${sum}\n")
endforeach()
string(SHA256 checksum "${sums}")
string(SUBSTRING ${checksum} 0 12 checksum)

function(write_if_other file text)
  set(before "")
  if(EXISTS ${file})
    file(READ ${file} before)
  endif()
  if(NOT text STREQUAL before)
    file(WRITE ${file} "${text}")
  endif()
endfunction()

write_if_other(${HEADERS} "set(MYOLINES_HEADERS ${checksum}) # of the installed headers\n")
write_if_other(${OUTPUT} "#include <myolines/output/build_facts.h>
#include <myolines/output/version.h>

namespace myolines
{
  const char *const version     = \"${VERSION}\";
  const char *const git_hash    = \"${hash}\";
  const char *const build_facts = MYOLINES_BUILD_FACTS(\"${VERSION}\", \"${checksum}\");
} // namespace myolines
")
