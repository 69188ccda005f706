// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace myolines::study
{
  /// A line or a row of marks in a diagram.
  struct Curve
  {
    std::string                            title;  ///< in the key
    std::vector<std::pair<double, double>> points; ///< those that are not finite are left out
  };

  /// A diagram.
  struct Picture
  {
    std::string                                 name;          ///< of its files, without extension
    std::string                                 title;         ///< above it
    std::string                                 x_label;       ///< with its unit
    std::string                                 y_label;       ///< with its unit
    bool                                        log_x = false; ///< whether the abscissa is logarithmic
    bool                                        log_y = false; ///< whether the ordinate is
    bool                                        lines = true;  ///< between the points
    bool                                        marks = true;  ///< at the points
    std::vector<Curve>                          curves;        ///< in the order of the key
    std::vector<std::pair<double, std::string>> x_words;       ///< words at places of the abscissa, instead of numbers
    std::vector<std::pair<double, std::string>> y_words;       ///< likewise of the ordinate
    /// If there are any, the picture has no curves of its own but these, in two columns under its title and with the key of the first:
    /// their curves have the same titles.
    std::vector<Picture> panels;
  };

  /// The commands for gnuplot that draw @p picture as NAME.png and NAME.svg in its folder, data included. Colours are those that
  /// every eye can tell apart (Okabe and Ito, 2008, https://jfly.uni-koeln.de/color/); marks and dashes tell curves apart on paper
  /// without colours.
  std::string gnuplot_script(const Picture &picture);

  /// Whether @p picture or one of its panels has a point that can be drawn: a finite one, positive along logarithmic axes.
  bool has_points(const Picture &picture);

  /// Writes NAME.gp, NAME.png and NAME.svg of each picture that has points to @p folder, which is made if need be; how many.
  /// @throws InputError if the folder cannot be written or there is no gnuplot, SystemError with its words if it fails.
  std::size_t draw(const std::vector<Picture> &pictures, const std::filesystem::path &folder);
} // namespace myolines::study
