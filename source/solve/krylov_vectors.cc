// SPDX-License-Identifier: LGPL-2.1-or-later
#include "krylov_vectors.h"

#include <myolines/base/lanes.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace myolines
{
  namespace
  {
    using Eight = Lanes<InstructionSet::baseline>; // what every processor does at once; memory is slower

    constexpr std::size_t piece = 2048; ///< entries that stay in the nearest cache

    Eight       &eight(double *x) { return *reinterpret_cast<Eight *>(x); }
    const Eight &eight(const double *x) { return *reinterpret_cast<const Eight *>(x); }

    /// y += a x
    void add_entries(const std::size_t n, const double a, const double *x, double *y)
    {
      std::size_t i = 0;
      for (; i + n_lanes <= n; i += n_lanes)
        eight(y + i) += Eight(a) * eight(x + i);
      for (; i < n; ++i)
        y[i] += a * x[i];
    }
    void add_entries(const std::size_t n, const double a, const float *x, double *y)
    {
      for (std::size_t i = 0; i < n; ++i)
        y[i] += a * static_cast<double>(x[i]);
    }

    /// Always in the same order, for equal results.
    double dot_entries(const std::size_t n, const double *x, const double *y)
    {
      Eight       parts(0.);
      std::size_t i = 0;
      for (; i + n_lanes <= n; i += n_lanes)
        parts += eight(x + i) * eight(y + i);
      double sum = 0;
      for (int lane = 0; lane < n_lanes; ++lane)
        sum += parts[lane];
      for (; i < n; ++i)
        sum += x[i] * y[i];
      return sum;
    }

    double dot_entries(const std::size_t n, const float *x, const double *y)
    {
      double      parts[n_lanes] = {};
      std::size_t i              = 0;
      for (; i + n_lanes <= n; i += n_lanes)
        for (int lane = 0; lane < n_lanes; ++lane)
          parts[lane] += static_cast<double>(x[i + lane]) * y[i + lane];
      double sum = 0;
      for (const double part : parts)
        sum += part;
      for (; i < n; ++i)
        sum += static_cast<double>(x[i]) * y[i];
      return sum;
    }

    const KrylovVectors &ours(const Belos::MultiVec<double> &x) { return dynamic_cast<const KrylovVectors &>(x); }
  } // namespace

  KrylovVectors::KrylovVectors(double *entries, const std::size_t n_entries, const MPI_Comm communicator)
    : layout_{n_entries, 0, communicator, nullptr, std::make_shared<std::vector<LargeArray<double>>>()}
  {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    layout_.random = std::make_shared<std::minstd_rand>(1 + rank);
    long own = static_cast<long>(n_entries), all = 0;
    // in parentheses: PETSc, whose headers deal.II may bring, has a macro of this name that would make it be linked
    (MPI_Allreduce)(&own, &all, 1, MPI_LONG, MPI_SUM, communicator);
    layout_.n_global = all;
    columns_.push_back(std::make_shared<Column>());
    columns_[0]->entries = entries;
  }

  KrylovVectors::KrylovVectors(const Layout &layout, const int n_vectors)
    : layout_(layout)
  {
    for (int j = 0; j < n_vectors; ++j)
      columns_.push_back(std::make_shared<Column>());
  }

  KrylovVectors *KrylovVectors::chosen(const std::vector<int> &index) const
  {
    auto *view = new KrylovVectors(layout_, 0);
    for (const int j : index)
      view->columns_.push_back(columns_.at(j));
    return view;
  }

  double *KrylovVectors::writable(Column &column, const bool keep) const
  {
    if (column.entries == nullptr)
      {
        column.wide    = take();
        column.entries = column.wide.data();
        if (keep && !column.narrow.empty())
          std::copy(column.narrow.begin(), column.narrow.end(), column.entries);
        else if (keep)
          std::fill_n(column.entries, layout_.n, 0.);
        column.narrow = LargeArray<float>();
      }
    return column.entries;
  }

  LargeArray<double> KrylovVectors::take() const
  {
    if (layout_.spare->empty())
      return LargeArray<double>(layout_.n);
    LargeArray<double> array = std::move(layout_.spare->back());
    layout_.spare->pop_back();
    return array;
  }

  void KrylovVectors::give_back(LargeArray<double> &array) const
  {
    if (!array.empty())
      layout_.spare->push_back(std::move(array));
    array = LargeArray<double>();
  }

  /// Entries of a column as doubles, in room of its own where they are not kept so.
  class KrylovVectors::Readable
  {
  public:
    Readable(const KrylovVectors &vectors, const Column &column)
      : vectors_(vectors)
      , entries_(column.entries)
    {
      if (entries_ != nullptr)
        return;
      room_ = vectors_.take();
      if (column.narrow.empty())
        std::fill(room_.begin(), room_.end(), 0.);
      else
        std::copy(column.narrow.begin(), column.narrow.end(), room_.begin());
      entries_ = room_.data();
    }
    ~Readable() { vectors_.give_back(room_); }
    Readable(const Readable &)            = delete;
    Readable &operator=(const Readable &) = delete;

    const double *begin() const { return entries_; }

  private:
    const KrylovVectors &vectors_;
    LargeArray<double>   room_;
    const double        *entries_;
  };

  /// Somebody else's entries stay as they are.
  void KrylovVectors::round(Column &column) const
  {
    if (column.wide.empty())
      return;
    column.narrow = LargeArray<float>(layout_.n);
    std::transform(column.wide.begin(), column.wide.end(), column.narrow.begin(),
                   [](const double entry) { return static_cast<float>(entry); });
    column.entries = nullptr;
    give_back(column.wide);
  }

  void KrylovVectors::set(const KrylovVectors &x, const std::function<void(const double *, double *)> &action, const bool round_operand,
                          const bool round_result)
  {
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        if (round_operand)
          round(*x.columns_.at(j));
        const Readable operand(x, *x.columns_.at(j));
        action(operand.begin(), writable(*columns_[j], false));
        if (round_result)
          round(*columns_[j]);
      }
  }

  /// Piece by piece, each of which stays in the cache while many x are multiplied by it.
  void KrylovVectors::dot(const std::vector<const Column *> &x, const Column &y, double *products) const
  {
    std::fill_n(products, x.size(), 0.);
    const Readable entries(*this, y);
    for (std::size_t begin = 0; begin < layout_.n; begin += piece)
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          const std::size_t n = std::min(piece, layout_.n - begin);
          if (x[i]->entries != nullptr)
            products[i] += dot_entries(n, x[i]->entries + begin, entries.begin() + begin);
          else if (!x[i]->narrow.empty())
            products[i] += dot_entries(n, x[i]->narrow.data() + begin, entries.begin() + begin);
        }
  }

  std::size_t KrylovVectors::memory() const
  {
    std::size_t bytes = 0;
    for (const auto &column : columns_)
      bytes += column->wide.memory() + column->narrow.memory();
    return bytes;
  }

  Belos::MultiVec<double> *KrylovVectors::Clone(const int n_vectors) const { return new KrylovVectors(layout_, n_vectors); }

  Belos::MultiVec<double> *KrylovVectors::CloneCopy() const
  {
    auto *copy = new KrylovVectors(layout_, GetNumberVecs());
    copy->MvAddMv(1, *this, 0, *this);
    return copy;
  }

  Belos::MultiVec<double> *KrylovVectors::CloneCopy(const std::vector<int> &index) const
  {
    const std::unique_ptr<KrylovVectors> view(chosen(index));
    return view->CloneCopy();
  }

  Belos::MultiVec<double>       *KrylovVectors::CloneViewNonConst(const std::vector<int> &index) { return chosen(index); }
  const Belos::MultiVec<double> *KrylovVectors::CloneView(const std::vector<int> &index) const { return chosen(index); }

  /// What many vectors add to one is summed piece by piece, each of which stays in the cache.
  void KrylovVectors::MvTimesMatAddMv(const double alpha, const MultiVec<double> &A, const Matrix &B, const double beta)
  {
    const auto &from = ours(A).columns_;
    MvScale(beta);
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        double *to = writable(*columns_[j], true);
        for (std::size_t begin = 0; begin < layout_.n; begin += piece)
          for (std::size_t i = 0; i < from.size(); ++i)
            {
              const double      factor = alpha * B(static_cast<int>(i), static_cast<int>(j));
              const std::size_t n      = std::min(piece, layout_.n - begin);
              if (from[i]->entries != nullptr)
                add_entries(n, factor, from[i]->entries + begin, to + begin);
              else if (!from[i]->narrow.empty())
                add_entries(n, factor, from[i]->narrow.data() + begin, to + begin);
            }
      }
  }

  void KrylovVectors::MvAddMv(const double alpha, const MultiVec<double> &A, const double beta, const MultiVec<double> &B)
  {
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        const Readable of_A(*this, *ours(A).columns_.at(j)), of_B(*this, *ours(B).columns_.at(j));
        const double  *a = of_A.begin(), *b = of_B.begin();
        double        *to = writable(*columns_[j], true); // it may be one of them
        if (beta == 0)
          for (std::size_t i = 0; i < layout_.n; ++i)
            to[i] = alpha * a[i];
        else
          for (std::size_t i = 0; i < layout_.n; ++i)
            to[i] = alpha * a[i] + beta * b[i];
      }
  }

  void KrylovVectors::MvScale(const double alpha) { MvScale(std::vector<double>(columns_.size(), alpha)); }

  /// What is scaled by 0 is 0, whatever it was.
  void KrylovVectors::MvScale(const std::vector<double> &alpha)
  {
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        const bool empty = columns_[j]->entries == nullptr && columns_[j]->narrow.empty();
        if (alpha.at(j) == 1 || empty)
          continue;
        double *entries = writable(*columns_[j], true);
        if (alpha[j] == 0)
          std::fill_n(entries, layout_.n, 0.);
        else
          for (std::size_t i = 0; i < layout_.n; ++i)
            entries[i] *= alpha[j];
      }
  }

  void KrylovVectors::sum(double *values, const int n) const
  {
    (MPI_Allreduce)(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, layout_.communicator);
  }

  void KrylovVectors::MvTransMv(const double alpha, const MultiVec<double> &A, Matrix &B) const
  {
    const int                   rows = ours(A).GetNumberVecs(), columns = GetNumberVecs();
    std::vector<double>         products(std::size_t(rows) * columns);
    std::vector<const Column *> from;
    for (const auto &column : ours(A).columns_)
      from.push_back(column.get());
    for (int j = 0; j < columns; ++j)
      dot(from, *columns_[j], products.data() + j * rows);
    sum(products.data(), rows * columns);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i)
        B(i, j) = alpha * products[j * rows + i];
  }

  void KrylovVectors::MvDot(const MultiVec<double> &A, std::vector<double> &b) const
  {
    b.resize(std::max(b.size(), columns_.size()));
    for (std::size_t j = 0; j < columns_.size(); ++j)
      dot({ours(A).columns_.at(j).get()}, *columns_[j], &b[j]);
    sum(b.data(), GetNumberVecs());
  }

  void KrylovVectors::MvNorm(std::vector<double> &norms, const Belos::NormType type) const
  {
    if (type == Belos::TwoNorm)
      {
        MvDot(*this, norms);
        for (std::size_t j = 0; j < columns_.size(); ++j)
          norms[j] = std::sqrt(norms[j]);
        return;
      }
    norms.assign(std::max(norms.size(), columns_.size()), 0.);
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        const Readable entries(*this, *columns_[j]);
        const double  *x = entries.begin();
        for (std::size_t i = 0; i < layout_.n; ++i)
          norms[j] = type == Belos::OneNorm ? norms[j] + std::abs(x[i]) : std::max(norms[j], std::abs(x[i]));
      }
    (MPI_Allreduce)(MPI_IN_PLACE, norms.data(), GetNumberVecs(), MPI_DOUBLE, type == Belos::OneNorm ? MPI_SUM : MPI_MAX,
                    layout_.communicator);
  }

  void KrylovVectors::SetBlock(const MultiVec<double> &A, const std::vector<int> &index)
  {
    const std::unique_ptr<KrylovVectors> to(chosen(index));
    to->MvAddMv(1, A, 0, A);
  }

  void KrylovVectors::MvRandom()
  {
    std::uniform_real_distribution<double> random(-1, 1);
    for (const auto &column : columns_)
      std::generate_n(writable(*column, false), layout_.n, [&] { return random(*layout_.random); });
  }

  void KrylovVectors::MvInit(const double alpha)
  {
    for (const auto &column : columns_)
      std::fill_n(writable(*column, false), layout_.n, alpha);
  }

  void KrylovVectors::MvPrint(std::ostream &os) const
  {
    os << columns_.size() << " vectors of " << layout_.n_global << " entries, " << layout_.n << " on this rank\n";
  }
} // namespace myolines
