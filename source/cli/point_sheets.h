// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/point.h>
#include <myolines/materials/tissue.h>
#include <myolines/muscle1d/hill_force.h>
#include <myolines/output/csv_file.h>
#include <myolines/study/picture.h>

namespace myolines
{
  /// The points of a range FROM TO POINTS. @throws InputError that names @p option if there are none, or not all above @p least.
  std::vector<double> spaced(const std::vector<double> &range, const std::string &option, double least);

  std::string label_of_activation(double activation);

  /// A table and the picture of its columns over the first one.
  class PointSheet
  {
  public:
    struct Names
    {
      std::filesystem::path folder;
      std::string           name; ///< of table and picture
      std::string           title, abscissa, ordinate;
      std::string           unit; ///< after the names of the columns
    };

    PointSheet(const Names &names, const std::vector<std::string> &columns);

    /// One value for each column.
    void row(double x, const std::vector<double> &values);

    /// Closes the table and returns its picture.
    const study::Picture &finish();

  private:
    CsvFile        csv_;
    study::Picture picture_;
  };

  /// The tables of the laws that are added to a tissue, and their pictures; a summary on @p out.
  struct LawSheets
  {
    std::string                name; ///< of the tissue
    const TissueParameters    &tissue;
    const curves::FibreCurves &curves;
  };
  std::vector<study::Picture> law_sheets(const LawSheets &sheets, const PointOptions &options, std::ostream &out);

  /// The tables of a one-dimensional muscle, and their pictures; a summary on @p out.
  std::vector<study::Picture> hill_sheets(const HillForce &force, const PointOptions &options, std::ostream &out);
} // namespace myolines
