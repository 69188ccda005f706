// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/command.h>
#include <myolines/report/command.h>
#include <myolines/study/plot.h>

#include <CLI/CLI.hpp>

namespace myolines
{
  // What `plot`, `picture` and `report` take on the command line.

  void add_plot_options(CLI::App &command, study::PlotOptions &options);
  void add_picture_options(CLI::App &command, picture::PictureOptions &options);
  void add_report_options(CLI::App &command, report::ReportOptions &options);
} // namespace myolines
