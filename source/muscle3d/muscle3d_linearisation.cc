#include "muscle3d_linearisation.h"

namespace myolines
{
  void count_terms(const KernelModel &model, const char *sweep, WorkLedger &ledger)
  {
    if (model.active)
      ledger.count(std::string("active stress in ") + sweep);
    if (model.rate)
      ledger.count(std::string("force-velocity in ") + sweep);
    if (model.inertia)
      ledger.count(std::string("mass in ") + sweep);
  }

  namespace
  {
    /// Translations and rotations about the middle of the body, zero on constrained unknowns.
    std::vector<Vector> rigid_body_modes(const Muscle3dDiscretisation &d)
    {
      std::vector<Vector>   modes(6, d.space->make_vector());
      std::array<double, 3> middle{};
      std::size_t           n     = 0;
      const auto           &owned = d.space->nodes().locally_owned_dofs();
      for (const auto node : owned)
        {
          for (unsigned int c = 0; c < 3; ++c)
            middle[c] += d.space->node_position(node)[c];
          ++n;
        }
      for (double &m : middle)
        m = dealii::Utilities::MPI::sum(m, d.communicator) / dealii::Utilities::MPI::sum(double(n), d.communicator);
      for (const auto node : owned)
        {
          const dealii::Point<3> &x             = d.space->node_position(node);
          const double            r[3]          = {x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]};
          const double            entries[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}};
          for (unsigned int mode = 0; mode < 6; ++mode)
            for (unsigned int c = 0; c < 3; ++c)
              if (!d.constraints.is_constrained(3 * node + c))
                modes[mode](3 * node + c) = entries[mode][c];
        }
      return modes;
    }
  } // namespace

  Muscle3dLinearisation::Muscle3dLinearisation(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation,
                                               WorkLedger &ledger)
    : parameters_(parameters)
    , discretisation_(discretisation)
    , ledger_(ledger)
    , u_(discretisation.space->make_vector())
    , v_(u_)
  {}

  void Muscle3dLinearisation::refill(const Point &point, const double activation)
  {
    model_ = kernel_model(parameters_, activation);
    u_     = point.u;
    u_.update_ghost_values();
    if (model_.rate)
      {
        v_ = point.v;
        v_.update_ghost_values();
      }
    current_ = false;
    ledger_.count("linearisations");
  }

  void Muscle3dLinearisation::apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const
  {
    const CurrentGhosts current(x);
    const Weights      &w    = weights[2];
    const double        k[3] = {w.u, w.v, w.a};
    y.zero_out_ghost_values();
    y = 0;
    for (unsigned int b = 0; b < discretisation_.batches->n_owned_batches(); ++b)
      discretisation_.kernels.apply(discretisation_.tables, model_, discretisation_.kernel_cells(b), k, u_.begin(), v_.begin(),
                                    current.begin(), y.begin(), discretisation_.scratch());
    y.compress(dealii::VectorOperation::add);
    ledger_.count("tangent actions");
    count_terms(model_, "tangent action", ledger_);
  }

  const SparseMatrix &Muscle3dLinearisation::sparse(const WeightsByOrder &weights)
  {
    const Weights &w = weights[2];
    if (current_ && assembled_.u == w.u && assembled_.v == w.v && assembled_.a == w.a)
      return matrix_->matrix();

    ledger_.count("matrix assemblies");
    count_terms(model_, "assembly", ledger_);
    const Muscle3dDiscretisation &d = discretisation_;
    if (!matrix_)
      matrix_ = std::make_unique<BlockMatrix>(*d.space, *d.batches, d.element, d.constraints);

    const double                  k[3] = {w.u, w.v, w.a};
    dealii::AlignedVector<double> element_matrices(std::size_t(9) * d.element.n_nodes * d.element.n_nodes * n_lanes);
    matrix_->clear();
    for (unsigned int b = 0; b < d.batches->n_batches(); ++b)
      {
        d.kernels.element_matrices(d.tables, model_, d.kernel_cells(b), k, u_.begin(), v_.begin(), element_matrices.data(), d.scratch());
        matrix_->add(b, element_matrices.data());
      }
    assembled_ = w;
    current_   = true;
    return matrix_->matrix();
  }

  const MultilevelData *Muscle3dLinearisation::multilevel() const
  {
    if (!multilevel_)
      multilevel_ = std::make_unique<MultilevelData>(MultilevelData{3, rigid_body_modes(discretisation_)});
    return multilevel_.get();
  }
} // namespace myolines
