#include <myolines/output/csv_file.h>
#include <myolines/output/dense_output.h>
#include <myolines/time/combination.h>

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

  DenseOutput::DenseOutput(std::function<double(std::size_t)> instant, std::string name, const OutputFolder &folder, const bool inertia)
    : instant_(std::move(instant))
    , name_(std::move(name))
    , inertia_(inertia)
  {
    if (folder.saved != nullptr && folder.saved->has_numbers(name_))
      written_ = folder.saved->number(name_);
  }

  /// The instants may be others than those of the run that was saved.
  void DenseOutput::resume(const State &state, std::size_t)
  {
    while (instant_(next_) <= std::max(state.t, written_))
      ++next_;
    last_ = state;
  }

  void DenseOutput::begin(const State &state)
  {
    for (; instant_(next_) <= state.t; ++next_)
      if (instant_(next_) == state.t)
        write(written_ = state.t, state);
    last_ = state;
  }

  void DenseOutput::accepted(const State &state, const StepRecord &record)
  {
    const double same = 1e-9 * record.dt; // rounding in sums of steps does not make a time fall between two
    for (double t = instant_(next_); t <= state.t + same; t = instant_(++next_))
      write(written_ = t, t >= state.t - same ? state : interpolate(last_, state, t, inertia_));
    last_ = state;
  }

  namespace
  {
    class Motion : public DenseOutput
    {
    public:
      Motion(const double interval, const std::vector<std::string> &columns, std::function<std::vector<double>(const State &)> values,
             const OutputFolder &folder, const bool inertia)
        : DenseOutput([interval](const std::size_t i) { return interval * static_cast<double>(i); }, "end of motion.csv", folder, inertia)
        , values_(std::move(values))
        , csv_(folder, "motion.csv", columns)
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
