// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_options.h"
#include "option_checks.h"
#include "picture_options.h"
#include "study_options.h"

#include <myolines/base/error.h>
#include <myolines/base/lone_process.h>
#include <myolines/base/names.h>
#include <myolines/cli/changed_values.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/guarded.h>
#include <myolines/cli/manual.h>
#include <myolines/cli/plugins.h>
#include <myolines/cli/point.h>
#include <myolines/cli/program.h>
#include <myolines/cli/reference.h>
#include <myolines/cli/versions.h>
#include <myolines/compare/compare.h>
#include <myolines/output/text_file.h>

#include <CLI/CLI.hpp>

#include <csignal>
#include <functional>
#include <iostream>

namespace myolines
{
  namespace
  {
    /// The commands with the places their arguments are parsed into. `chosen` is the one to run.
    class CommandLine
    {
    public:
      CommandLine(std::ostream &out, MpiSession &mpi)
        : out_(out)
        , mpi_(mpi)
      {
        app.require_subcommand(1);
        app.footer(
            "Exit codes: 0 done, 1 internal error, 2 invalid input, 3 the solve failed or a signal stopped the run, 4 the system refused "
            "(disk, memory, permission).");
        add_run();
        add_check();
        add_mesh();
        add_modes();
        add_point();
        add_study();
        add_verify();
        add_advise();
        add_compare();
        add_plot();
        add_picture();
        add_list();
        add_template();
        add_import();
        app.set_version_flag("--version", versions_text, "Prints the versions of the program and of its libraries");
        add(app, "manual", "Prints the manual page of this program", [this] { write_manual(app, out_); });
        add(app, "completion", "Prints the completion of its command line for bash", [this] {
          write_bash_completion(app, {{"list", list_topics()}}, out_);
        });
        refuse_places_without_a_name(app);
      }

      CLI::App                           app{"Myolines: muscle dynamics, one system and one integrator at a time", "myolines"};
      std::function<void()>              chosen;
      RunOptions                         run;
      std::vector<std::filesystem::path> plugins; ///< to be loaded first

    private:
      CLI::App *add(CLI::App &parent, const std::string &name, const std::string &doc, std::function<void()> action)
      {
        CLI::App *command = parent.add_subcommand(name, doc);
        command->callback([this, action] { chosen = action; });
        return command;
      }

      void add_plugins(CLI::App *command)
      {
        command->add_option("--plugin", plugins, "Loads a plug-in from this file; may be repeated")
            ->allow_extra_args(false)
            ->type_name("NAME.so");
      }

      void add_scene_options(CLI::App *command)
      {
        add_plugins(command);
        command->add_option("--set", run.overrides, "Overrides a value of the scene: \"time/step=1e-3\"; may be repeated")
            ->allow_extra_args(false)
            ->type_name("PATH=VALUE");
        // After --set, whose values are there when this is called: what is removed may be set anew.
        const auto unset = [this](const std::vector<std::string> &paths) {
          for (const std::string &path : paths)
            run.overrides.insert(run.overrides.begin(), "~" + path);
        };
        command
            ->add_option_function<std::vector<std::string>>("--unset", unset,
                                                            "Removes a parameter or a list from the scene; may be repeated")
            ->allow_extra_args(false)
            ->type_name("PATH");
      }

      void add_run()
      {
        CLI::App *command = add(app, "run", "Runs a scene", [this] { run_command(run, out_); });
        command->add_option("scene", run.scene, "The scene")->required()->type_name("SCENE.xml");
        command->add_option("--out", run.folder, "Where to write; default: results/ and the name of the scene")->type_name("DIR");
        CLI::Option *resume = command->add_flag("--resume", run.resume, "Goes on from the checkpoint in the output folder");
        command
            ->add_flag("--overwrite", run.overwrite,
                       "Removes results of another scene, or of this one with other values, from the output folder")
            ->excludes(resume);
        command->add_flag("--quiet", run.quiet, "Prints nothing unless something goes wrong");
        command
            ->add_option(
                "--instruction-set", run.instruction_set,
                "Of the kernels of three-dimensional muscles: baseline, avx2 or avx512; default: the widest that the processor has")
            ->type_name("NAME");
        add_scene_options(command);
      }

      void add_check()
      {
        CLI::App *command = add(app, "check", "Validates a scene and says what a run would do",
                                [this] { check_command(run.scene, run.overrides, brief_, out_); });
        command->add_option("scene", run.scene, "The scene")->required()->type_name("SCENE.xml");
        command->add_flag("--brief", brief_, "Unknowns, steps, memory, cost and warnings only; takes some steps to tell the cost");
        add_scene_options(command);
      }

      void add_mesh()
      {
        CLI::App *command =
            add(app, "mesh", "Writes the mesh of a scene to a file", [this] { mesh_command(run.scene, run.overrides, mesh_, out_); });
        command->add_option("scene", run.scene, "A scene of a three-dimensional muscle")->required()->type_name("SCENE.xml");
        command->add_option("--out", mesh_, "The file: VTK (.vtu) or Gmsh (.msh)")->required()->type_name("FILE");
        add_scene_options(command);
      }

      void add_modes()
      {
        CLI::App *command = add(app, "modes", "Growth rates and frequencies of small motions, or smallest eigenvalues along a run", [this] {
          if (along_.run.empty())
            modes_command(run.scene, run.overrides, modes_, out_);
          else
            {
              along_.scene     = run.scene;
              along_.overrides = run.overrides;
              along_.file      = modes_;
              modes_along_command(along_, out_);
            }
        });
        command
            ->add_option("scene", run.scene,
                         "The scene; modes about its initial state: dense matrices, at most 2000 free unknowns, one rank")
            ->required()
            ->type_name("SCENE.xml");
        command->add_option("--out", modes_, "Writes all of them, comma-separated; along a run by default: modes.csv in its folder")
            ->type_name("FILE.csv");
        CLI::Option *along =
            command
                ->add_option("--along", along_.run,
                             "Output folder of a run of the scene with the list output/checkpoint/keep: the smallest eigenvalues of the "
                             "tangent at every kept state, matrix-free, on any number of ranks")
                ->type_name("DIR");
        command->add_option("--at", along_.at, "Time [s] of the only state to look at")->type_name("TIME")->needs(along);
        command->add_option("--number", along_.number, "Of smallest eigenvalues")
            ->check(at_least_one())
            ->needs(along)
            ->capture_default_str();
        add_scene_options(command);
      }

      void add_point()
      {
        CLI::App *command = add(app, "point", "Stress, or force, of a muscle against stretch and rate",
                                [this] { point_command(run.scene, run.overrides, point_, out_); });
        command->add_option("scene", run.scene, "A scene of a muscle, in one or three dimensions")->required()->type_name("SCENE.xml");
        command->add_option("--out", point_.folder, "Where to write tables and pictures; default: results/ and \"SCENE point\"")
            ->type_name("DIR");
        command->add_option("--stretch", point_.stretch, "Stretches")->expected(3)->capture_default_str()->type_name("FROM TO POINTS");
        command->add_option("--strain-rate", point_.strain_rate, "Strain rates, over the maximum one")
            ->expected(3)
            ->capture_default_str()
            ->type_name("FROM TO POINTS");
        command->add_option("--activation", point_.activation, "Activations")->capture_default_str()->type_name("NUMBER ...");
        add_scene_options(command);
      }

      void add_study()
      {
        CLI::App *command =
            add(app, "study", "Runs many variants of a scene and tabulates what is asked of them; see: list studies", [this] {
              study_.plugins = plugins;
              study_command(study_, run.quiet, mpi_, out_);
            });
        add_study_options(*command, study_);
        command->add_flag("--quiet", run.quiet, "Prints nothing unless something goes wrong");
        add_plugins(command);
      }

      void add_scene(CLI::App *command)
      {
        command->add_option("scene", run.scene, "The scene")->required()->type_name("SCENE.xml");
        command->add_flag("--quiet", run.quiet, "Prints nothing unless something goes wrong");
        add_scene_options(command);
      }

      void take_scene(study::QuantityOptions &question) const
      {
        question.scene     = run.scene;
        question.overrides = run.overrides;
        question.plugins   = plugins;
      }

      void add_verify()
      {
        CLI::App *command =
            add(app, "verify", "Estimates the errors that steps and mesh leave in values of a scene, and what less costs", [this] {
              take_scene(verify_);
              verify_command(verify_, run.quiet, mpi_, out_);
            });
        add_scene(command);
        add_quantity_options(*command, verify_);
      }

      void add_advise()
      {
        CLI::App *command = add(app, "advise", "Finds the cheapest method, steps and mesh for an accuracy of values of a scene", [this] {
          take_scene(advise_);
          advise_command(advise_, run.quiet, mpi_, out_);
        });
        add_scene(command);
        add_quantity_options(*command, advise_);
        add_advise_options(*command, advise_);
      }

      void add_compare()
      {
        CLI::App *command =
            add(app, "compare", "L2 differences of the fields of two runs of a block, or of a rod, on any two of its meshes", [this] {
              for (const std::filesystem::path &run : {compare_.first, compare_.second})
                load_plugins_of_run(run);
              compare_command(compare_, out_);
            });
        command->add_option("first", compare_.first, "Output folder of a run")->required()->type_name("DIR");
        command->add_option("second", compare_.second, "Output folder of the run that it is measured against")
            ->required()
            ->type_name("DIR");
        CLI::Option *at = command->add_option("--at", compare_.at, "Time [s] at which both have kept a state; default: the end of both");
        at->type_name("TIME");
        command->add_flag("--all", compare_.all, "All times at which both have kept a state")->excludes(at);
        command->add_option("--csv", compare_.csv, "Writes the table to this file as well")->type_name("FILE.csv");
        add_plugins(command);
      }

      void add_plot()
      {
        add_plot_options(
            *add(app, "plot", "Draws a run, several runs or a study, as PNG and SVG", [this] { study::plot_command(plot_, out_); }), plot_);
      }

      void add_picture()
      {
        add_picture_options(*add(app, "picture", "Draws the body of a run, or of several side by side, as PNG and SVG",
                                 [this] { picture::picture_command(picture_, out_); }),
                            picture_);
        add_report_options(*add(app, "report", "Tells all of a run or a study in one HTML file, with the body to turn",
                                [this] {
                                  report_.changed_values = changed_values;
                                  report::report_command(report_, out_);
                                }),
                           report_);
      }

      void add_list()
      {
        CLI::App *command = add(app, "list", "Lists what scenes can use: " + join(list_topics()), [this] {
          if (markdown_)
            reference_command(topic_, app, out_);
          else
            list_command(topic_, name_, out_);
        });
        command->add_option("topic", topic_, join(list_topics()))->type_name("TOPIC");
        CLI::Option *name = command->add_option("name", name_, "Everything about this one")->type_name("NAME");
        command
            ->add_flag("--markdown", markdown_,
                       "Prints the reference of the manual instead, or one page of it: " + join(reference_topics()))
            ->excludes(name);
        add_plugins(command);
      }

      void add_template()
      {
        CLI::App *command =
            add(app, "template", "Prints a complete, commented scene to start from", [this] { template_command(topic_, name_, out_); });
        command->add_option("system", topic_, "Kind of system, see: list systems")->required()->type_name("SYSTEM");
        command->add_option("integrator", name_, "Method, see: list integrators")->type_name("INTEGRATOR");
        add_plugins(command);
      }

      void add_import()
      {
        CLI::App *import  = app.add_subcommand("import", "Makes a scene of the files of another program")->require_subcommand(1);
        CLI::App *command = add(*import, "flexodeal", "Makes a scene of the files of Flexodeal or of Flexodeal Lite",
                                [this] { import_flexodeal(flexodeal_, out_); });
        add_flexodeal_options(*command, flexodeal_);
      }

      std::ostream           &out_;
      MpiSession             &mpi_;
      std::string             topic_, name_;
      bool                    brief_ = false, markdown_ = false;
      FlexodealOptions        flexodeal_;
      study::Options          study_;
      study::VerifyOptions    verify_;
      study::AdviseOptions    advise_;
      CompareOptions          compare_;
      study::PlotOptions      plot_;
      picture::PictureOptions picture_;
      report::ReportOptions   report_;
      std::filesystem::path   modes_, mesh_;
      PointOptions            point_;
      ModesAlongOptions       along_;
    };

    ExitCode refuse_command_line(const CLI::App &app, const CLI::ParseError &error, const int argc, const char *const *argv,
                                 std::ostream &out, std::ostream &err)
    {
      std::vector<std::string> commands;
      for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
        commands.push_back(command->get_name());
      const bool unknown = argc > 1 && argv[1][0] != '-' && std::find(commands.begin(), commands.end(), argv[1]) == commands.end();
      if (unknown)
        {
          err << "unknown command \"" << argv[1] << "\"\n  expected: one of " << join(commands) << "\n";
          if (const std::string hint = nearest_hint(argv[1], commands, "nearest valid name"); !hint.empty())
            err << "  hint: " << hint << "\n";
        }
      else if (app.exit(error, out, err) == 0)
        return ExitCode::done;
      return ExitCode::invalid_input;
    }
  } // namespace

  int program(const int argc, const char *const *argv, MpiSession &mpi)
  {
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is told where it is written
    const std::string command          = argc > 1 ? argv[1] : "";
    const bool        starts_processes = command == "study" || command == "verify" || command == "advise";
    if (!starts_processes || is_rank_of_a_job())
      {
        struct sigaction hang_up
        {
        };
        sigaction(SIGHUP, nullptr, &hang_up);
        if (const ExitCode code = guarded([&mpi] { mpi.start(); }, std::cerr); code != ExitCode::done)
          return static_cast<int>(code);
        if (hang_up.sa_handler == SIG_IGN) // by nohup, which the MPI library forgets
          std::signal(SIGHUP, SIG_IGN);
      }
    std::ostream  nowhere(nullptr);
    std::ostream &out = writes_files() ? std::cout : nowhere;
    std::ostream &err = writes_files() ? std::cerr : nowhere;
    CommandLine   line(out, mpi);
    try
      {
        line.app.parse(argc, argv);
      }
    catch (const CLI::ParseError &error)
      {
        return static_cast<int>(flushed(refuse_command_line(line.app, error, argc, argv, out, err)));
      }
    line.run.command_line           = shell_text(std::vector<std::string>(argv, argv + argc));
    line.run.program                = argv[0];
    const auto command_with_plugins = [&line] {
      for (std::filesystem::path &file : line.plugins)
        {
          load_plugin(file, "command line: --plugin");
          file = std::filesystem::absolute(file); // for runs that are started elsewhere
        }
      line.chosen();
    };
    return static_cast<int>(flushed(guarded(command_with_plugins, err)));
  }
} // namespace myolines
