// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_report.h"

#include <myolines/base/error.h>
#include <myolines/output/file_lock.h>
#include <myolines/output/text_file.h>

#include <sstream>

namespace myolines::study
{
  namespace
  {
    std::vector<std::string> settings_of(const AdviseOptions &options, const MeshChoice &mesh, const Advice &advice)
    {
      std::vector<std::string> settings = options.overrides;
      if (mesh.rung != nullptr)
        settings.insert(settings.end(), mesh.rung->settings.begin(), mesh.rung->settings.end());
      for (const auto *more : {&advice.track->candidate->settings, &advice.rung->settings})
        settings.insert(settings.end(), more->begin(), more->end());
      return settings;
    }

    void refuse_to_replace_the_scene(const AdviseOptions &options)
    {
      std::error_code none;
      if (!options.write.empty() && std::filesystem::equivalent(options.write, options.scene, none))
        throw InputError(InputProblem{"--write " + options.write.string(), "this file is the scene itself", "another file", ""});
    }

    void write_scene(const AdviseOptions &options, const MeshChoice &mesh, const Advice &advice)
    {
      const std::string text = options.scene_text(options.scene, settings_of(options, mesh, advice));
      on_writing_rank("--write " + options.write.string(), "a file that can be written", "choose another one",
                      [&] { replace_file(options.write, text); });
    }
  } // namespace

  void advise_command(const AdviseOptions &options, std::ostream &out)
  {
    require_one_process("advise", "--ranks gives its runs several");
    refuse_to_replace_the_scene(options);
    read_accuracy(options.accuracy);
    const Choices               choices = options.choices(options.scene, options.overrides);
    const std::filesystem::path folder  = made_folder(options, "advise");
    const FileLock              lock(folder / "advise.lock", FileLock::Kind::exclusive, "another advice");

    Pilot            pilot(options, folder);
    TimeReference    reference(pilot, choices, mesh_of_the_pilot(choices.mesh));
    const MeshChoice mesh = choose_mesh(pilot, choices, reference, options);
    Search           search(pilot, choices, reference, mesh);
    const Advice     advice = search.advice(options.trial);

    const AdviceReport report{pilot, choices, reference, mesh, search, advice};
    const std::string  text = advice_text(report);
    replace_file(folder / "advise.txt", text);
    write_advice_tables(report, folder);
    out << text << "Results are in " << folder.string() << ": advise.txt, advise.csv, runs.csv\n";
    if (options.write.empty())
      return;
    write_scene(options, mesh, advice);
    out << "The scene advised is " << options.write.string() << "\n";
  }
} // namespace myolines::study
