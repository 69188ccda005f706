// SPDX-License-Identifier: LGPL-2.1-or-later
#include "muscle3d_linearisation.h"

#include <myolines/base/error.h>
#include <myolines/fem/block_matrix.h>
#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/system/instants.h>

#include <deal.II/grid/grid_tools.h>

namespace myolines
{
  Muscle3dSystem::Muscle3dSystem(Muscle3dParameters parameters, const MPI_Comm communicator, WorkLedger &ledger,
                                 const InstructionSet instruction_set)
    : Muscle3dSystem(parameters, std::make_shared<Muscle3dDiscretisation>(parameters, communicator, instruction_set), ledger)
  {}

  Muscle3dSystem::Muscle3dSystem(Muscle3dParameters parameters, std::shared_ptr<Muscle3dDiscretisation> discretisation, WorkLedger &ledger)
    : parameters_(std::move(parameters))
    , line_(find_line_of_action(parameters_.line, parameters_.geometry, facts_of(parameters_.boundary)))
    , ledger_(ledger)
    , discretisation_(std::move(discretisation))
    , materials_(std::make_unique<PointMaterials>(parameters_, *discretisation_->batches, discretisation_->element,
                                                  discretisation_->potential.get()))
    , surface_forces_(std::make_unique<SurfaceForces>(parameters_, *discretisation_))
    , loads_(std::make_unique<Loads>(parameters_, *discretisation_, *surface_forces_))
  {
    // All ranks agree on what is wrong, that of the first rank that found something.
    const std::vector<std::string> problems = dealii::Utilities::MPI::all_gather(discretisation_->communicator, materials_->problem());
    for (const std::string &problem : problems)
      if (!problem.empty())
        throw InputError(InputProblem{
            "system/fields", problem,
            "fractions in [0, 1], stresses and scales >= 0, fibre directions, tissues that have a list, everywhere in the body", ""});
    std::vector<unsigned int> points(materials_->points_of_region());
    dealii::Utilities::MPI::sum(materials_->points_of_region(), discretisation_->communicator, points);
    for (std::size_t r = 0; r < parameters_.regions.size(); ++r)
      if (points[r + 1] == 0)
        throw InputError(InputProblem{"system/activation regions/" + parameters_.regions[r].name + "/where",
                                      "is positive nowhere in the muscle, or only where later regions cover it",
                                      "a formula that is positive at some quadrature points", "lengths are in metres"});
  }

  Muscle3dSystem::~Muscle3dSystem() = default;

  void Muscle3dSystem::move_mesh(const std::function<dealii::Point<3>(const dealii::Point<3> &)> &map)
  {
    loads_.reset();
    surface_forces_.reset();
    dealii::GridTools::transform(map, discretisation_->mesh);
    discretisation_->set_up(parameters_);
    materials_      = std::make_unique<PointMaterials>(parameters_, *discretisation_->batches, discretisation_->element,
                                                  discretisation_->potential.get());
    surface_forces_ = std::make_unique<SurfaceForces>(parameters_, *discretisation_);
    loads_          = std::make_unique<Loads>(parameters_, *discretisation_, *surface_forces_);
  }

  Capabilities Muscle3dSystem::capabilities() const
  {
    Capabilities c;
    c.inertia           = parameters_.dynamic;
    const bool follows  = std::any_of(parameters_.boundary.begin(), parameters_.boundary.end(),
                                      [](const auto &condition) { return condition->facts().follows; });
    const bool flows    = parameters_.viscous() || parameters_.force_velocity();
    c.rates             = flows || surface_forces_->rates();
    const bool couples  = parameters_.viscous() || (parameters_.force_velocity() && parameters_.rate_tangent.by_gradient != 0);
    c.symmetric_tangent = !parameters_.exact_tangent || (!couples && !follows);
    c.energy            = parameters_.dynamic;
    c.two_states        = parameters_.dynamic;
    c.orders            = {parameters_.dynamic ? 2u : 0u};
    c.splits            = splits();
    return c;
  }

  std::size_t Muscle3dSystem::n_unknowns() const { return discretisation_->space->owned_unknowns().size(); }

  std::size_t Muscle3dSystem::n_cells() const { return discretisation_->mesh.n_global_active_cells(); }

  State Muscle3dSystem::still_state() const
  {
    const Vector zero = discretisation_->space->make_vector();
    return {0, zero, zero, zero};
  }

  State Muscle3dSystem::initial_state(const double t0) const
  {
    State state = still_state();
    state.t     = t0;
    set_initial_motion(parameters_.initial, *discretisation_->space, state);
    prescribed(t0, Side::right, state);
    return state;
  }

  CellSweep Muscle3dSystem::sweep() const { return discretisation_->sweep(*materials_); }

  const Constraints &Muscle3dSystem::constraints() const { return discretisation_->constraints.lines; }

  void Muscle3dSystem::prescribed(const double t, const Side side, State &state) const
  {
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->zero_out_ghost_values(); // entries can only be written while the ghosts are not "current"
    loads_->prescribe(t, side, state);
    for (Vector *x : {&state.u, &state.v, &state.a})
      discretisation_->apply_relations(*x);
  }

  Evaluation Muscle3dSystem::residual(const Point &point, Vector &r) const
  {
    WorkLedger::Timer timer(ledger_, "residual");
    ledger_.count("residual evaluations");
    const Muscle3dDiscretisation &d     = *discretisation_;
    KernelModel                   model = kernel_model(parameters_, activation(point.t, point.side));
    const CurrentGhosts           before(point.before != nullptr ? *point.before : point.u, point.before != nullptr);
    const CurrentGhosts           u(point.u), v(point.v, model.velocities() || surface_forces_->rates()), a(point.a, model.inertia);
    const CellSweep               cells = sweep();
    if (point.before != nullptr)
      of_step(point, before.begin(), model);

    r.zero_out_ghost_values();
    r = 0;
    KernelForces forces;
    bool         valid = true;
    unsigned int b     = 0;
    for (; b < d.batches->n_owned_batches() && valid; ++b)
      valid = d.kernels.residual(d.tables, model, with_local(cells.cells(b), point.local, b * size_of_local()), u.begin(), v.begin(),
                                 a.begin(), r.begin(), forces, d.scratch());
    count_terms(model, "residual", ledger_);

    // A rank that met an inadmissible cell has stopped there; all go on to this sum, and all refuse.
    std::vector<double> sums{valid ? 0. : 1., forces.internal, forces.volume, forces.rounding};
    dealii::Utilities::MPI::sum(sums, d.communicator, sums);
    if (sums[0] > 0)
      {
        r.zero_out_ghost_values();
        r = std::numeric_limits<double>::quiet_NaN(); // whoever overlooks the verdict does not go on with half a residual
        return {false, "det F or the dilatation is not positive, or a stress not finite, near " +
                           where(valid ? std::nullopt : std::optional<unsigned int>(b - 1))};
      }
    double loads = 0;
    if (surface_forces_->any())
      {
        Point at{point.t, point.side, u.vector(), v.vector(), point.a, nullptr, nullptr, point.dissipation};
        if (point.before != nullptr)
          at.before = &before.vector();
        loads = surface_forces_->subtract(at, r);
      }
    r.compress(dealii::VectorOperation::add);
    if (loads_->any_external())
      loads += loads_->subtract_external(point.t, point.side, r);
    return {true, "", std::sqrt(sums[1]) + loads, std::sqrt(sums[2]), std::sqrt(sums[3])};
  }

  std::string Muscle3dSystem::where(const std::optional<unsigned int> batch) const
  {
    std::ostringstream text;
    if (batch)
      text << discretisation_->batches->cell(*batch, 0)->center();
    for (const std::string &place : dealii::Utilities::MPI::all_gather(discretisation_->communicator, text.str()))
      if (!place.empty())
        return "(" + place + ") m of the undeformed body";
    return "";
  }

  std::size_t Muscle3dSystem::size_of_local() const { return std::size_t(2) * discretisation_->element.n_modes * n_lanes; }

  LocalUnknowns Muscle3dSystem::local(const Vector &u) const
  {
    const Muscle3dDiscretisation &d = *discretisation_;
    const CurrentGhosts           current(u);
    const CellSweep               cells = sweep();
    const KernelModel             model = kernel_model(parameters_, {});
    LocalUnknowns                 z;
    // never empty: a rank without cells goes the way of all others
    z.values.resize_fast(std::max<std::size_t>(1, d.batches->n_batches() * size_of_local()));
    for (unsigned int b = 0; b < d.batches->n_batches(); ++b)
      d.kernels.local(d.tables, model, cells.cells(b), current.begin(), &z.values[b * size_of_local()], d.scratch());
    return z;
  }

  void Muscle3dSystem::advance(const LocalUnknowns &z, const Vector &step, const Point &trial, const double alpha,
                               LocalUnknowns &trial_z) const
  {
    const Muscle3dDiscretisation &d = *discretisation_;
    const CurrentGhosts           before(trial.before != nullptr ? *trial.before : trial.u, trial.before != nullptr);
    const CurrentGhosts           by(step), to(trial.u);
    dealii::AlignedVector<double> dp(std::size_t(d.element.n_modes) * n_lanes);
    const CellSweep               cells = sweep();
    KernelModel                   model = kernel_model(parameters_, {});
    if (trial.before != nullptr)
      of_step(trial, before.begin(), model);
    trial_z.values.resize_fast(z.values.size());
    for (unsigned int b = 0; b < d.batches->n_batches(); ++b)
      {
        d.modes->get(by.vector(), b, dp.data());
        d.kernels.advance(d.tables, model, with_local(cells.cells(b), &z, b * size_of_local()), dp.data(), to.begin(), alpha,
                          &trial_z.values[b * size_of_local()], d.scratch());
      }
  }

  std::unique_ptr<Linearisation> Muscle3dSystem::make_linearisation() const
  {
    return std::make_unique<Muscle3dLinearisation>(parameters_, *discretisation_, *materials_, *surface_forces_, ledger_);
  }

  void Muscle3dSystem::linearise(const Point &point, Linearisation &linearisation) const
  {
    dynamic_cast<Muscle3dLinearisation &>(linearisation).refill(point, activation(point.t, point.side));
  }

  std::vector<Vector> Muscle3dSystem::rigid_motions(const Vector &w) const
  {
    std::vector<Vector> fields(6, still_state().u);
    for (unsigned int e = 0; e < 3; ++e)
      for (unsigned int i = 0; i < w.locally_owned_size(); i += 3)
        {
          fields[e].local_element(i + e)               = 1;
          fields[3 + e].local_element(i + (e + 1) % 3) = -w.local_element(i + (e + 2) % 3);
          fields[3 + e].local_element(i + (e + 2) % 3) = w.local_element(i + (e + 1) % 3);
        }
    return fields;
  }

  std::vector<double> Muscle3dSystem::events(const double t0, const double t1) const
  {
    std::vector<double> times;
    const auto          add = [&](const Drive &drive) {
      const std::vector<double> kinks = drive.kinks(t0, t1);
      times.insert(times.end(), kinks.begin(), kinks.end());
    };
    for (const auto &condition : parameters_.boundary)
      for (const Drive *drive : condition->drives())
        add(*drive);
    for (const Drive *drive : parameters_.activation_drives())
      add(*drive);
    return one_list(std::move(times));
  }
} // namespace myolines
