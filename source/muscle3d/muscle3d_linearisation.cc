// SPDX-License-Identifier: LGPL-2.1-or-later
#include "muscle3d_linearisation.h"

#include <myolines/fem/rigid_body_modes.h>

namespace myolines
{
  void count_terms(const KernelModel &model, const char *sweep, WorkLedger &ledger)
  {
    if (model.active)
      ledger.count(std::string("active stress in ") + sweep);
    if (model.rate)
      ledger.count(std::string("force-velocity in ") + sweep);
    if (model.viscous)
      ledger.count(std::string("viscosity in ") + sweep);
    if (model.inertia)
      ledger.count(std::string("mass in ") + sweep);
  }

  void of_step(const Point &point, const double *before, KernelModel &model)
  {
    model.before      = before;
    model.dissipation = point.dissipation;
  }

  KernelCells with_local(KernelCells cells, const LocalUnknowns *local, const std::size_t at)
  {
    if (local != nullptr)
      cells.local = &local->values[at];
    return cells;
  }

  Muscle3dLinearisation::Muscle3dLinearisation(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation,
                                               const PointMaterials &materials, const SurfaceForces &surface, WorkLedger &ledger)
    : parameters_(parameters)
    , discretisation_(discretisation)
    , materials_(materials)
    , surface_(surface)
    , ledger_(ledger)
    , u_(discretisation.space->make_vector())
    , v_(u_)
  {}

  void Muscle3dLinearisation::refill(const Point &point, const Activation &activation)
  {
    model_               = kernel_model(parameters_, activation);
    model_.keep_gradient = keeps_gradient(discretisation_.instruction_set);
    u_                   = point.u;
    u_.update_ghost_values();
    if (point.before != nullptr)
      {
        before_ = *point.before;
        before_.update_ghost_values();
        of_step(point, before_.begin(), model_);
      }
    if (model_.velocities() || surface_.rates())
      {
        v_ = point.v;
        v_.update_ghost_values();
      }
    local_ = point.local != nullptr ? *point.local : LocalUnknowns();
    if (surface_.any())
      find_faces(point);
    current_          = false;
    tangents_.current = false;
    ledger_.count("linearisations");
  }

  void Muscle3dLinearisation::find_faces(const Point &point)
  {
    faces_ =
        surface_.tangents({point.t, point.side, u_, v_, point.a, nullptr, point.before != nullptr ? &before_ : nullptr, point.dissipation},
                          !parameters_.exact_tangent);
    if (faces_of_.empty())
      for (std::size_t i = 0; i < faces_.size(); ++i)
        faces_of_[faces_[i].cell->id()].push_back(i);
  }

  namespace
  {
    /// w.u K + w.v C of a face.
    double entry(const SurfaceForces::Tangent &face, const Weights &w, const unsigned int i, const unsigned int j)
    {
      return w.u * face.stiffness(i, j) + (face.damping.empty() ? 0. : w.v * face.damping(i, j));
    }
  } // namespace

  void Muscle3dLinearisation::add_faces(const CellBatches &batches, const unsigned int b, const Weights &w, double *element_matrices) const
  {
    const std::size_t n = discretisation_.element.n_nodes, block = n * n * n_lanes;
    for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
      if (const auto found = faces_of_.find(batches.cell(b, lane)->id()); found != faces_of_.end())
        for (const std::size_t number : found->second)
          {
            const SurfaceForces::Tangent &face = faces_[number];
            for (unsigned int ia = 0; ia < face.stiffness.m(); ++ia)
              for (unsigned int jc = 0; jc < face.stiffness.n(); ++jc)
                element_matrices[(3 * (ia % 3) + jc % 3) * block + (face.places[ia / 3] * n + face.places[jc / 3]) * n_lanes + lane] +=
                    entry(face, w, ia, jc);
          }
  }

  void Muscle3dLinearisation::add_faces(const Weights &w, const Vector &x, Vector &y) const
  {
    for (const SurfaceForces::Tangent &face : faces_)
      if (face.cell->is_locally_owned())
        for (unsigned int ia = 0; ia < face.stiffness.m(); ++ia)
          {
            double sum = 0;
            for (unsigned int jc = 0; jc < face.stiffness.n(); ++jc)
              sum += entry(face, w, ia, jc) * x.local_element(3 * face.nodes[jc / 3] + jc % 3);
            y.local_element(3 * face.nodes[ia / 3] + ia % 3) += sum;
          }
  }

  /// Other quadratures of the same cells share the modes, hence the local unknowns.
  KernelCells Muscle3dLinearisation::cells(const CellSweep &sweep, const unsigned int b) const
  {
    return with_local(sweep.cells(b), local_.any() ? &local_ : nullptr, std::size_t(2) * b * sweep.element.n_modes * n_lanes);
  }

  void Muscle3dLinearisation::store(const CellSweep &sweep, const bool exact, Tangents &tangents) const
  {
    if (tangents.current && (!exact || !tangents.low.empty()))
      return;
    const unsigned int n_batches = sweep.batches.n_owned_batches();
    tangents.current             = true;
    tangents.size                = tangent_size(sweep.element.n_points, model_);
    tangents.volume_size         = std::size_t(VolumeLayout(sweep.element.n_modes).size) * n_lanes;
    tangents.high.resize(n_batches * tangents.size);
    tangents.low.resize(exact ? n_batches * tangents.size : 0);
    tangents.volume.resize(n_batches * tangents.volume_size);
    for (unsigned int b = 0; b < n_batches; ++b)
      discretisation_.kernels.linearise(sweep.tables, model_, cells(sweep, b), u_.begin(), v_.begin(), &tangents.high[b * tangents.size],
                                        exact ? &tangents.low[b * tangents.size] : nullptr, &tangents.volume[b * tangents.volume_size],
                                        discretisation_.scratch());
    ledger_.count("stored tangents");
    count_terms(model_, "stored tangent", ledger_);
  }

  KernelTangent Muscle3dLinearisation::tangent(const Tangents &tangents, const unsigned int batch, const bool exact) const
  {
    const std::size_t at   = batch * tangents.size;
    const bool        lean = lean_ && &tangents == &lean_->tangents;
    return {(lean ? lean_->u : u_).begin(), (lean ? lean_->v : v_).begin(), tangents.high.data() + at,
            exact ? tangents.low.data() + at : nullptr, tangents.volume_of(batch)};
  }

  void Muscle3dLinearisation::apply(const CellSweep &sweep, const Tangents &tangents, const bool exact, const KernelModel &model,
                                    const Weights &w, const Vector &x, Vector &y) const
  {
    const double k[3] = {w.u, w.v, w.a};
    y.zero_out_ghost_values();
    y = 0;
    for (unsigned int b = 0; b < sweep.batches.n_owned_batches(); ++b)
      discretisation_.kernels.apply(sweep.tables, model, sweep.cells(b), k, tangent(tangents, b, exact), x.begin(), y.begin(), nullptr,
                                    discretisation_.scratch());
    if (w.u != 0 || w.v != 0)
      add_faces(w, x, y);
    y.compress(dealii::VectorOperation::add);
  }

  /// Tangents are stored when an action first needs them: assembly and mass do without.
  void Muscle3dLinearisation::apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const
  {
    const CurrentGhosts current(x);
    const Weights      &w = weights[2];
    if (w.u != 0 || (w.v != 0 && model_.velocities()))
      store_tangents(true);
    apply(discretisation_.sweep(materials_), tangents_, true, model_, w, current.vector(), y);
    ledger_.count("tangent actions");
  }

  template <typename Consumer>
  void Muscle3dLinearisation::for_each_matrix(const CellSweep &sweep, const KernelModel &model, const Weights &w,
                                              const Consumer &consume) const
  {
    const double                  k[3] = {w.u, w.v, w.a};
    dealii::AlignedVector<double> element_matrices(std::size_t(9) * sweep.element.n_nodes * sweep.element.n_nodes * n_lanes);
    for (unsigned int b = 0; b < sweep.batches.n_batches(); ++b)
      {
        discretisation_.kernels.element_matrices(sweep.tables, model, cells(sweep, b), k, u_.begin(), v_.begin(), element_matrices.data(),
                                                 discretisation_.scratch());
        if (!faces_.empty() && (w.u != 0 || w.v != 0))
          add_faces(sweep.batches, b, w, element_matrices.data());
        consume(b, element_matrices.data());
      }
    count_terms(model, "assembly", ledger_);
  }

  KernelModel Muscle3dLinearisation::model(const bool softened) const
  {
    KernelModel model = model_;
    model.softened    = softened;
    return model;
  }

  const SparseMatrix &Muscle3dLinearisation::assemble(const WeightsByOrder &weights, const bool softened)
  {
    const Weights &w = weights[2];
    if (current_ && softened_ == softened && assembled_.u == w.u && assembled_.v == w.v && assembled_.a == w.a)
      return matrix_->matrix();

    ledger_.count("matrix assemblies");
    const Muscle3dDiscretisation &d = discretisation_;
    if (!matrix_)
      matrix_ = std::make_unique<BlockMatrix>(*d.space, *d.batches, d.element.n_nodes, d.constraints.lines);
    matrix_->clear();
    for_each_matrix(d.sweep(materials_), model(softened), w, [&](const unsigned int b, double *matrices) { matrix_->add(b, matrices); });
    matrix_->finish();
    assembled_ = w;
    softened_  = softened;
    current_   = true;
    return matrix_->matrix();
  }

  const MultilevelData *Muscle3dLinearisation::multilevel() const
  {
    if (!multilevel_)
      multilevel_ =
          std::make_unique<MultilevelData>(MultilevelData{3, rigid_body_modes(*discretisation_.space, discretisation_.constraints.lines)});
    return multilevel_.get();
  }

  Muscle3dLinearisation::LeanCells::LeanCells(const Muscle3dDiscretisation &d, const Muscle3dParameters &parameters)
    : element(d.space->degree(), d.space->degree() + 1)
    , batches(*d.space, element)
    , materials(parameters, batches, element, d.potential.get())
  {}

  CellSweep Muscle3dLinearisation::lean_sweep() const
  {
    return lean_ ? CellSweep{lean_->element, lean_->batches, lean_->materials} : discretisation_.sweep(materials_);
  }

  void Muscle3dLinearisation::make_two_level()
  {
    const Muscle3dDiscretisation &d = discretisation_;
    if (d.element.n_points_1d > d.element.n_nodes_1d)
      lean_ = std::make_unique<LeanCells>(d, parameters_);
    stars_ = std::make_unique<VertexStars>(
        *d.space, lean_sweep().batches, lean_sweep().element, d.constraints.lines,
        [this](const NodeSpace &coarse) { return BoundaryConstraints(parameters_.boundary, coarse).lines; }, d.instruction_set);
    two_level_ = std::make_unique<TwoLevel>(TwoLevel{stars_->patches(),
                                                     stars_->interpolation(),
                                                     stars_->coarse_matrix(),
                                                     {3, rigid_body_modes(stars_->coarse_space(), stars_->coarse_constraints())},
                                                     stars_->coarse_space().make_vector(),
                                                     stars_->coarse_constraints(),
                                                     {}});
  }

  TwoLevel *Muscle3dLinearisation::two_level(const WeightsByOrder &weights, const bool softened)
  {
    if (!two_level_)
      make_two_level();
    ledger_.count("patch assemblies");
    const Weights w = weights[2];
    stars_->clear();
    for_each_matrix(lean_sweep(), model(softened), w, [&](const unsigned int b, double *matrices) { stars_->add(b, matrices); });
    stars_->finish();
    if (lean_)
      {
        lean_->u                = u_;
        lean_->v                = v_;
        lean_->tangents.current = false;
        store(lean_sweep(), false, lean_->tangents);
      }
    two_level_->action = [this, w, softened, model = model(softened)](const Vector &x, Vector &y) {
      if (lean_)
        apply(lean_sweep(), lean_->tangents, false, model, w, x, y);
      else
        {
          store_tangents();
          apply(lean_sweep(), tangents_, false, this->model(softened), w, x, y);
        }
      ledger_.count(lean_ ? "lean tangent actions" : "smoother actions");
    };
    return two_level_.get();
  }
} // namespace myolines
