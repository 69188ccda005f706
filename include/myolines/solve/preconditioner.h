#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/linearisation.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// An approximate inverse of an assembled matrix. Works on the owned entries of a rank as plain arrays, so that it
  /// fits any vector type. The matrix must outlive its use here.
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    /// Prepares for @p matrix; @p multilevel may be null. Called again whenever the values have moved on.
    /// @throws std::runtime_error with the reason if the matrix does not allow it (singular, zero diagonal).
    virtual void build(const SparseMatrix &matrix, const MultilevelData *multilevel) = 0;

    /// z = P r, with P close to the inverse of the matrix of the last build(). @p r and @p z do not overlap.
    virtual void apply(const double *r, double *z) const = 0;

    /// True if P is the inverse up to round-off.
    virtual bool exact() const { return false; }
  };

  /// Facts about a preconditioner and how to make one, for `list` and the schema.
  struct PreconditionerEntry
  {
    std::string                                                                                 name;
    std::string                                                                                 summary;
    scene::Schema                                                                               schema;
    std::function<std::unique_ptr<Preconditioner>(const scene::Node &, std::size_t n_unknowns)> make;
  };

  /// All preconditioners: automatic, ml, jacobi, direct.
  const std::vector<PreconditionerEntry> &preconditioner_registry();

  PreconditionerEntry direct_preconditioner_entry();
  PreconditionerEntry ml_preconditioner_entry();
  PreconditionerEntry jacobi_preconditioner_entry();
} // namespace myolines
