// SPDX-License-Identifier: LGPL-2.1-or-later
#include "system.h"

#include <myolines/base/registry.h>
#include <myolines/time/start.h>

#include "states.h"

#include <deal.II/base/mpi.h>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      /// What an integrator in Python works with: the system, the solver of stages, its parameters.
      struct Context
      {
        Context(const IntegratorContext &given, py::dict of_scene)
          : context(given)
          , stages(given)
          , predictors(given.make_state())
          , parameters(std::move(of_scene))
        {}

        void start_piece(State &state)
        {
          without_lock([&] {
            myolines::start_piece(context, stages, state);
            if (has_accelerations(context.system))
              consistent_acceleration(context, stages, Side::right, state);
          });
        }

        StepReport step(const double t, State &state, const Array &u, const Array &v, const Array &a, const Weights &weights)
        {
          assign(u, predictors.u);
          assign(v, predictors.v);
          assign(a, predictors.a);
          Stage stage;
          stage.t = t;
          stage.c = weights;
          return without_lock([&] { return stages.step(stage, predictors, state); });
        }

        const IntegratorContext context;
        StageSolver             stages;
        State                   predictors; ///< of the present stage
        py::dict                parameters;
      };

      /// Steps of an object in Python.
      class Method : public Integrator
      {
      public:
        Method(const py::object &type, const scene::Node &node, const IntegratorContext &context)
          : before_(context.make_state())
        {
          const py::gil_scoped_acquire lock;
          context_   = std::make_shared<Context>(context, values(type.attr("parameters"), node));
          method_    = type(context_);
          remembers_ = type.attr("remembers").cast<std::vector<std::string>>();
        }

        ~Method() override
        {
          const py::gil_scoped_acquire lock;
          method_.release().dec_ref();
          context_.reset();
        }

        void start(State &state) override
        {
          const py::gil_scoped_acquire lock;
          method_.attr("start")(py::cast(&state, py::return_value_policy::reference));
          update_ghosts(state);
        }

        StepReport step(const double dt, State &state) override
        {
          before_ = state;
          const py::gil_scoped_acquire lock;
          py::object                   result;
          try
            {
              result = method_.attr("step")(dt, py::cast(&state, py::return_value_policy::reference));
            }
          catch (...)
            {
              state = before_;
              throw;
            }
          StepReport report = report_of(result);
          if (report.accepted())
            {
              state.t = before_.t + dt;
              update_ghosts(state);
            }
          else
            state = before_;
          return report;
        }

        void save(Archive &archive) const override
        {
          const py::gil_scoped_acquire lock;
          for (const std::string &name : remembers_)
            {
              const py::object value = method_.attr(name.c_str());
              if (py::isinstance<py::array>(value))
                {
                  Vector vector(before_.u);
                  assign(value.cast<Array>(), vector);
                  archive.put(name, vector);
                }
              else
                archive.put(name, value.cast<double>());
            }
        }

        void load(const Archive &archive) override
        {
          const py::gil_scoped_acquire lock;
          for (const std::string &name : remembers_)
            if (archive.has_numbers(name))
              method_.attr(name.c_str()) = archive.number(name);
            else
              {
                Vector vector(before_.u);
                archive.read(name, vector);
                method_.attr(name.c_str()) = owned(vector);
              }
        }

      private:
        static void update_ghosts(State &state)
        {
          for (Vector *x : {&state.u, &state.v, &state.a})
            x->update_ghost_values();
        }

        /// None: accepted; a text: why it is not.
        static StepReport report_of(const py::object &result)
        {
          if (result.is_none())
            return {};
          if (py::isinstance<StepReport>(result))
            return result.cast<StepReport>();
          StepReport report;
          report.outcome = StepReport::Outcome::not_converged;
          report.reason  = py::str(result);
          return report;
        }

        static py::dict values(const py::dict &parameters, const scene::Node &node)
        {
          py::dict dict;
          for (const auto &[name, declared] : parameters)
            dict[name] = node.number(name.cast<std::string>());
          return dict;
        }

        std::shared_ptr<Context> context_;
        py::object               method_;
        std::vector<std::string> remembers_;
        State                    before_;
      };

      /// The parameters that a class declares: name -> (default, unit, low, high, sentence).
      scene::Schema schema_of_class(const py::object &type, const MethodFacts &facts)
      {
        scene::Schema schema(facts.summary);
        for (const auto &[name, declared] : type.attr("parameters").cast<py::dict>())
          {
            const auto [value, unit, low, high, doc] = declared.cast<std::tuple<double, std::string, double, double, std::string>>();
            schema.number(name.cast<std::string>(), value, unit, scene::Range::closed(low, high), doc);
          }
        return schema;
      }

      void register_method(const py::object &type)
      {
        IntegratorEntry entry;
        entry.facts.name         = type.attr("name").cast<std::string>();
        entry.facts.summary      = type.attr("summary").cast<std::string>();
        entry.facts.reference    = type.attr("reference").cast<std::string>();
        entry.facts.order        = type.attr("order").cast<unsigned int>();
        entry.facts.stability    = type.attr("stability").cast<std::string>();
        entry.facts.scheme_rates = false;
        if (type.attr("second_order_only").cast<bool>())
          entry.facts.unknowns = MethodFacts::Unknowns::second_order;
        entry.schema = schema_of_class(type, entry.facts);
        if (integrator_registry().find(entry.facts.name) != nullptr)
          throw py::value_error("there is an integrator \"" + entry.facts.name + "\" already");
        PyObject *kept = type.ptr(); // to the end of the process, as the registry is
        Py_INCREF(kept);
        entry.make = [kept](const scene::Node &node, const IntegratorContext &context) -> std::unique_ptr<Integrator> {
          return std::make_unique<Method>(py::reinterpret_borrow<py::object>(kept), node, context);
        };
        integrator_registry().add(std::move(entry));
      }
    } // namespace

    void bind_methods(py::module_ &module)
    {
      py::class_<State>(module, "State", "u, v and a at a time: the arrays are the entries themselves.")
          .def_readonly("t", &State::t, "[s]")
          .def_property(
              "u", [](py::object self) { return view(self.cast<State &>().u, self); },
              [](State &state, const Array &x) { assign(x, state.u); }, "Displacements [m].")
          .def_property(
              "v", [](py::object self) { return view(self.cast<State &>().v, self); },
              [](State &state, const Array &x) { assign(x, state.v); }, "Velocities [m/s].")
          .def_property(
              "a", [](py::object self) { return view(self.cast<State &>().a, self); },
              [](State &state, const Array &x) { assign(x, state.a); }, "Accelerations [m/s^2].");
      py::class_<StepReport>(module, "StepReport", "How a step ended.")
          .def_property_readonly("accepted", &StepReport::accepted, "Whether it succeeded.")
          .def_property_readonly(
              "reason", [](const StepReport &report) { return report.reason; }, "Why not.")
          .def_property_readonly("counts", &report_dict, "What it took.");
      py::class_<Context, std::shared_ptr<Context>>(module, "Context", "What an integrator works with.")
          .def_property_readonly("system",
                                 [](const std::shared_ptr<Context> &context) {
                                   const auto owner = std::make_shared<Solving>(
                                       context, scene::list_of_defaults(LinearSolver::linear_schema(), "solver/linear"),
                                       scene::list_of_defaults(LinearSolver::preconditioner_schema(), "solver/preconditioner"),
                                       context->context.ledger);
                                   return std::make_shared<System>(owner, context->context.system, owner->solver);
                                 })
          .def_readonly("parameters", &Context::parameters, "Values of the parameters of the method.")
          .def("start_piece", &Context::start_piece, py::arg("state"),
               "Velocities and accelerations at the beginning of a smooth piece, where the boundary may start to move.")
          .def(
              "solve_stage",
              [](Context &context, const double t, State &state, const Array &u, const Array &v, const Array &a,
                 const std::tuple<double, double, double> &c) {
                return context.step(t, state, u, v, a, {std::get<0>(c), std::get<1>(c), std::get<2>(c)});
              },
              py::arg("t"), py::arg("state"), py::arg("u"), py::arg("v"), py::arg("a"), py::arg("c"),
              "Finds d with R(t, u + c[0] d, v + c[1] d, a + c[2] d) = 0 by Newton's method; the state becomes the end of the stage.");
      module.def("register_integrator", &register_method, py::arg("type"), "Makes a class an integrator that scenes may name.");
    }
  } // namespace python
} // namespace myolines
