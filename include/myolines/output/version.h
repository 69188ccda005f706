#pragma once

namespace myolines
{
  extern const char *const version;  ///< of the program
  extern const char *const git_hash; ///< of the sources, with "-dirty" if they differ from it; "" if they are in no repository
} // namespace myolines
