// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/free_unknowns.h>

namespace myolines
{
  FreeUnknowns::FreeUnknowns(const Constraints &constraints, const Vector &layout)
  {
    const auto &partition = *layout.get_partitioner();
    for (const auto &line : constraints.get_lines())
      if (partition.in_local_range(line.index))
        {
          const unsigned int row = partition.global_to_local(line.index);
          rows_.push_back(row);
          if (!line.entries.empty())
            relations_.push_back({row, {line.entries.begin(), line.entries.end()}});
        }
    related_ = dealii::Utilities::MPI::max(relations_.empty() ? 0 : 1, layout.get_mpi_communicator()) == 1;
  }

  void FreeUnknowns::condense(Vector &f) const
  {
    if (related_)
      {
        f.zero_out_ghost_values();
        for (const Relation &relation : relations_)
          for (const auto &[index, weight] : relation.entries)
            f(index) += weight * f.local_element(relation.row);
        f.compress(dealii::VectorOperation::add);
      }
    clear_constrained(f);
  }

  void FreeUnknowns::clear_constrained(Vector &x) const
  {
    for (const unsigned int row : rows_)
      x.local_element(row) = 0;
  }

  void FreeUnknowns::distribute(Vector &x) const
  {
    clear_constrained(x);
    x.update_ghost_values();
    if (!related_)
      return;
    for (const Relation &relation : relations_)
      {
        double value = 0;
        for (const auto &[index, weight] : relation.entries)
          value += weight * x(index);
        x.local_element(relation.row) = value;
      }
    x.update_ghost_values();
  }
} // namespace myolines
