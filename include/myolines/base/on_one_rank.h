// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace myolines
{
  /// An @p Error that other ranks do not know of and may wait behind: whoever gets it ends the whole job, with the code of the error.
  template <typename Error>
  class OnOneRank : public Error
  {
  public:
    using Error::Error;
  };
} // namespace myolines
