// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/plot.h>
#include <myolines/study/study.h>

namespace myolines::study
{
  /// @throws InputError for axes and labels that @p study, whose grids are read, does not have.
  SeriesPicture read_series_picture(const scene::Node &node, const Study &study);

  /// The pictures of time series that the study asks for, of the cases in @p folder that are done.
  std::vector<Picture> series_pictures(const Study &study, const std::filesystem::path &folder);
} // namespace myolines::study
