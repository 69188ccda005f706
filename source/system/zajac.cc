// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/system/sampled.h>
#include <myolines/system/steered_drive.h>
#include <myolines/system/zajac.h>

#include <algorithm>

namespace myolines
{
  struct ZajacActivation::Table
  {
    struct Row
    {
      double t, a, rate_left, rate_right; ///< the excitation may jump
    };

    static constexpr double step  = 4e-4; ///< [s]
    static constexpr double chunk = 0.25; ///< [s]

    Table(const Zajac &zajac_, const Drive &excitation_, const double start_)
      : zajac(zajac_)
      , excitation(excitation_)
      , start(start_)
    {
      if (const auto *samples = dynamic_cast<const SampledDrive *>(&excitation))
        start = samples->begin();
      rows.push_back({start, zajac.steady(excitation.value(start, Side::right)), 0, 0});
    }

    double rate(const double t, const Side side, const double a) const { return zajac.rate(excitation.value(t, side), a); }

    void go_to(const double t)
    {
      const Row    last = rows.back();
      const double h = t - last.t, middle = last.t + h / 2;
      const double k1 = rate(last.t, Side::right, last.a), k2 = rate(middle, Side::left, last.a + h / 2 * k1),
                   k3 = rate(middle, Side::left, last.a + h / 2 * k2), k4 = rate(t, Side::left, last.a + h * k3);
      const double a = last.a + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      rows.push_back({t, a, rate(t, Side::left, a), rate(t, Side::right, a)});
    }

    /// In chunks that do not depend on what is asked for.
    void reach(const double t)
    {
      while (rows.back().t < t)
        {
          const double        begin = start + chunks * chunk, end = start + ++chunks * chunk;
          std::vector<double> instants;
          for (unsigned int i = 1; begin + i * step < end - step / 2; ++i)
            instants.push_back(begin + i * step);
          for (const double kink : excitation.kinks(begin, end))
            instants.push_back(kink);
          instants.push_back(end);
          std::sort(instants.begin(), instants.end());
          for (const double instant : instants)
            if (instant > rows.back().t)
              go_to(instant);
        }
    }

    /// The two rows around @p t after the start.
    std::pair<const Row &, const Row &> around(const double t)
    {
      reach(t);
      const auto next = std::lower_bound(rows.begin(), rows.end(), t, [](const Row &row, double x) { return row.t < x; });
      return {*(next - 1), *next};
    }

    const Zajac      zajac;
    const Drive     &excitation;
    double           start; ///< [s]
    std::vector<Row> rows;
    unsigned int     chunks = 0;
  };

  ZajacActivation::ZajacActivation(const Zajac &zajac, std::shared_ptr<const Drive> excitation)
    : zajac_(zajac)
    , excitation_(std::move(excitation))
    , table_(std::make_unique<Table>(zajac_, *excitation_, 0.))
  {
    if (const auto steering = steering_of(excitation_.get()))
      steering->refuse("the activation follows from this excitation beforehand, so that nobody can steer it",
                       "an excitation that is known, or an activation that is steered or solved with the motion");
  }

  ZajacActivation::~ZajacActivation() = default;

  void ZajacActivation::begin(const double run_start) const
  {
    const double memory = 40 * zajac_.time_constant / zajac_.ratio; // e^-40 is less than rounding
    table_              = std::make_unique<Table>(zajac_, *excitation_, run_start < 0 ? run_start : std::max(0., run_start - memory));
  }

  const ZajacActivation *from_excitation(const Drive *drive) { return dynamic_cast<const ZajacActivation *>(drive); }

  bool ZajacActivation::is_before_start(const double t, const Side side) const
  {
    return t < table_->start || (t == table_->start && side == Side::left);
  }

  double ZajacActivation::value(const double t, Side) const
  {
    if (t <= table_->start)
      return table_->rows.front().a;
    const auto [begin, end] = table_->around(t);
    const double h = end.t - begin.t, s = (t - begin.t) / h;
    return (1 + 2 * s) * (1 - s) * (1 - s) * begin.a + s * s * (3 - 2 * s) * end.a +
           s * (1 - s) * h * ((1 - s) * begin.rate_right - s * end.rate_left);
  }

  double ZajacActivation::first_derivative(const double t, const Side side) const
  {
    return is_before_start(t, side) ? 0 : zajac_.rate(excitation_->value(t, side), value(t, side));
  }

  /// From the equation, differentiated.
  double ZajacActivation::second_derivative(const double t, const Side side) const
  {
    if (is_before_start(t, side))
      return 0;
    const double u = excitation_->value(t, side), du = excitation_->first_derivative(t, side), a = value(t, side);
    return ((1 - (1 - zajac_.ratio) * a) * du - zajac_.decay(u) * zajac_.rate(u, a)) / zajac_.time_constant;
  }
} // namespace myolines
