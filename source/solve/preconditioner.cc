// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/preconditioner.h>

#include <stdexcept>

namespace myolines
{
  namespace
  {
    class Jacobi : public MatrixPreconditioner
    {
    public:
      void factorise(const SparseMatrix &matrix, const MultilevelData *) override
      {
        inverse_.clear();
        const auto [begin, end] = matrix.local_range();
        for (auto row = begin; row < end; ++row)
          {
            const double entry = matrix.diag_element(row);
            if (entry == 0)
              throw std::runtime_error("jacobi: zero on the diagonal in row " + std::to_string(row));
            inverse_.push_back(1 / entry);
          }
      }

      unsigned int set_up_cost() const override { return 10; }

      void apply(const double *r, double *z) const override
      {
        for (std::size_t i = 0; i < inverse_.size(); ++i)
          z[i] = inverse_[i] * r[i];
      }

    private:
      std::vector<double> inverse_;
    };

    /// Measured on the active 3D muscle, see doc/results/performance.md.
    PreconditionerEntry automatic_entry()
    {
      PreconditionerEntry entry;
      entry.name = "automatic";
      entry.summary =
          "direct for small systems; above, p multigrid where the system has two levels, else ml. Where p multigrid takes so many "
          "iterations that sparse factors are cheaper, as in flat bodies, direct takes over.";
      entry.schema = scene::Schema(entry.summary);
      entry.schema
          .integer("direct up to", 5000, scene::Range::not_negative(),
                   "Largest number of unknowns for which direct is taken, if p multigrid could be.")
          .integer("direct without levels up to", 120000, scene::Range::not_negative(),
                   "The same if ml is the other choice; the factors of 107,811 unknowns of a muscle take 3 GB.");
      entry.make = [](const scene::Node &node, const PreconditionerContext &context) -> std::unique_ptr<Preconditioner> {
        const std::string choice = automatic_choice(node, context.n_unknowns, context.two_levels);
        if (choice == "direct")
          return make_direct();
        if (choice == "p multigrid")
          return make_p_multigrid(context.ledger);
        return make_ml();
      };
      return entry;
    }
  } // namespace

  std::string automatic_choice(const scene::Node &options, const std::size_t n_unknowns, const bool two_levels)
  {
    const long limit = options.integer(two_levels ? "direct up to" : "direct without levels up to");
    return n_unknowns <= static_cast<std::size_t>(limit) ? "direct" : two_levels ? "p multigrid" : "ml";
  }

  PreconditionerEntry jacobi_preconditioner_entry()
  {
    PreconditionerEntry entry;
    entry.name    = "jacobi";
    entry.summary = "Inverse of the diagonal.";
    entry.schema  = scene::Schema(entry.summary);
    entry.make    = [](const scene::Node &, const PreconditionerContext &) { return std::make_unique<Jacobi>(); };
    return entry;
  }

  const std::vector<PreconditionerEntry> &preconditioner_registry()
  {
    static const std::vector<PreconditionerEntry> entries = {automatic_entry(), p_multigrid_preconditioner_entry(),
                                                             ml_preconditioner_entry(), jacobi_preconditioner_entry(),
                                                             direct_preconditioner_entry()};
    return entries;
  }

  std::unique_ptr<Preconditioner> make_preconditioner(const scene::Node &preconditioner, const PreconditionerContext &context)
  {
    const std::string name = preconditioner.text("type");
    for (const PreconditionerEntry &entry : preconditioner_registry())
      if (entry.name == name)
        return entry.make(preconditioner, context);
    throw std::logic_error("preconditioner \"" + name + "\" is not registered");
  }
} // namespace myolines
