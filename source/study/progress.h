// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/files.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace myolines::study
{
  /// Tells how far the cases are: a line for each in study.log, and one line on a terminal that is overwritten.
  class Progress
  {
  public:
    /// @p n cases in all, @p n_known of which had ended before. @throws SystemError if the log cannot be written.
    Progress(const std::filesystem::path &folder, std::size_t n, std::size_t n_known, unsigned int jobs, std::ostream *terminal);

    void ended(const std::string &name, const std::string &how, double wall_seconds);
    void say(const std::string &line);
    void close();

  private:
    std::string remaining() const;

    File          log_;
    std::size_t   n_, n_ended_, n_now_ = 0;
    unsigned int  jobs_;
    double        seconds_ = 0; ///< of all cases that ended now
    std::ostream *terminal_;
    std::size_t   shown_width_ = 0;
  };
} // namespace myolines::study
