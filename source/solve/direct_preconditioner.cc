// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/preconditioner.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    /// Up to this number of unknowns KLU is faster; on the 14,739 of a 3D muscle it takes 30 times as long as MUMPS.
    constexpr long long largest_for_klu = 500;

    /// Sparse LU by Amesos: KLU for small problems, MUMPS (distributed, multifrontal) for the others. Works on a copy of
    /// the matrix: Amesos asks the matrix for its communicator even while it is destroyed.
    class Direct : public MatrixPreconditioner
    {
    public:
      void factorise(const SparseMatrix &matrix, const MultilevelData *) override
      {
        const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
        if (!solver_ || !copy_values(epetra))
          begin(epetra);
        check(solver_->NumericFactorization(), "numeric");
      }

      unsigned int set_up_cost() const override { return 60; }

      void apply(const double *r, double *z) const override
      {
        const Epetra_Map &map = problem_->GetMatrix()->OperatorRangeMap();
        Epetra_Vector     right(View, map, const_cast<double *>(r));
        Epetra_Vector     left(View, map, z);
        problem_->SetRHS(&right);
        problem_->SetLHS(&left);
        check(solver_->Solve(), "solving with the");
      }

      bool exact() const override { return true; }

    private:
      /// False if the copy has another pattern: the analysis of the old one is of no use then.
      bool copy_values(const Epetra_CrsMatrix &matrix)
      {
        int    *from_rows, *from_columns, *to_rows, *to_columns;
        double *from = nullptr, *to = nullptr;
        if (matrix.ExtractCrsDataPointers(from_rows, from_columns, from) != 0 ||
            copy_->ExtractCrsDataPointers(to_rows, to_columns, to) != 0)
          return false;
        const int  rows = matrix.NumMyRows(), entries = matrix.NumMyNonzeros();
        const bool same = copy_->NumMyRows() == rows && copy_->NumMyNonzeros() == entries &&
                          std::equal(from_rows, from_rows + rows + 1, to_rows) &&
                          std::equal(from_columns, from_columns + entries, to_columns);
        int same_everywhere = 0, same_here = same;
        matrix.Comm().MinAll(&same_here, &same_everywhere, 1);
        if (same_everywhere == 1)
          std::copy_n(from, entries, to);
        return same_everywhere == 1;
      }

      void begin(const Epetra_CrsMatrix &matrix)
      {
        solver_.reset();
        copy_    = std::make_unique<Epetra_CrsMatrix>(matrix);
        problem_ = std::make_unique<Epetra_LinearProblem>();
        problem_->SetOperator(copy_.get());
        solver_.reset(Amesos().Create(copy_->NumGlobalRows64() <= largest_for_klu ? "Klu" : "Mumps", *problem_));
        Teuchos::ParameterList settings;
        settings.sublist("mumps").set("ICNTL(8)", 0); // no scaling: rows of one kind of force, diagonals alike
        solver_->SetParameters(settings);
        check(solver_->SymbolicFactorization(), "symbolic");
      }

      static void check(const int code, const std::string &phase)
      {
        if (code != 0)
          throw std::runtime_error("direct: " + phase + " factorisation failed with code " + std::to_string(code) +
                                   "; the matrix may be singular");
      }

      std::unique_ptr<Epetra_CrsMatrix>     copy_;
      std::unique_ptr<Epetra_LinearProblem> problem_;
      std::unique_ptr<Amesos_BaseSolver>    solver_;
    };
  } // namespace

  std::unique_ptr<MatrixPreconditioner> make_direct() { return std::make_unique<Direct>(); }

  PreconditionerEntry direct_preconditioner_entry()
  {
    PreconditionerEntry entry;
    entry.name    = "direct";
    entry.summary = "Sparse LU factorisation (Amesos: KLU for small problems, MUMPS above), kept while it converges fast.";
    entry.schema  = scene::Schema(entry.summary);
    entry.make    = [](const scene::Node &, const PreconditionerContext &) { return make_direct(); };
    return entry;
  }
} // namespace myolines
