// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/registry.h>
#include <myolines/measures/fascicles.h>
#include <myolines/observers/muscle3d_sample.h>
#include <myolines/output/csv_file.h>
#include <myolines/scene/scene.h>
#include <myolines/time/energy_balance.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// One time series of a run of the 3D muscle: the files that it writes, and what it must follow between their rows.
  class SeriesFile
  {
  public:
    virtual ~SeriesFile() = default;

    virtual void row(const Muscle3dSample &sample, std::size_t step) = 0; ///< writes a row; @p step: accepted steps so far

    virtual void pass(const Muscle3dSample &) {}       ///< after an accepted step without a row
    virtual void restarting(const Muscle3dSample &) {} ///< as Observer::restarting()
    virtual void restarted(const Muscle3dSample &) {}  ///< as Observer::restarted()

    /// As those of Observer.
    virtual const EnergyBalance *energy_balance() const { return nullptr; }
    virtual void                 save(Archive &) const {} ///< As Observer::save().
  };

  /// A file whose row is a function of the sample alone.
  std::unique_ptr<SeriesFile> make_series_file(const OutputFolder &folder, const TableName &name, const std::vector<std::string> &columns,
                                               std::function<std::vector<double>(const Muscle3dSample &)> values);

  /// What the making of a series may look at.
  struct SeriesContext
  {
    const scene::Node          &series;     ///< the list `output/series`
    const Muscle3dSystem       &system;     ///< that of the run
    const OutputFolder         &folder;     ///< that files go to
    const ReferenceFibre       &fibre;      ///< L_f0
    std::optional<unsigned int> force_face; ///< whose force is reported; there is one where there is a line of action
  };

  /// What a series must have of a body. One that is on by default is left out where the body lacks it; where it is asked for that is an
  /// error.
  enum class SeriesNeeds
  {
    nothing,            ///< fits every body
    velocities,         ///< a dynamic system
    line,               ///< a line of action
    velocities_and_line ///< both
  };

  /// A series: what its file in `outputs/` gives to the list of all.
  struct SeriesEntry
  {
    std::string name;       ///< of the parameter that asks for it
    bool        default_on; ///< asked for unless the scene says no
    SeriesNeeds needs;      ///< of the body

    std::function<void(scene::Schema &)>                              declare; ///< that parameter, and others of its own
    std::function<bool(const scene::Node &)>                          wanted;  ///< whether the list `output/series` asks for it
    std::function<std::unique_ptr<SeriesFile>(const SeriesContext &)> make;    ///< nullptr: there is nothing to write
  };

  /// An entry whose parameter is a switch, @p doc its declaration: "shape.csv: ...".
  SeriesEntry switched_series(const std::string &name, bool default_on, SeriesNeeds needs, const std::string &doc,
                              std::function<std::unique_ptr<SeriesFile>(const SeriesContext &)> make);

  inline const std::string &name_of(const SeriesEntry &entry) { return entry.name; } ///< For Registry.

  /// All series, in the order of `outputs/list.def`, then those of plug-ins.
  Registry<SeriesEntry> &series_registry();

  /// The files that a scene asks for. @throws InputError
  std::vector<std::unique_ptr<SeriesFile>> make_series(const SeriesContext &context);
} // namespace myolines
