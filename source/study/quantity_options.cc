// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/text_file.h>
#include <myolines/study/quantity_options.h>

namespace myolines::study
{
  Study study_of(const QuantityOptions &options)
  {
    constexpr double week = 604800; // [s]
    Study            study;
    study.scene         = options.scene;
    study.ranks         = options.ranks;
    study.case_seconds  = week;
    study.total_seconds = week;
    return study;
  }

  std::filesystem::path made_folder(const QuantityOptions &options, const std::string &command)
  {
    const std::filesystem::path folder =
        options.folder.empty() ? std::filesystem::path("results") / (options.scene.stem().string() + " " + command) : options.folder;
    on_writing_rank("output folder " + folder.string(), "a folder that can be made and written", "choose another one with --out",
                    [&] { std::filesystem::create_directories(folder); });
    return folder;
  }
} // namespace myolines::study
