// SPDX-License-Identifier: LGPL-2.1-or-later
#include "blocked_rows.h"

#include <myolines/solve/preconditioner.h>

#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

#include <stdexcept>

namespace myolines
{
  namespace
  {
    /// The eigenvalue estimates of the smoothers start from random vectors: one seed makes runs reproducible.
    constexpr int seed = 20240229;

    /// Smoothed aggregation by ML with the near-null space of the system and Chebyshev smoothing.
    class Multilevel : public MatrixPreconditioner
    {
    public:
      Multilevel(const unsigned int sweeps, const double threshold, const unsigned int coarse_size)
        : sweeps_(sweeps)
        , threshold_(threshold)
        , coarse_size_(coarse_size)
      {}

      void factorise(const SparseMatrix &matrix, const MultilevelData *multilevel) override
      {
        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults("SA", list);
        list.set("ML output", 0);
        list.set("initialize random seed", false);
        list.set("aggregation: type", "Uncoupled");
        list.set("aggregation: threshold", threshold_);
        list.set("smoother: type", "Chebyshev");
        list.set("smoother: sweeps", static_cast<int>(sweeps_));
        list.set("smoother: pre or post", "both");
        list.set("coarse: type", "Amesos-KLU");
        list.set("coarse: max size", static_cast<int>(coarse_size_));
        if (multilevel != nullptr)
          add_null_space(*multilevel, list);

        ML_set_random_seed(seed);
        hierarchy_.reset();
        blocked_.reset();
        const Epetra_CrsMatrix &rows = matrix.trilinos_matrix();
        if (multilevel != nullptr && multilevel->unknowns_per_node == 3 && BlockedRows::suits(rows))
          blocked_ = std::make_unique<BlockedRows>(rows);
        const Epetra_RowMatrix &seen = blocked_ ? static_cast<const Epetra_RowMatrix &>(*blocked_) : rows;
        hierarchy_                   = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(seen, list, false);
        if (hierarchy_->ComputePreconditioner() != 0)
          throw std::runtime_error("ml: the hierarchy could not be built");
        map_ = &matrix.trilinos_matrix().OperatorRangeMap();
      }

      bool reads_matrix() const override { return blocked_ == nullptr; }

      unsigned int set_up_cost() const override { return 40; }

      void apply(const double *r, double *z) const override
      {
        const Epetra_Vector right(View, *map_, const_cast<double *>(r));
        Epetra_Vector       left(View, *map_, z);
        if (hierarchy_->ApplyInverse(right, left) != 0)
          throw std::runtime_error("ml: applying the hierarchy failed");
      }

    private:
      /// ML reads the modes one after the other from an array that must live as long as the hierarchy.
      void add_null_space(const MultilevelData &multilevel, Teuchos::ParameterList &list)
      {
        null_space_.clear();
        for (const Vector &mode : multilevel.near_null_space)
          null_space_.insert(null_space_.end(), mode.begin(), mode.end());
        list.set("PDE equations", static_cast<int>(multilevel.unknowns_per_node));
        if (null_space_.empty())
          return;
        list.set("null space: type", "pre-computed");
        list.set("null space: dimension", static_cast<int>(multilevel.near_null_space.size()));
        list.set("null space: vectors", null_space_.data());
        list.set("null space: add default vectors", false);
      }

      const unsigned int                                   sweeps_;
      const double                                         threshold_;
      const unsigned int                                   coarse_size_;
      std::vector<double>                                  null_space_;
      std::unique_ptr<BlockedRows>                         blocked_; ///< of the matrix, where it suits
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> hierarchy_;
      const Epetra_Map                                    *map_ = nullptr;
    };
  } // namespace

  namespace
  {
    constexpr int default_sweeps = 4, default_coarse_size = 1000;
  }

  std::unique_ptr<MatrixPreconditioner> make_ml() { return std::make_unique<Multilevel>(default_sweeps, 0, default_coarse_size); }

  PreconditionerEntry ml_preconditioner_entry()
  {
    using scene::Range;
    PreconditionerEntry entry;
    entry.name    = "ml";
    entry.summary = "Smoothed-aggregation multigrid (ML) with the near-null space of the system and Chebyshev smoothing.";
    entry.schema  = scene::Schema(entry.summary);
    entry.schema
        .integer("smoother sweeps", default_sweeps, Range::closed(1, 20),
                 "Degree of the Chebyshev smoother, before and after each coarse correction.")
        .number("aggregation threshold", 0, "-", Range{0, 1, false, true},
                "Couplings weaker than this fraction of the diagonal do not aggregate.")
        .integer("coarse size", default_coarse_size, Range::closed(1, 100000),
                 "Coarsening ends at this number of unknowns, solved directly.");
    entry.make = [](const scene::Node &node, const PreconditionerContext &) {
      return std::make_unique<Multilevel>(node.integer("smoother sweeps"), node.number("aggregation threshold"),
                                          node.integer("coarse size"));
    };
    return entry;
  }
} // namespace myolines
