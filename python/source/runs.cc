// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"

#include <myolines/base/names.h>
#include <myolines/cli/changed_values.h>
#include <myolines/cli/commands.h>
#include <myolines/picture/body.h>
#include <myolines/picture/command.h>
#include <myolines/report/command.h>
#include <myolines/scene/csv.h>

#include "document.h"

#include <sstream>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      /// Calls a function with the time, the number of accepted steps and whether the step was accepted.
      class Progress : public Observer
      {
      public:
        explicit Progress(py::function call)
          : call_(std::move(call))
        {}

        void begin(const State &state) override { tell(state.t, 0, true); }
        void resume(const State &state, const std::size_t step) override { tell(state.t, step, true); }
        void accepted(const State &state, const StepRecord &record) override { tell(state.t, record.number, true); }
        void rejected(const StepRecord &record) override { tell(record.t - record.dt, record.number, false); }

      private:
        void tell(const double t, const std::size_t step, const bool accepted)
        {
          const py::gil_scoped_acquire lock;
          call_(t, step, accepted);
        }

        py::function call_;
      };

      std::string run(const Document &scene, const std::string &folder, const bool resume, const bool overwrite, const bool quiet,
                      const std::optional<py::function> &progress, const std::string &instruction_set)
      {
        need_mpi();
        std::optional<Progress> watcher;
        RunOptions              options;
        options.scene           = scene.name();
        options.folder          = folder;
        options.quiet           = quiet;
        options.resume          = resume;
        options.overwrite       = overwrite;
        options.instruction_set = instruction_set;
        options.made            = scene.node();
        options.command_line    = shell_text({"myolines", "run", folder + "/scene.resolved.xml", "--out", folder}); // which does the same
        if (progress)
          {
            watcher.emplace(*progress);
            options.watchers = {&*watcher};
          }
        std::ostringstream out;
        without_lock([&] { run_command(options, out); });
        return out.str();
      }

      std::string report(const std::string &folder, const std::string &out)
      {
        need_mpi();
        report::ReportOptions options;
        options.folder         = folder;
        options.out            = out;
        options.changed_values = changed_values;
        std::ostringstream text;
        without_lock([&] { report::report_command(options, text); });
        return text.str();
      }

      std::string picture(const std::vector<std::string> &folders, const std::string &out, const std::string &field,
                          const std::vector<double> &at, const unsigned int fibres, const std::string &cut, const std::vector<double> &view,
                          const std::vector<double> &range, const unsigned int width)
      {
        need_mpi();
        picture::PictureOptions options;
        options.folders.assign(folders.begin(), folders.end());
        options.out    = out;
        options.field  = field;
        options.at     = at;
        options.fibres = fibres;
        options.cut    = cut;
        options.view   = view;
        options.range  = range;
        options.width  = width;
        std::ostringstream text;
        without_lock([&] { picture::picture_command(options, text); });
        return text.str();
      }

      template <typename Rows>
      py::array points(const Rows &rows)
      {
        py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(3)});
        auto                at = array.mutable_unchecked<2>();
        for (std::size_t i = 0; i < rows.size(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
            at(i, c) = rows[i][c];
        return std::move(array);
      }

      /// Numbers of points, those of a cell or face in each row.
      template <std::size_t n>
      py::array numbers(const std::vector<std::array<std::size_t, n>> &all)
      {
        py::array_t<std::int64_t> array({static_cast<py::ssize_t>(all.size()), static_cast<py::ssize_t>(n)});
        auto                      at = array.mutable_unchecked<2>();
        for (std::size_t i = 0; i < all.size(); ++i)
          for (std::size_t v = 0; v < n; ++v)
            at(i, v) = static_cast<std::int64_t>(all[i][v]);
        return std::move(array);
      }

      py::dict body(const picture::RunFields &fields, const std::size_t i)
      {
        const picture::Body       body = without_lock([&] { return fields.read(i); });
        py::dict named;
        for (const picture::Field &field : body.fields)
          {
            Array values(static_cast<py::ssize_t>(field.values.size()), field.values.data());
            if (field.n_components > 1)
              values = values.reshape({static_cast<py::ssize_t>(body.rest.size()), static_cast<py::ssize_t>(field.n_components)});
            named[py::str(field.name)] = values;
          }
        py::dict dict;
        dict["t"]      = body.t;
        dict["rest"]   = points(body.rest);
        dict["now"]    = points(body.now);
        dict["cells"]  = numbers(body.cells);
        dict["faces"]  = numbers(body.faces);
        dict["fields"] = named;
        return dict;
      }
    } // namespace

    void bind_runs(py::module_ &module)
    {
      module.def("run", &run, py::arg("scene"), py::arg("folder"), py::arg("resume"), py::arg("overwrite"), py::arg("quiet"),
                 py::arg("progress"), py::arg("instruction_set"), "Runs a scene into a folder; what the program would print.");
      module.def("report", &report, py::arg("folder"), py::arg("out"), "Writes one page about a run or a study.");
      module.def("picture", &picture, py::arg("folders"), py::arg("out"), py::arg("field"), py::arg("at"), py::arg("fibres"),
                 py::arg("cut"), py::arg("view"), py::arg("range"), py::arg("width"), "Draws the bodies of runs.");
      py::class_<picture::RunFields>(module, "RunFields", "The fields that a run wrote.")
          .def(py::init([](const std::string &folder) { return picture::RunFields(folder); }), py::arg("folder"))
          .def_property_readonly(
              "times",
              [](const picture::RunFields &fields) {
                std::vector<double> times;
                for (std::size_t i = 0; i < fields.size(); ++i)
                  times.push_back(fields.time(i));
                return times;
              },
              "When they were written [s].")
          .def("nearest", &picture::RunFields::nearest, py::arg("t"), "Number of the instant nearest to a time.")
          .def("read", &body, py::arg("number"), "Points, cells and fields of one of them.");
    }
  } // namespace python
} // namespace myolines
