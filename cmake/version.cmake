# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes OUTPUT, a C++ source that holds VERSION and the git hash of SOURCE, and leaves it alone where it is right already.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty
                OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(text "#include <myolines/output/version.h>

namespace myolines
{
  const char *const version  = \"${VERSION}\";
  const char *const git_hash = \"${hash}\";
} // namespace myolines
")
set(before "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${OUTPUT} "${text}")
endif()
