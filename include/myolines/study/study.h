// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// One value of an axis: what it is called and the parameters that it sets ("time/step=0.01").
  struct AxisPoint
  {
    std::string              label;    ///< in names of cases
    std::vector<std::string> settings; ///< "path=value"
    std::optional<double>    number;   ///< the value, where it is one
  };

  /// Parameters that go through several values together.
  struct Axis
  {
    std::string            name;        ///< in names of cases, and for the view
    std::string            unit;        ///< for pictures; "" for none
    std::string            zipped_with; ///< an earlier axis of the grid that this one goes along with; "" if it is crossed with all
    std::vector<AxisPoint> points;      ///< in the order of the file
  };

  /// Axes that are crossed (or zipped) with each other. A study is the union of its grids.
  struct Grid
  {
    std::string       name; ///< in the file
    std::vector<Axis> axes; ///< the last one runs fastest
  };

  /// A finer run that cases are measured against: the base scene, the settings of the study, those of all coordinates of the
  /// case but the axes replaced, then its own.
  struct Reference
  {
    std::vector<std::string> settings;   ///< of the reference alone, "path=value"
    std::vector<std::string> instead_of; ///< names of axes
  };

  /// A number that a case is asked for.
  struct Quantity
  {
    /// Where the number comes from.
    enum class Source
    {
      column, ///< measure of a column of a CSV file
      state,  ///< relative l2 difference of all unknowns at the end from the reference
      field,  ///< relative L2 difference of a field at the end from the reference, on any meshes
      count,  ///< of ledger.json
      seconds ///< of ledger.json
    };
    std::string                          name;                    ///< header of its column in study.csv
    Source                               source = Source::column; ///< where it comes from
    std::string                          file;                    ///< of a column: the CSV file
    std::string                          column;                  ///< its header
    std::string                          measure;                 ///< one of measure_names()
    std::string                          formula;                 ///< instead of the column, in the names of @p columns and t; "" for none
    std::map<std::string, std::string>   columns;                 ///< name in the formula -> header
    std::string                          unit;                    ///< of the formula
    bool                                 relative = false;        ///< errors over the largest size of the reference
    double                               fraction = 0;            ///< of the decay time
    std::optional<double>                from;                    ///< only rows from then on [s]
    std::optional<double>                until;                   ///< only rows up to then [s]
    std::optional<std::filesystem::path> reference_file;          ///< CSV file instead of a reference run
    std::optional<std::string>           reference_formula;       ///< in t
    std::string                          key;                     ///< of the ledger, or the name of the field or state

    /// Needs something to be compared with.
    bool is_error() const;
  };

  /// A picture of time series: a panel for each column, in each a curve for each case.
  struct SeriesPicture
  {
    std::string                                     name;                ///< of the files
    std::string                                     file;                ///< CSV file of the runs
    std::vector<std::string>                        columns;             ///< headers
    std::string                                     over;                ///< header of the abscissa; "" for the first column
    std::map<std::string, std::vector<std::string>> of;                  ///< axis -> the labels wanted; all of other axes
    bool                                            logarithmic = false; ///< axis of the values
    std::optional<double>                           from;                ///< only rows from then on [s]
    std::optional<double>                           until;               ///< only rows up to then [s]
  };

  /// What a study is about.
  enum class Kind
  {
    sweep,          ///< quantities over parameters
    work_precision, ///< cost against error
    convergence,    ///< observed orders
    stability_map   ///< how a signal behaves over two parameters
  };

  /// What the table and the pictures of the study's kind need; names of axes and quantities.
  struct View
  {
    Kind                     kind = Kind::sweep; ///< of the study
    std::string              curves;             ///< axis: one curve for each of its points; "" for none
    std::string              abscissa;           ///< axis; of a convergence the sizes of steps; "" for the first with numbers
    std::string              ordinate;           ///< axis of a stability map
    std::vector<std::string> together;           ///< quantities that share a picture
    std::string              precision;          ///< quantity
    std::string              work;               ///< quantity, or "CPU seconds"
    std::optional<double>    target;             ///< of the precision, at which methods are compared
    std::string              file;               ///< with the signal whose class is told
    std::string              column;             ///< header of that signal
    double                   overshoot = 0;      ///< limit of the overshoot
    double                   variation = 0;      ///< limit of the relative variation
  };

  /// A study as its file describes it, consistent.
  struct Study
  {
    std::string                title;           ///< for pictures
    std::filesystem::path      scene;           ///< the base
    std::vector<std::string>   settings;        ///< of all cases, "path=value"
    bool                       resumes = false; ///< interrupted cases go on from their checkpoints
    unsigned int               ranks   = 1;     ///< MPI ranks of each run
    unsigned int               repeats = 1;     ///< runs of each case, whose seconds are told as median and spread
    double                     case_seconds;    ///< time-out of a case [s]
    double                     total_seconds;   ///< budget of the study [s]
    std::vector<Grid>          grids;           ///< their union is the study
    std::optional<Reference>   reference;       ///< none: nothing is compared
    std::optional<Reference>   cross_check;     ///< of the reference; none: it is taken as it is
    std::vector<Quantity>      quantities;      ///< columns of study.csv
    View                       view;            ///< table and pictures of the kind
    std::vector<SeriesPicture> pictures;        ///< further ones

    /// Names of all axes, in order of their first appearance.
    std::vector<std::string> axis_names() const;
    /// The first axis of that name. @throws std::out_of_range.
    const Axis &axis(const std::string &name) const;
    /// @p name and the axes that are zipped with it, in some grid.
    std::vector<std::string> axes_along(const std::string &name) const;
  };

  /// Declaration of study files.
  scene::Schema study_schema();

  /// The document in @p file. @throws InputError.
  scene::Node read_study_file(const std::filesystem::path &file, const std::vector<std::string> &overrides = {});

  /// What a validated document means. @throws InputError for what no range can express.
  Study read_study(const scene::Node &node);

  /// "a | b" -> {"a", "b"}; blanks around are dropped, empty parts too.
  std::vector<std::string> split(const std::string &text);
} // namespace myolines::study
