// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/csv_file.h>
#include <myolines/output/dense_output.h>
#include <myolines/system/instants.h>
#include <myolines/time/combination.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  State interpolate(const State &begin, const State &end, const double t, const bool inertia)
  {
    State        state = end;
    const double h = end.t - begin.t, s = (t - begin.t) / h;
    if (inertia)
      {
        const double slope = 6 * s * (1 - s) / h;
        combine(state.u, {{(1 + 2 * s) * (1 - s) * (1 - s), &begin.u},
                          {s * (1 - s) * (1 - s) * h, &begin.v},
                          {s * s * (3 - 2 * s), &end.u},
                          {s * s * (s - 1) * h, &end.v}});
        combine(state.v, {{-slope, &begin.u}, {slope, &end.u}, {(1 - s) * (1 - 3 * s), &begin.v}, {s * (3 * s - 2), &end.v}});
      }
    else
      {
        combine(state.u, {{1 - s, &begin.u}, {s, &end.u}});
        combine(state.v, {{-1 / h, &begin.u}, {1 / h, &end.u}});
      }
    combine(state.a, {{1 - s, &begin.a}, {s, &end.a}});
    state.t = t;
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->update_ghost_values();
    return state;
  }

  Instants multiples_of(const double interval)
  {
    return [interval](const double from) {
      double n = std::ceil(from / interval);
      while (n * interval < from) // the quotient was rounded
        ++n;
      while ((n - 1) * interval >= from)
        --n;
      return n * interval + 0.; // no negative zero
    };
  }

  Instants instants(std::vector<double> ascending)
  {
    return [times = std::move(ascending)](const double from) {
      const auto next = std::lower_bound(times.begin(), times.end(), from);
      return next == times.end() ? std::numeric_limits<double>::infinity() : *next;
    };
  }

  DenseOutput::DenseOutput(Instants instants, std::string name, const OutputFolder &folder, const bool inertia)
    : first_from_(std::move(instants))
    , name_(std::move(name))
    , inertia_(inertia)
  {
    if (folder.saved != nullptr && folder.saved->has_numbers(name_))
      written_ = folder.saved->number(name_);
  }

  double DenseOutput::after(const double t) const { return first_from_(std::nextafter(t, std::numeric_limits<double>::infinity())); }

  /// The instants may be others than those of the run that was saved.
  void DenseOutput::resume(const State &state, std::size_t)
  {
    next_ = after(std::max(state.t, written_));
    last_ = state;
  }

  void DenseOutput::begin(const State &state)
  {
    next_ = first_from_(state.t - time_tolerance(state.t));
    if (same_time(next_, state.t))
      {
        write(written_ = next_, state);
        next_ = after(next_);
      }
    last_ = state;
  }

  void DenseOutput::accepted(const State &state, const StepRecord &record)
  {
    const auto now = [&] { return same_time(next_, state.t, record.dt); };
    for (; next_ <= state.t || now(); next_ = after(next_))
      write(written_ = next_, now() ? state : interpolate(last_, state, next_, inertia_));
    last_ = state;
  }

  namespace
  {
    class Motion : public DenseOutput
    {
    public:
      Motion(const double interval, const std::vector<std::string> &columns, std::function<std::vector<double>(const State &)> values,
             const OutputFolder &folder, const bool inertia)
        : DenseOutput(multiples_of(interval), "end of motion.csv", folder, inertia)
        , values_(std::move(values))
        , csv_(folder, {"motion.csv", "Motion at equal intervals"}, columns)
      {}

      void save(Archive &archive) const override
      {
        DenseOutput::save(archive);
        csv_.save(archive);
      }

    private:
      void write(const double t, const State &state) override
      {
        std::vector<double> row = values_(state);
        row.insert(row.begin(), t);
        csv_.row(row);
      }

      const std::function<std::vector<double>(const State &)> values_;
      CsvFile                                                 csv_;
    };
  } // namespace

  scene::Schema motion_schema(const std::string &content)
  {
    scene::Schema motion("At equal intervals, interpolated within steps: motion.csv, " + content + ".");
    motion.number("interval", std::nullopt, "s", scene::Range::positive(), "Rows are at its multiples, whatever the steps are.");
    return motion;
  }

  std::unique_ptr<Observer> make_motion(const scene::Node &motion, std::vector<std::string> columns,
                                        std::function<std::vector<double>(const State &)> values, const OutputFolder &folder,
                                        const bool inertia)
  {
    columns.insert(columns.begin(), "Time [s]");
    return std::make_unique<Motion>(motion.number("interval"), columns, std::move(values), folder, inertia);
  }
} // namespace myolines
