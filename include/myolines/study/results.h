// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/cases.h>
#include <myolines/study/database.h>
#include <myolines/study/measures.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myolines::study
{
  /// Of the runs of one case: greatest minus least [s]; no number of a single run.
  struct Spread
  {
    std::size_t                        runs = 1; ///< that are done
    std::optional<double>              cpu;      ///< of the CPU time [s]
    std::optional<double>              wall;     ///< of the wall-clock time [s]
    std::vector<std::optional<double>> values;   ///< of quantities that are seconds, in their order
  };

  /// What was found for one case.
  struct Row
  {
    const Case           *which = nullptr; ///< borrowed
    Outcome               outcome;         ///< of status "open" if the case has not ended; its seconds are medians of the repeats
    std::vector<Measured> values;          ///< of the quantities, in their order; none if the case is not done
    std::vector<Measured> rates;           ///< observed orders of the same, in a study of convergence
    std::string           stability;       ///< class, in a stability map
    Spread                spread;          ///< of the repeats
  };

  /// Measures all cases that are done, from their folders in @p study_folder; a row for each but repeats. @p cases outlives the rows.
  std::vector<Row> evaluate(const Study &study, const std::vector<Case> &cases, const std::map<std::string, Outcome> &outcomes,
                            const std::filesystem::path &study_folder);

  /// Note of a quantity that is not the same in all repeats.
  inline const std::string repeats_differ = "repeats differ";

  /// Makes one row of each point and its repeats: seconds become medians, with their spread. A quantity whose values differ has none, with
  /// a note; if one of the runs is not done, the case is not.
  void take_repeats_together(const Study &study, std::vector<Row> &rows);

  /// How the signal of a stability map behaves beside that of the reference.
  struct SignalMeasures
  {
    Measured overshoot;      ///< measure `overshoot`
    Measured late_overshoot; ///< measure `late overshoot`
    Measured variation;      ///< measure `relative variation`
  };
  /// The class of a run: "failed" if it did not end as "done"; "diverged" if its signal is not finite or its late overshoot is above
  /// the limit; "oscillating" if the overshoot at any time or the relative variation is above its limit; else "stable". "unknown" if
  /// there is no reference to judge by.
  std::string stability_class(const View &view, bool done, const SignalMeasures &signal);

  /// Rates log(e_1/e_2) / log(h_1/h_2) of errors between neighbouring sizes h; the coarsest has none. Cases belong
  /// together if they differ in no other axis.
  void add_rates(const Study &study, std::vector<Row> &rows);

  /// Cost of one method at the precision wanted.
  struct EqualError
  {
    std::string method;  ///< label of the curve
    Measured    work;    ///< in the unit of the work
    Measured    at_most; ///< a bound in its place, where all points of the method are more accurate than asked for
    Measured    ratio;   ///< over the cheapest; none where that is a bound
  };
  /// Least work of each curve at the target, on straight lines in logarithms between points that are neighbours along the other axis;
  /// where all points are more accurate, the least of theirs as a bound.
  std::vector<EqualError> equal_error(const Study &study, const std::vector<Row> &rows);

  /// "N" of a column "force [N]"; "" if there is none.
  std::string unit_in(const std::string &header);
  /// Header of a quantity, with its unit: "error in force [N]".
  std::string header_of(const Quantity &quantity);

  /// Writes study.csv, seconds.csv and, where a target is set, equal_error.csv to @p folder, and the table to @p database.
  /// Nothing in study.csv depends on the speed of the machine.
  void write_tables(const Study &study, const std::vector<Row> &rows, const std::filesystem::path &folder, Database &database);
} // namespace myolines::study
