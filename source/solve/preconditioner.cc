#include <myolines/solve/preconditioner.h>

#include <stdexcept>

namespace myolines
{
  namespace
  {
    class Jacobi : public Preconditioner
    {
    public:
      void build(const SparseMatrix &matrix, const MultilevelData *) override
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

      void apply(const double *r, double *z) const override
      {
        for (std::size_t i = 0; i < inverse_.size(); ++i)
          z[i] = inverse_[i] * r[i];
      }

    private:
      std::vector<double> inverse_;
    };

    /// The options of "automatic" are those of its two alternatives and the size that decides. Measured on the active 3D
    /// muscle, seconds per step of direct and ml: 1.1 and 3.6 (14,739 unknowns), 18 and 44 (107,811).
    PreconditionerEntry automatic_entry()
    {
      PreconditionerEntry direct = direct_preconditioner_entry();
      PreconditionerEntry ml     = ml_preconditioner_entry();

      PreconditionerEntry entry;
      entry.name    = "automatic";
      entry.summary = "direct up to a number of unknowns, ml above.";
      entry.schema  = ml.schema;
      entry.schema.integer(
          "direct up to", 120000, scene::Range::not_negative(),
          "Largest number of unknowns for which direct is taken; the factors of 107,811 take 3 GB and half the time of ml.");
      entry.make = [direct, ml](const scene::Node &node, const std::size_t n_unknowns) {
        return (n_unknowns <= static_cast<std::size_t>(node.integer("direct up to")) ? direct : ml).make(node, n_unknowns);
      };
      return entry;
    }
  } // namespace

  PreconditionerEntry jacobi_preconditioner_entry()
  {
    PreconditionerEntry entry;
    entry.name    = "jacobi";
    entry.summary = "Inverse of the diagonal.";
    entry.schema  = scene::Schema(entry.summary);
    entry.make    = [](const scene::Node &, std::size_t) { return std::make_unique<Jacobi>(); };
    return entry;
  }

  const std::vector<PreconditionerEntry> &preconditioner_registry()
  {
    static const std::vector<PreconditionerEntry> entries = {automatic_entry(), ml_preconditioner_entry(), jacobi_preconditioner_entry(),
                                                             direct_preconditioner_entry()};
    return entries;
  }
} // namespace myolines
