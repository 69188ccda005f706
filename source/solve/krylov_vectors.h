// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room.

#include <myolines/base/large_array.h>

#include <BelosMultiVec.hpp>
#include <BelosOperator.hpp>
#include <mpi.h>

#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace myolines
{
  /// Some distributed vectors, of which a rank has as many entries of each, as Belos sees them. One that was never written is zero and has
  /// no memory: a solver may ask for as many as it could need, and what it does not need costs nothing. Some are kept in single
  /// precision, see KrylovOperator.
  class KrylovVectors : public Belos::MultiVec<double>
  {
  public:
    using Matrix = Teuchos::SerialDenseMatrix<int, double>;

    /// One vector, whose entries are those at @p entries.
    KrylovVectors(double *entries, std::size_t n_entries, MPI_Comm communicator);

    /// y = action(x) for each vector. From then on those of @p x are kept in single precision if @p round_operand, and are rounded before
    /// the action sees them; those of y if @p round_result.
    void set(const KrylovVectors &x, const std::function<void(const double *x, double *y)> &action, bool round_operand, bool round_result);

    /// Bytes of all vectors that are kept now.
    std::size_t memory() const;

    // What Belos asks for.
    MultiVec<double>       *Clone(int n_vectors) const override;
    MultiVec<double>       *CloneCopy() const override;
    MultiVec<double>       *CloneCopy(const std::vector<int> &index) const override;
    MultiVec<double>       *CloneViewNonConst(const std::vector<int> &index) override;
    const MultiVec<double> *CloneView(const std::vector<int> &index) const override;
    ptrdiff_t               GetGlobalLength() const override { return layout_.n_global; }
    int                     GetNumberVecs() const override { return static_cast<int>(columns_.size()); }
    void                    MvTimesMatAddMv(double alpha, const MultiVec<double> &A, const Matrix &B, double beta) override;
    void                    MvAddMv(double alpha, const MultiVec<double> &A, double beta, const MultiVec<double> &B) override;
    void                    MvScale(double alpha) override;
    void                    MvScale(const std::vector<double> &alpha) override;
    void                    MvTransMv(double alpha, const MultiVec<double> &A, Matrix &B) const override;
    void                    MvDot(const MultiVec<double> &A, std::vector<double> &b) const override;
    void                    MvNorm(std::vector<double> &norms, Belos::NormType type) const override;
    void                    SetBlock(const MultiVec<double> &A, const std::vector<int> &index) override;
    void                    MvRandom() override;
    void                    MvInit(double alpha) override;
    void                    MvPrint(std::ostream &os) const override;

  private:
    struct Layout
    {
      std::size_t                       n;
      ptrdiff_t                         n_global;
      MPI_Comm                          communicator;
      std::shared_ptr<std::minstd_rand> random; ///< begins alike in every run

      /// Arrays that were written and are not needed: fresh memory costs more than a vector operation.
      std::shared_ptr<std::vector<LargeArray<double>>> spare;
    };
    struct Column
    {
      double            *entries = nullptr; ///< those of the array below, or somebody else's; none: it is narrow, or zero
      LargeArray<double> wide;
      LargeArray<float>  narrow;
    };

    KrylovVectors(const Layout &layout, int n_vectors);
    KrylovVectors *chosen(const std::vector<int> &index) const; ///< that share these columns

    class Readable;

    LargeArray<double> take() const; ///< entries are undefined
    void               give_back(LargeArray<double> &array) const;
    double            *writable(Column &column, bool keep) const; ///< with what it held if @p keep, else what is there is undefined
    void               round(Column &column) const;
    void dot(const std::vector<const Column *> &x, const Column &y, double *products) const; ///< over the entries of this rank
    void sum(double *values, int n) const;                                                   ///< over ranks

    Layout                               layout_;
    std::vector<std::shared_ptr<Column>> columns_;
  };

  /// A linear map of the owned entries of a rank, as Belos sees it.
  class KrylovOperator : public Belos::Operator<double>
  {
  public:
    /// What it is applied to, and what it gives, is kept in single precision from then on.
    struct Rounds
    {
      bool operand, result;
    };
    using Action = std::function<void(const double *x, double *y)>;

    explicit KrylovOperator(Action action, const Rounds rounds = {false, false})
      : action_(std::move(action))
      , rounds_(rounds)
    {}

    void Apply(const Belos::MultiVec<double> &x, Belos::MultiVec<double> &y, Belos::ETrans = Belos::NOTRANS) const override
    {
      dynamic_cast<KrylovVectors &>(y).set(dynamic_cast<const KrylovVectors &>(x), action_, rounds_.operand, rounds_.result);
    }

  private:
    const Action action_;
    const Rounds rounds_;
  };
} // namespace myolines
