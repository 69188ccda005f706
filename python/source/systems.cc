// SPDX-License-Identifier: LGPL-2.1-or-later
#include "system.h"

#include <myolines/cli/catalogue.h>

#include "document.h"

#include <deal.II/base/mpi.h>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      /// A system without a run.
      struct AloneSystem
      {
        explicit AloneSystem(const scene::Node &scene)
          : assembled(make_system(scene, ledger))
          , solver(scene.section("solver").section("linear"), scene.section("solver").section("preconditioner"), ledger)
        {}

        WorkLedger      ledger;
        AssembledSystem assembled;
        LinearSolver    solver;
      };

      std::shared_ptr<System> make_alone(const Document &scene)
      {
        need_mpi();
        const scene::Node node  = scene.copied_node();
        const auto        alone = without_lock([&] { return std::make_shared<AloneSystem>(node); });
        return std::make_shared<System>(alone, *alone->assembled.system, alone->solver);
      }

      WeightsByOrder of_all_orders(const Weights &weights) { return {{weights, weights, weights}}; }

      /// The sum over the ranks that share the system; one of a single rank every rank holds whole.
      double sum(const Vector &layout, const double here) { return dealii::Utilities::MPI::sum(here, layout.get_mpi_communicator()); }
    } // namespace

    System::System(std::shared_ptr<void> owner, const SemiDiscreteSystem &system, LinearSolver &solver)
      : owner_(std::move(owner))
      , system_(system)
      , solver_(solver)
      , layout_(system.initial_state(0).u)
      , u_(layout_)
      , v_(layout_)
      , a_(layout_)
      , r_(layout_)
    {}

    py::tuple System::residual(const double t, const Array &u, const Array &v, const Array &a, const std::string &side)
    {
      assign(u, u_);
      assign(v, v_);
      assign(a, a_);
      const Side       of_instant = side_named(side);
      const Evaluation evaluation = without_lock([&] { return system_.residual({t, of_instant, u_, v_, a_}, r_); });
      return py::make_tuple(owned(r_), evaluation.admissible ? py::object(py::none()) : py::str(evaluation.reason));
    }

    Linearised System::linearise(const double t, const Array &u, const Array &v, const Array &a, const std::string &side)
    {
      assign(u, u_);
      assign(v, v_);
      assign(a, a_);
      return Linearised(shared_from_this(), {t, side_named(side), u_, v_, a_});
    }

    Array System::free() const
    {
      const Constraints &constraints = system_.constraints();
      Array              mask(static_cast<py::ssize_t>(layout_.locally_owned_size()));
      double            *values = mask.mutable_data();
      for (const auto index : layout_.locally_owned_elements())
        *values++ = constraints.is_constrained(index) ? 0 : 1;
      return mask;
    }

    py::dict System::capabilities() const
    {
      const Capabilities facts = system_.capabilities();
      py::dict           dict, splits;
      dict["inertia"]           = facts.inertia;
      dict["rates"]             = facts.rates;
      dict["linear"]            = facts.linear;
      dict["constant mass"]     = facts.constant_mass;
      dict["symmetric tangent"] = facts.symmetric_tangent;
      dict["energy"]            = facts.energy;
      dict["orders"]            = facts.orders;
      for (const Split &split : facts.splits)
        splits[py::str(split.name)] = split.summary;
      dict["splits"] = splits;
      return dict;
    }

    Array System::gathered(const Array &x) const
    {
      if (x.ndim() != 1 || static_cast<std::size_t>(x.shape(0)) != layout_.locally_owned_size())
        throw py::value_error("an array with one number for each unknown of this rank is needed");
      std::vector<double> ordered;
      for (const unsigned int i : system_.canonical_order())
        ordered.push_back(x.data()[i]);
      std::vector<double> all;
      for (const auto &part : dealii::Utilities::MPI::all_gather(layout_.get_mpi_communicator(), ordered))
        all.insert(all.end(), part.begin(), part.end());
      return Array(static_cast<py::ssize_t>(all.size()), all.data());
    }

    bool System::is_spread() const { return dealii::Utilities::MPI::n_mpi_processes(layout_.get_mpi_communicator()) > 1; }

    double System::dot(const Array &x, const Array &y) const
    {
      if (x.size() != y.size())
        throw py::value_error("two arrays of one size are needed");
      double here = 0;
      for (py::ssize_t i = 0; i < x.size(); ++i)
        here += x.data()[i] * y.data()[i];
      return sum(layout_, here);
    }

    Linearised::Linearised(std::shared_ptr<System> system, const Point &point)
      : system_(std::move(system))
      , linearisation_(system_->system().make_linearisation())
      , x_(system_->layout())
      , y_(x_)
    {
      without_lock([&] { system_->system().linearise(point, *linearisation_); });
    }

    Array Linearised::apply(const Array &x, const Weights &weights) const
    {
      assign(x, x_);
      without_lock([&] { linearisation_->apply(of_all_orders(weights), x_, y_); });
      return owned(y_);
    }

    py::dict Linearised::csr(const Weights &weights)
    {
      const Vector      &layout      = system_->layout();
      const Constraints &constraints = system_->system().constraints();
      if (system_->is_spread())
        throw py::value_error("the matrix is spread over several ranks; its products with vectors are not: apply()");
      const SparseMatrix       &matrix = linearisation_->sparse(of_all_orders(weights));
      std::vector<double>       values;
      std::vector<std::int64_t> columns, starts{0};
      for (std::size_t row = 0; row < layout.size(); ++row)
        {
          if (!constraints.is_constrained(row))
            for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
              if (!constraints.is_constrained(entry->column()))
                {
                  values.push_back(entry->value());
                  columns.push_back(static_cast<std::int64_t>(entry->column()));
                }
          starts.push_back(static_cast<std::int64_t>(columns.size()));
        }
      py::dict dict;
      dict["data"]    = Array(static_cast<py::ssize_t>(values.size()), values.data());
      dict["indices"] = py::array_t<std::int64_t>(static_cast<py::ssize_t>(columns.size()), columns.data());
      dict["indptr"]  = py::array_t<std::int64_t>(static_cast<py::ssize_t>(starts.size()), starts.data());
      return dict;
    }

    py::dict Linearised::solve(const Array &b, const Weights &weights, const double tolerance)
    {
      assign(b, y_);
      x_                                  = 0;
      const SemiDiscreteSystem &system    = system_->system();
      const bool                symmetric = system.capabilities().symmetric_tangent;
      const LinearReport        report    = without_lock([&] {
        system_->solver().forget(); // what was kept is of another linearisation, or of other weights
        return system_->solver().solve(*linearisation_, of_all_orders(weights), system.constraints(), symmetric, y_, x_, tolerance);
      });
      py::dict                  dict;
      dict["x"]          = owned(x_);
      dict["converged"]  = report.converged;
      dict["reason"]     = report.reason;
      dict["iterations"] = report.iterations;
      dict["residual"]   = report.relative_residual;
      return dict;
    }

    void bind_systems(py::module_ &module)
    {
      const auto weights = [](const double u, const double v, const double a) { return Weights{u, v, a}; };
      py::class_<Linearised>(module, "Linearised", "K, C and M at one point.")
          .def(
              "apply", [=](const Linearised &l, const Array &x, double u, double v, double a) { return l.apply(x, weights(u, v, a)); },
              py::arg("x"), py::arg("u"), py::arg("v"), py::arg("a"), "(u K + v C + a M) x, without constraints.")
          .def(
              "csr", [=](Linearised &l, double u, double v, double a) { return l.csr(weights(u, v, a)); }, py::arg("u"), py::arg("v"),
              py::arg("a"), "The matrix of the free unknowns, by rows.")
          .def(
              "solve",
              [=](Linearised &l, const Array &b, double u, double v, double a, double tolerance) {
                return l.solve(b, weights(u, v, a), tolerance);
              },
              py::arg("b"), py::arg("u"), py::arg("v"), py::arg("a"), py::arg("tolerance"),
              "Solves on the free unknowns with the preconditioner of the scene.");
      py::class_<System, std::shared_ptr<System>>(module, "System", "A system as arrays.")
          .def(py::init(&make_alone), py::arg("scene"), "That of a scene.")
          .def("residual", &System::residual, py::arg("t"), py::arg("u"), py::arg("v"), py::arg("a"), py::arg("side"),
               "R(t, u, v, a), and why it is inadmissible or None.")
          .def("linearise", &System::linearise, py::arg("t"), py::arg("u"), py::arg("v"), py::arg("a"), py::arg("side"))
          .def("free", &System::free, "1 for unknowns that are free, 0 for constrained ones.")
          .def("capabilities", &System::capabilities)
          .def("gathered", &System::gathered, py::arg("x"), "All entries of all ranks, in an order that does not depend on them.")
          .def("dot", &System::dot, py::arg("x"), py::arg("y"), "The scalar product over all ranks.")
          .def(
              "initial_state",
              [](const System &system, const double t) {
                const State state = system.initial_state(t);
                return py::make_tuple(owned(state.u), owned(state.v), owned(state.a));
              },
              py::arg("t"), "u, v and a with which a run begins.")
          .def(
              "prescribed",
              [](const System &system, const double t, const Array &u, const Array &v, const Array &a, const std::string &side) {
                State state{t, system.layout(), system.layout(), system.layout()};
                assign(u, state.u);
                assign(v, state.v);
                assign(a, state.a);
                system.system().prescribed(t, side_named(side), state);
                return py::make_tuple(owned(state.u), owned(state.v), owned(state.a));
              },
              py::arg("t"), py::arg("u"), py::arg("v"), py::arg("a"), py::arg("side"), "The same with the prescribed motion of a time.")
          .def(
              "events", [](const System &system, const double t0, const double t1) { return system.system().events(t0, t1); },
              py::arg("t0"), py::arg("t1"), "Kinks of the drives between two times [s].")
          .def_property_readonly("is_spread", &System::is_spread, "Whether several ranks share it.")
          .def_property_readonly(
              "n_unknowns", [](const System &system) { return system.system().n_unknowns(); }, "On all ranks.");
    }
  } // namespace python
} // namespace myolines
