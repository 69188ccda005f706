// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/sampled.h>
#include <myolines/system/samples.h>

#include <memory>
#include <optional>
#include <string>

namespace myolines
{
  /// What a drive is a function of time of.
  struct Driven
  {
    std::string  quantity = "quantity";          ///< for messages: "activation"
    std::string  unit     = "-";                 ///< "-" for pure numbers
    scene::Range range    = scene::Range::any(); ///< of samples; closed: no smoothing leaves it
  };

  /// What becomes of the samples in a file, in this order.
  struct FileProfile
  {
    std::string           where;                         ///< "scene.xml: system/excitation/file", for messages
    SampleColumn          column;                        ///< where the samples stand
    double                shift          = 0;            ///< is added to times [s]
    bool                  rectify        = false;        ///< x becomes |x - mean|
    std::optional<double> low_pass       = std::nullopt; ///< cut-off frequency [Hz]
    bool                  by_own_maximum = false;        ///< x is divided by the greatest |x| of the samples
    std::optional<double> maximum        = std::nullopt; ///< x is divided by it, or by its own
    double                scale          = 1;            ///< x is multiplied by it, last
    bool                  lines          = false;        ///< between the samples; else smooth
  };

  /// A quantity whose samples stand in a file, low-passed by spline_filtered(), with the spline between them. Where both ends of
  /// Driven::range are finite nothing leaves it: filtered values are cut off at the least and the greatest sample, values that miss the
  /// range by 1e-6 of its width become its ends, and where the spline would leave it, the monotone cubic takes its place.
  class FileDrive : public SampledDrive
  {
  public:
    /// @throws InputError for what read_samples() refuses, values outside the range, and lines that are to be smooth.
    FileDrive(const FileProfile &profile, const Driven &driven);

    /// @throws InputError with the times of both unless there are samples from @p start to @p end [s].
    void require(double start, double end) const;

    /// What has been cut off, where that is more than 1e-3 of the range, a sentence; else "".
    const std::string &note() const { return note_; }

    /// A sentence where a run from @p start to @p end [s] sees so little of the samples that their times may be in another unit; else "".
    std::string note_of_times(double start, double end) const;

  private:
    struct Made;
    FileDrive(const FileProfile &profile, const Driven &driven, const Made &made);

    std::string where_, file_, note_;
  };

  /// The file that @p drive, or the excitation that it follows from, is read from; nullptr: it is none, or from no file.
  const FileDrive *file_of(const Drive *drive);

  /// Parameters of the alternative `file` of a drive in @p unit.
  scene::Schema file_profile_schema(const std::string &unit);
  /// The drive that the list @p node describes. @throws InputError as FileDrive.
  std::unique_ptr<FileDrive> make_file_drive(const scene::Node &node, const Driven &driven);

  /// The drive a scene describes, of a quantity whose unit and range matter for samples. @throws InputError as make_drive() of a node
  /// alone, which stands for a number without bounds.
  std::unique_ptr<Drive> make_drive(const scene::Node &node, const Driven &driven);
} // namespace myolines
