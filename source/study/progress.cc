// SPDX-License-Identifier: LGPL-2.1-or-later
#include "progress.h"

#include <myolines/base/counted.h>
#include <myolines/output/status.h>
#include <myolines/output/text_file.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  Progress::Progress(const std::filesystem::path &folder, const std::size_t n, const std::size_t n_known, const unsigned int jobs,
                     std::ostream *terminal)
    : log_(folder / "study.log", File::Mode::append)
    , n_(n)
    , n_ended_(n_known)
    , jobs_(jobs)
    , terminal_(terminal)
  {
    say(counted(n, "case") + ", " + std::to_string(n_known) + " of them known; at most " + std::to_string(jobs) + " at a time");
  }

  /// From the mean time of the cases that ended now; those before may have run on another machine.
  std::string Progress::remaining() const
  {
    if (n_now_ == 0 || n_ended_ == n_)
      return "";
    const double mean = seconds_ / static_cast<double>(n_now_);
    return "  remaining " + duration_text(std::ceil(static_cast<double>(n_ - n_ended_) / jobs_) * mean);
  }

  void Progress::ended(const std::string &name, const std::string &how, const double wall_seconds)
  {
    ++n_ended_;
    ++n_now_;
    seconds_ += wall_seconds;
    const std::string count = std::to_string(n_ended_) + "/" + std::to_string(n_);
    say(count + "  " + name + "  " + how + "  " + duration_text(wall_seconds) + remaining());
    if (terminal_ == nullptr)
      return;
    std::string       text  = count + remaining() + "  " + name + "  " + how;
    const std::size_t width = text.size();
    text.resize(std::max(width, shown_width_), ' ');
    shown_width_ = width;
    *terminal_ << '\r' << text << std::flush;
  }

  void Progress::say(const std::string &line) { log_.write(iso8601_now() + "  " + line + "\n"); }

  void Progress::close()
  {
    if (terminal_ != nullptr && shown_width_ > 0)
      *terminal_ << std::endl;
  }
} // namespace myolines::study
