// SPDX-License-Identifier: LGPL-2.1-or-later
#include "system.h"

#include <myolines/cli/simulation.h>
#include <myolines/output/status.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/sampled.h>

#include "document.h"
#include "states.h"

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      /// A function of time written in Python, with the derivatives and kinks that its author knows.
      class Course : public Drive
      {
      public:
        Course(py::function value, std::optional<py::function> first, std::optional<py::function> second, std::vector<double> kinks)
          : value_(std::move(value))
          , first_(std::move(first))
          , second_(std::move(second))
          , kinks_(std::move(kinks))
        {
          std::sort(kinks_.begin(), kinks_.end());
        }

        double value(const double t, const Side side) const override { return call(value_, t, side); }
        double first_derivative(const double t, const Side side) const override { return derivative(first_, t, side); }
        double second_derivative(const double t, const Side side) const override { return derivative(second_, t, side); }

        std::vector<double> kinks(const double t0, const double t1) const override
        {
          return {std::upper_bound(kinks_.begin(), kinks_.end(), t0), std::lower_bound(kinks_.begin(), kinks_.end(), t1)};
        }

      private:
        static double derivative(const std::optional<py::function> &function, const double t, const Side side)
        {
          if (!function)
            throw InputError(InputProblem{"a course", "its derivatives are asked for, but not given", "derivatives: this drive is a motion",
                                          "give `first` and `second` to myolines.Course, or samples"});
          return call(*function, t, side);
        }

        static double call(const py::function &function, const double t, const Side side)
        {
          const py::gil_scoped_acquire lock;
          return function(t, side == Side::left ? "left" : "right").cast<double>();
        }

        py::function                value_;
        std::optional<py::function> first_, second_;
        std::vector<double>         kinks_;
      };

      std::vector<double> numbers(const Array &array) { return {array.data(), array.data() + array.size()}; }

      std::shared_ptr<Drive> sampled(const Array &times, const Array &values, const std::string &how)
      {
        const std::vector<double> t = numbers(times), x = numbers(values);
        if (t.size() != x.size() || t.size() < 2 || !std::is_sorted(t.begin(), t.end(), std::less_equal<double>()))
          throw py::value_error("as many values as times are needed, two or more, at ascending times");
        if (how == "lines")
          return std::make_shared<SampledDrive>(SampledDrive::lines(t, x));
        if (how == "spline")
          return std::make_shared<SampledDrive>(SampledDrive::spline(t, x));
        if (how == "monotone")
          return std::make_shared<SampledDrive>(SampledDrive::monotone(t, x));
        throw py::value_error("between samples are \"lines\", a \"spline\" or a \"monotone\" curve, not \"" + how + "\"");
      }

      /// A simulation with what Python needs beside it.
      class Stepped
      {
      public:
        explicit Stepped(const Document &scene)
        {
          need_mpi();
          const scene::Node node = scene.copied_node();
          without_lock([&] { simulation = std::make_shared<Simulation>(node); });
        }

        void advance_to(const double t)
        {
          without_lock([&] {
            simulation->advance_to(t, [] {
              const py::gil_scoped_acquire lock;
              if (PyErr_CheckSignals() != 0)
                throw py::error_already_set();
            });
          });
        }

        py::dict measure()
        {
          const std::vector<Simulation::Measured> &all =
              without_lock([&]() -> const std::vector<Simulation::Measured> & { return simulation->measure(); });
          if (names_.size() != all.size()) // the same ones every time
            {
              names_.clear();
              for (const Simulation::Measured &one : all)
                names_.emplace_back(py::str(one.table), py::str(one.column));
            }
          py::dict tables, table;
          for (std::size_t i = 0; i < all.size(); ++i)
            {
              if (i == 0 || all[i].table != all[i - 1].table)
                {
                  table                   = py::dict();
                  tables[names_[i].first] = table;
                }
              table[names_[i].second] = py::float_(all[i].value);
            }
          return tables;
        }

        std::shared_ptr<System> system()
        {
          Experiment        &experiment = simulation->experiment();
          const scene::Node &solver     = experiment.scene().section("solver");
          const auto         owner =
              std::make_shared<Solving>(simulation, solver.section("linear"), solver.section("preconditioner"), experiment.ledger());
          return std::make_shared<System>(owner, experiment.system(), owner->solver);
        }

        std::shared_ptr<Simulation> simulation;

      private:
        std::vector<std::pair<py::str, py::str>> names_;
      };

      Steering &steering(const Stepped &stepped, const std::string &path) { return stepped.simulation->steering(path); }
    } // namespace

    void bind_simulations(py::module_ &module)
    {
      py::class_<Drive, std::shared_ptr<Drive>>(module, "Drive", "A function of time, with derivatives and kinks.")
          .def(
              "value", [](const Drive &drive, const double t, const std::string &side) { return drive.value(t, side_named(side)); },
              py::arg("t"), py::arg("side") = "left")
          .def("kinks", &Drive::kinks, py::arg("t0"), py::arg("t1"));
      module.def(
          "course",
          [](py::function value, std::optional<py::function> first, std::optional<py::function> second,
             std::vector<double> kinks) -> std::shared_ptr<Drive> {
            return std::make_shared<Course>(std::move(value), std::move(first), std::move(second), std::move(kinks));
          },
          py::arg("value"), py::arg("first"), py::arg("second"), py::arg("kinks"), "A drive of Python functions of time and side.");
      module.def("sampled", &sampled, py::arg("t"), py::arg("x"), py::arg("how"), "A drive between samples.");

      py::class_<Simulation::Moment>(module, "Moment", "A moment of a simulation, to come back to.")
          .def_property_readonly(
              "t", [](const Simulation::Moment &moment) { return moment.run.state.t; }, "[s]");

      py::class_<Stepped>(module, "Simulation", "A scene that is advanced piece by piece.")
          .def(py::init<const Document &>(), py::arg("scene"))
          .def("advance_to", &Stepped::advance_to, py::arg("t"))
          .def("measure", &Stepped::measure)
          .def("system", &Stepped::system)
          .def_property_readonly("t", [](const Stepped &s) { return s.simulation->state().t; })
          .def_property_readonly("u", [](const Stepped &s) { return owned(s.simulation->state().u); })
          .def_property_readonly("v", [](const Stepped &s) { return owned(s.simulation->state().v); })
          .def_property_readonly("a", [](const Stepped &s) { return owned(s.simulation->state().a); })
          .def_property_readonly("end", [](const Stepped &s) { return s.simulation->experiment().settings().end; })
          .def_property_readonly("steps", [](const Stepped &s) { return s.simulation->steps(); })
          .def_property_readonly("last_step", [](const Stepped &s) { return step_dict(s.simulation->last_step()); })
          .def_property_readonly("counts",
                                 [](const Stepped &s) {
                                   py::dict counts;
                                   for (const auto &[name, count] : s.simulation->experiment().ledger().counts())
                                     counts[py::str(name)] = count;
                                   return counts;
                                 })
          .def_property_readonly("warnings", [](const Stepped &s) { return s.simulation->experiment().warnings(); })
          .def_property_readonly("steered",
                                 [](const Stepped &s) {
                                   std::vector<std::pair<std::string, std::string>> paths;
                                   for (const auto &one : s.simulation->steered())
                                     paths.emplace_back(one->path(), one->driven().unit);
                                   return paths;
                                 })
          .def(
              "steer",
              [](const Stepped &s, const std::string &path, const double x, const double over) { s.simulation->steer(path, x, over); },
              py::arg("path"), py::arg("value"), py::arg("over"))
          .def(
              "follow",
              [](const Stepped &s, const std::string &path, const std::shared_ptr<Drive> &drive) { s.simulation->steer(path, drive); },
              py::arg("path"), py::arg("drive"))
          .def(
              "steered_value",
              [](const Stepped &s, const std::string &path) {
                return steering(s, path).courses().now->value(s.simulation->state().t, Side::right);
              },
              py::arg("path"))
          .def("save", [](const Stepped &s) { return s.simulation->save(); })
          .def(
              "restore", [](const Stepped &s, const Simulation::Moment &moment) { s.simulation->restore(moment); }, py::arg("moment"))
          .def(
              "save_file", [](const Stepped &s, const std::string &file) { s.simulation->save(std::filesystem::path(file)); },
              py::arg("file"))
          .def(
              "restore_file", [](const Stepped &s, const std::string &file) { s.simulation->restore(std::filesystem::path(file)); },
              py::arg("file"));
    }
  } // namespace python
} // namespace myolines
