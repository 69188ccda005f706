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
    : layout_{n_entries, 0, communicator, nullptr}
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
        column.wide    = LargeArray<double>(layout_.n);
        column.entries = column.wide.data();
        if (keep && !column.narrow.empty())
          std::copy(column.narrow.begin(), column.narrow.end(), column.entries);
        column.narrow = LargeArray<float>();
      }
    return column.entries;
  }

  /// The entries of @p column; those that are not kept as doubles are put into @p room.
  const double *KrylovVectors::readable(const Column &column, std::vector<double> &room) const
  {
    if (column.entries != nullptr)
      return column.entries;
    room.assign(layout_.n, 0.);
    std::copy(column.narrow.begin(), column.narrow.end(), room.begin());
    return room.data();
  }

  /// Somebody else's entries stay as they are.
  void KrylovVectors::round(Column &column) const
  {
    if (column.wide.empty())
      return;
    column.narrow = LargeArray<float>(layout_.n);
    std::transform(column.wide.begin(), column.wide.end(), column.narrow.begin(),
                   [](const double entry) { return static_cast<float>(entry); });
    column.wide    = LargeArray<double>();
    column.entries = nullptr;
  }

  void KrylovVectors::set(const KrylovVectors &x, const std::function<void(const double *, double *)> &action, const bool round_operand,
                          const bool round_result)
  {
    std::vector<double> room;
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        if (round_operand)
          round(*x.columns_.at(j));
        action(readable(*x.columns_.at(j), room), writable(*columns_[j], false));
        if (round_result)
          round(*columns_[j]);
      }
  }

  double KrylovVectors::dot(const Column &x, const Column &y) const
  {
    if (x.entries == nullptr && y.entries != nullptr)
      return x.narrow.empty() ? 0 : dot_entries(layout_.n, x.narrow.data(), y.entries);
    std::vector<double> room_x, room_y;
    return dot_entries(layout_.n, readable(x, room_x), readable(y, room_y));
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
    constexpr std::size_t piece = 2048;
    const auto           &from  = ours(A).columns_;
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
    std::vector<double> room_a, room_b;
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        const double *a = readable(*ours(A).columns_.at(j), room_a), *b = readable(*ours(B).columns_.at(j), room_b);
        double       *to = writable(*columns_[j], true); // it may be one of them
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
    const int           rows = ours(A).GetNumberVecs(), columns = GetNumberVecs();
    std::vector<double> products;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i)
        products.push_back(dot(*ours(A).columns_[i], *columns_[j]));
    sum(products.data(), rows * columns);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i)
        B(i, j) = alpha * products[j * rows + i];
  }

  void KrylovVectors::MvDot(const MultiVec<double> &A, std::vector<double> &b) const
  {
    b.resize(std::max(b.size(), columns_.size()));
    for (std::size_t j = 0; j < columns_.size(); ++j)
      b[j] = dot(*ours(A).columns_.at(j), *columns_[j]);
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
    std::vector<double> room;
    norms.assign(std::max(norms.size(), columns_.size()), 0.);
    for (std::size_t j = 0; j < columns_.size(); ++j)
      {
        const double *x = readable(*columns_[j], room);
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
