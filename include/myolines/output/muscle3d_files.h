// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/muscle3d_sample.h>
#include <myolines/output/output_folder.h>
#include <myolines/time/energy_balance.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// One time series of a muscle run.
  class SeriesFile
  {
  public:
    virtual ~SeriesFile() = default;

    virtual void row(const Muscle3dSample &sample, std::size_t step) = 0;

    /// As Observer::save().
    virtual void save(Archive &) const {}
  };

  /// A file whose row is a function of the sample alone.
  std::unique_ptr<SeriesFile> make_series_file(const OutputFolder &folder, const std::string &name, const std::vector<std::string> &columns,
                                               std::function<std::vector<double>(const Muscle3dSample &)> values);

  // The peer's files, with its names and columns.
  std::unique_ptr<SeriesFile> force_file(const OutputFolder &folder, const Muscle3dSystem &system, unsigned int face);
  std::unique_ptr<SeriesFile> all_faces_files(const OutputFolder &folder, const Muscle3dParameters &parameters);
  std::unique_ptr<SeriesFile> energy_file(const OutputFolder &folder, const Muscle3dParameters &parameters);
  std::unique_ptr<SeriesFile> stretch_file(const OutputFolder &folder);
  std::unique_ptr<SeriesFile> gearing_info_file(const OutputFolder &folder, const Muscle3dSystem &system);
  std::unique_ptr<SeriesFile> activation_file(const OutputFolder &folder, const Muscle3dSystem &system);
  std::unique_ptr<SeriesFile> displacements_file(const OutputFolder &folder, std::shared_ptr<const MarkerProbe> probe);

  // Ours.

  /// shape.csv: width and thickness of the middle, length, volume over that at rest. @p thickness: its unit vector, as measure_middle().
  std::unique_ptr<SeriesFile> shape_file(const OutputFolder &folder, const Muscle3dSystem &system, const dealii::Tensor<1, 3> &thickness);

  /// reaction.csv: per prescribing condition the force with which it pulls on the muscle, and at the end of the row the parts of these
  /// forces along the line of action, where there is one.
  std::unique_ptr<SeriesFile> reaction_file(const OutputFolder &folder, const Muscle3dSystem &system);

  /// fascicles.csv: mean, least and greatest length of Fascicles, means of their stretch, velocity and curvature and, where there is a line
  /// of action, of their angle to it.
  std::unique_ptr<SeriesFile> momenta_file(const OutputFolder &folder);
  std::unique_ptr<SeriesFile> fascicles_file(const OutputFolder &folder, const Muscle3dSystem &system, unsigned int number);

  /// energy_balance.csv: energies, and works and drift as @p balance has them when a row is written; borrowed.
  std::unique_ptr<SeriesFile> energy_balance_file(const OutputFolder &folder, const Muscle3dParameters &parameters,
                                                  const EnergyBalance &balance);

  /// gearing.csv: G = -|mean muscle velocity| / (L_f0 e0 mean fibre strain rate), thesis (7.2.13), at every row, with L_f0 of
  /// reference_fibre_length(); empty while fibres are at rest. Physiological: 1 unless fibres change length faster than their maximum strain rate, 0 then.
  std::unique_ptr<SeriesFile> gearing_file(const OutputFolder &folder, const Muscle3dSystem &system);

  /// strain.csv: strain and strain rate along the line of action of the parts of the body up to p L, from the displacements and velocities
  /// of points of the line between the centres of the faces at its ends, which are L apart; @p places p in (0, 1].
  std::unique_ptr<SeriesFile> strain_file(const OutputFolder &folder, const Muscle3dSystem &system, const std::vector<double> &places);

} // namespace myolines
