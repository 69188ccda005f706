// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "verified_quantity.h"

#include <myolines/study/cases.h>
#include <myolines/study/database.h>
#include <myolines/study/discretisation_error.h>
#include <myolines/study/verify.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// One run of a verification. The first of a list is that of the scene as it stands.
  struct VerifyRun
  {
    enum class Part
    {
      scene,
      steps,
      mesh,
      degree,
      method,
      least_damping
    };
    Case    which;
    Part    part;
    Rung    rung;
    Outcome outcome; ///< of status "open" until it has ended

    bool done() const { return outcome.status == "done"; }
  };

  /// What one ladder says of a quantity.
  struct LadderError
  {
    const Ladder                      *ladder;
    std::vector<const VerifyRun *>     runs; ///< that are done, from coarse to fine
    std::vector<double>                values;
    std::optional<DiscretisationError> error; ///< of the scene; none of less than two runs

    /// What halving the error takes, and the CPU seconds of the scene then, by the growth from run to run.
    struct Halving
    {
      std::string           setting;
      std::optional<double> cpu_seconds;
    };
    /// None where there is no rate.
    std::optional<Halving> halving(const VerifyRun &scene) const;
  };

  /// What was found for one quantity.
  struct VerifiedValue
  {
    VerifiedQuantity quantity;
    std::string      header; ///< of the column
    double           value;  ///< of the scene as it stands
    LadderError      steps, mesh;

    std::optional<double> other_degree; ///< value with elements of the other degree
    std::optional<double> other_method; ///< value by the method of higher order
    std::optional<double> least_damped; ///< value by the method that damps least, with the shortest steps
    std::optional<double> vibration;    ///< amplitude there, beside the method of the scene with these steps
    std::optional<double> mesh_error;   ///< that of the mesh; not less than the distance from the value of a higher degree
    /// That of the steps; not less than the distance from the values by other methods, nor than the error that vibrations make.
    std::optional<double> steps_error;
  };

  /// From the folders of the runs that are done, of which the first is one. @throws InputError if they do not have the quantity.
  VerifiedValue verified_value(const VerifiedQuantity &quantity, const std::vector<VerifyRun> &runs, const Refinements &refinements,
                               const std::filesystem::path &folder);

  /// Of the run of the scene, as its manifest has them [J]; none if the system states no energy.
  struct EnergyDrift
  {
    double drift, exchanged;
  };
  std::optional<EnergyDrift> energy_drift(const VerifyRun &scene);

  /// The report, for people.
  std::string report_text(const std::vector<VerifiedValue> &values, const std::vector<VerifyRun> &runs, const Refinements &refinements);

  /// verify.csv and runs.csv in @p folder.
  void write_verify_tables(const std::vector<VerifiedValue> &values, const std::vector<VerifyRun> &runs,
                           const std::filesystem::path &folder);
} // namespace myolines::study
