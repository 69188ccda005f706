// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/preconditioner.h>

#if defined(__GLIBC__)
#  include <malloc.h>
#endif

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    struct Settings
    {
      unsigned int degree; ///< of the Chebyshev polynomial
      double       range;  ///< largest over smallest eigenvalue that is damped
      std::string  coarse; ///< solver of the coarse problem
      std::size_t  direct_up_to;
    };

    /// The spectrum of S J is bounded by the overlap of the patches where J is positive definite; unsymmetric rate terms
    /// move it a little beyond.
    constexpr double margin = 1.1;

    /// Symmetric two-level cycle. Chebyshev polynomials in S J smooth on the fine level, S additive Schwarz on the stars of
    /// vertices; the Galerkin matrix of the coarse level is solved directly or by one cycle of ML. The upper end of the
    /// smoothed interval is known, not estimated: nothing here is random.
    class PMultigrid : public Preconditioner
    {
    public:
      PMultigrid(const Settings &settings, WorkLedger &ledger)
        : settings_(settings)
        , ledger_(ledger)
      {}

      void build(const TangentOperator &tangent) override
      {
        tangent_ = &tangent;
        levels_  = tangent.two_level();
        if (levels_ == nullptr)
          throw std::runtime_error("p multigrid: the system has no coarser level; use another preconditioner");
        if (const unsigned int indefinite = levels_->patches.invert(); indefinite > 0)
          ledger_.count("indefinite patches", indefinite);
        {
          const WorkLedger::Timer timer(ledger_, "coarse set-up");
          if (!coarse_)
            coarse_ =
                settings_.coarse == "direct" || (settings_.coarse == "automatic" && levels_->coarse_layout.size() <= settings_.direct_up_to)
                    ? make_direct()
                    : make_ml();
          coarse_->factorise(levels_->coarse, &levels_->coarse_data);
          if (!coarse_->reads_matrix())
            release_entries(levels_->coarse);
        }
        give_back();
        for (Vector *x : {&r_, &z_, &d_, &Ad_})
          if (x->size() != tangent.layout().size())
            *x = tangent.layout();
        if (settings_.degree > 1 && s_.size() != tangent.layout().size())
          s_ = tangent.layout();
        if (r_coarse_.size() != levels_->coarse_layout.size())
          {
            r_coarse_ = z_coarse_ = levels_->coarse_layout;
            coarse_free_          = std::make_unique<FreeUnknowns>(levels_->coarse_constraints, r_coarse_);
          }
      }

      unsigned int set_up_cost() const override { return 15; }

      void apply(const double *r, double *z) const override
      {
        // Smoothing before and behind the coarse correction with one polynomial makes the cycle symmetric, as cg wants it.
        const unsigned int n = r_.locally_owned_size();
        std::copy_n(r, n, r_.begin());
        z_              = 0;
        const double in = smooth();
        act(d_, Ad_);
        r_.add(-in, Ad_); // r - J z
        z_.add(in, d_);
        correct();
        act(z_, Ad_);
        std::transform(r, r + n, Ad_.begin(), r_.begin(), std::minus<double>());
        const double out = smooth();
        std::transform(z_.begin(), z_.begin() + n, d_.begin(), z, [out](const double z, const double d) { return z + out * d; });
      }

    private:
      /// The set-up of the coarse level takes and frees many arrays of all sizes. What it has left between others stays with the process
      /// unless it is told.
      static void give_back()
      {
#if defined(__GLIBC__)
        malloc_trim(0);
#endif
      }

      /// y = J x of the patches.
      void act(const Vector &x, Vector &y) const
      {
        const WorkLedger::Timer timer(ledger_, "smoother action");
        const FreeUnknowns     &free = tangent_->free_unknowns();
        if (free.related())
          {
            all_ = x;
            free.distribute(all_);
            levels_->action(all_, y);
          }
        else
          {
            x.update_ghost_values();
            levels_->action(x, y);
            x.zero_out_ghost_values();
          }
        free.condense(y);
      }

      void schwarz(const Vector &r, Vector &z) const
      {
        const WorkLedger::Timer timer(ledger_, "schwarz");
        levels_->patches.apply(r, z);
      }

      /// z_ += P C (C^T P^T J P C)^(-1) C^T P^T r_, C the relations of the coarse level if there are any.
      void correct() const
      {
        const WorkLedger::Timer timer(ledger_, "coarse solve");
        levels_->interpolation.restrict_to(r_, r_coarse_);
        if (coarse_free_->related())
          coarse_free_->condense(r_coarse_);
        z_coarse_.zero_out_ghost_values();
        coarse_->apply(r_coarse_.begin(), z_coarse_.begin());
        if (coarse_free_->related())
          coarse_free_->distribute(z_coarse_);
        levels_->interpolation.add(z_coarse_, z_);
      }

      /// z_ += p(S J) S r_ but for the last summand, which is d_ times what is returned; r_ is the residual before it.
      /// p by the recurrence of Chebyshev iteration (Saad, doi:10.1137/1.9780898718003, algorithm 12.1), which damps all eigenvalues of S J
      /// between lower and upper alike; smaller ones are left to the coarse level.
      double smooth() const
      {
        const double upper = margin * levels_->patches.overlap(), lower = upper / settings_.range;
        const double centre = (upper + lower) / 2, half = (upper - lower) / 2, sigma = centre / half;
        double       rho = 1 / sigma, weight = 1 / centre;
        schwarz(r_, d_);
        for (unsigned int k = 1; k < settings_.degree; ++k)
          {
            z_.add(weight, d_);
            act(d_, Ad_);
            r_.add(-weight, Ad_);
            schwarz(r_, s_);
            const double next = 1 / (2 * sigma - rho);
            d_.sadd(next * rho * weight, 2 * next / half, s_);
            weight = 1;
            rho    = next;
          }
        return weight;
      }

      const Settings                        settings_;
      WorkLedger                           &ledger_;
      const TangentOperator                *tangent_ = nullptr;
      TwoLevel                             *levels_  = nullptr;
      std::unique_ptr<MatrixPreconditioner> coarse_;
      std::unique_ptr<FreeUnknowns>         coarse_free_;
      mutable Vector                        r_, z_, s_, d_, Ad_, all_, r_coarse_, z_coarse_;
    };

    const Settings defaults{1, 2, "automatic", 1000};
  } // namespace

  std::unique_ptr<Preconditioner> make_p_multigrid(WorkLedger &ledger) { return std::make_unique<PMultigrid>(defaults, ledger); }

  PreconditionerEntry p_multigrid_preconditioner_entry()
  {
    using scene::Range;
    PreconditionerEntry entry;
    entry.name    = "p multigrid";
    entry.summary = "Vertex-star Schwarz inside Chebyshev polynomials, and the Galerkin matrix of degree 1.";
    entry.schema  = scene::Schema(entry.summary);
    entry.schema.integer("smoother degree", defaults.degree, Range::closed(1, 20), "Degree of the Chebyshev polynomial.")
        .number("smoothing range", defaults.range, "-", Range{1, 1000, true, false},
                "Quotient of the largest and the smallest eigenvalue that is damped.")
        .choice("coarse solver", defaults.coarse, {"automatic", "direct", "ml"}, "Solver of the coarse problem.")
        .integer("direct up to", defaults.direct_up_to, Range::not_negative(),
                 "Largest number of coarse unknowns that automatic solves directly.");
    entry.make = [](const scene::Node &node, const PreconditionerContext &context) {
      return std::make_unique<PMultigrid>(Settings{static_cast<unsigned int>(node.integer("smoother degree")),
                                                   node.number("smoothing range"), node.text("coarse solver"),
                                                   static_cast<std::size_t>(node.integer("direct up to"))},
                                          context.ledger);
    };
    return entry;
  }
} // namespace myolines
