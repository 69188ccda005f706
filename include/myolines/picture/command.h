// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::picture
{
  /// What `picture` is asked for.
  struct PictureOptions
  {
    std::vector<std::filesystem::path> folders;        ///< output folders of runs
    std::filesystem::path              out;            ///< empty: pictures/ in the folder, or here if there are several
    std::string                        field;          ///< empty: first_field()
    std::vector<double>                at;             ///< times [s]; none: the first and the last, or the last alone of several runs
    bool                               frames = false; ///< all times, one picture each, and an animation of them
    unsigned int                       fibres = 0;     ///< lines along the fibres
    std::string                        cut;   ///< "z:0.5": what is above that part of the body's extent along z at rest is taken away
    std::vector<double>                view;  ///< azimuth and elevation [degree]; none: those of Style
    std::vector<double>                range; ///< of the colours; none: what is there
    unsigned int                       width = 1200; ///< [px]
    double                             rate  = 10;   ///< of the animation [1/s]
  };

  /// The command `picture`: bodies at chosen times, of one or several runs side by side, as PNG and SVG.
  /// @throws InputError if a run wrote no fields, not the one that is asked for, or an option is out of range.
  void picture_command(const PictureOptions &options, std::ostream &out);
} // namespace myolines::picture
