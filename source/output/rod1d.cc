#include <myolines/output/csv_file.h>
#include <myolines/output/outputs.h>
#include <myolines/output/periodic_output.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Finite numbers separated by spaces. @throws InputError through node.refuse.
    std::vector<double> numbers(const scene::Node &node, const std::string &parameter, const std::string &what)
    {
      std::vector<double> values;
      std::istringstream  words(node.text(parameter));
      for (std::string word; words >> word;)
        {
          const auto value = scene::parse_number(word);
          if (!value)
            node.refuse(parameter, "\"" + word + "\" is not a finite number", what);
          values.push_back(*value);
        }
      if (values.empty())
        node.refuse(parameter, "there is no number", what);
      return values;
    }

    /// trace.csv and reaction.csv.
    class RodSeries : public PeriodicOutput
    {
    public:
      RodSeries(const Rod1dSystem &system, const unsigned int every, const std::vector<double> &places, const OutputFolder &folder)
        : PeriodicOutput(every)
        , system_(system)
        , places_(places)
        , trace_(folder, "trace.csv", columns(places))
        , reaction_(folder, "reaction.csv", {"Time [s]", "moving end x [N]", "fixed end x [N]"})
      {}

      void save(Archive &archive) const override
      {
        trace_.save(archive);
        reaction_.save(archive);
      }

    private:
      static std::vector<std::string> columns(const std::vector<double> &places)
      {
        std::vector<std::string> names{"Time [s]"};
        for (const char *quantity : {"u", "v"})
          for (const double place : places)
            names.push_back(std::string(quantity) + "(" + scene::format_number(place) + " L) [" + (quantity[0] == 'u' ? "m]" : "m/s]"));
        return names;
      }

      void write(const State &state, const Side side, std::size_t) override
      {
        std::vector<double> row{state.t};
        for (const Vector *x : {&state.u, &state.v})
          for (const double place : places_)
            row.push_back(system_.value(*x, place * system_.parameters().length));
        trace_.row(row);
        Vector r(state.u);
        system_.residual({state.t, side, state.u, state.v, state.a}, r);
        reaction_.row(std::vector<double>{state.t, r[r.size() - 1], r[0]});
      }

      const Rod1dSystem        &system_;
      const std::vector<double> places_;
      CsvFile                   trace_, reaction_;
    };

    /// nodal_states.csv. Times between the ends of steps are interpolated, u by the cubic that has u and v of both ends and v
    /// by its derivative.
    class NodalStates : public Observer
    {
    public:
      NodalStates(const Rod1dSystem &system, std::vector<double> times, const OutputFolder &folder)
        : system_(system)
        , times_(std::move(times))
        , csv_(folder, "nodal_states.csv", {"Time [s]", "X [m]", "u [m]", "v [m/s]"})
      {
        std::sort(times_.begin(), times_.end());
        if (folder.saved != nullptr && folder.saved->has_numbers("nodal states written"))
          next_ = static_cast<std::size_t>(folder.saved->number("nodal states written"));
      }

      void save(Archive &archive) const override
      {
        csv_.save(archive);
        archive.put("nodal states written", static_cast<double>(next_));
      }

      void resume(const State &state, std::size_t) override { last_ = state; }

      void begin(const State &state) override
      {
        for (; next_ < times_.size() && times_[next_] <= state.t; ++next_)
          if (times_[next_] == state.t)
            write(times_[next_], state);
        last_ = state;
      }

      void accepted(const State &state, const StepRecord &record) override
      {
        const double same = 1e-9 * record.dt; // rounding in sums of steps does not make a time fall between two
        for (; next_ < times_.size() && times_[next_] <= state.t + same; ++next_)
          if (times_[next_] >= state.t - same)
            write(times_[next_], state);
          else
            write(times_[next_], interpolated(times_[next_], state));
        last_ = state;
      }

    private:
      State interpolated(const double t, const State &end) const
      {
        State        state = end;
        const double h = end.t - last_.t, s = (t - last_.t) / h;
        const double h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s) * h, h01 = s * s * (3 - 2 * s),
                     h11   = s * s * (s - 1) * h;
        const double slope = 6 * s * (1 - s) / h, d10 = (1 - s) * (1 - 3 * s), d11 = s * (3 * s - 2);
        for (unsigned int i = 0; i < end.u.size(); ++i)
          {
            state.u[i] = h00 * last_.u[i] + h10 * last_.v[i] + h01 * end.u[i] + h11 * end.v[i];
            state.v[i] = slope * (end.u[i] - last_.u[i]) + d10 * last_.v[i] + d11 * end.v[i];
          }
        return state;
      }

      void write(const double t, const State &state)
      {
        for (unsigned int i = 0; i < state.u.size(); ++i)
          csv_.row(std::vector<double>{t, system_.position(i), state.u[i], state.v[i]});
      }

      const Rod1dSystem  &system_;
      std::vector<double> times_;
      std::size_t         next_ = 0;
      State               last_;
      CsvFile             csv_;
    };
  } // namespace

  scene::Schema rod1d_output_schema()
  {
    scene::Schema series("Time series: trace.csv (displacement and velocity at places), reaction.csv (forces of the supports).");
    series.integer("every", 1, scene::Range::closed(1, 1e9), "A row at the start and after every so many accepted steps.")
        .text("places", "0.25 0.5 0.9 1", "Where, in parts of the length, separated by spaces.");
    scene::Schema states("All nodes at some instants: nodal_states.csv.");
    states.text("times", std::nullopt, "Instants [s], separated by spaces; interpolated where no step ends.");
    return scene::Schema("What to write.").section("series", series).optional_section("nodal states", states);
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Rod1dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    const scene::Node                     &series = output.section("series");
    const std::vector<double>              places = numbers(series, "places", "numbers from 0 to 1");
    if (std::any_of(places.begin(), places.end(), [](const double x) { return x < 0 || x > 1; }))
      series.refuse("places", "a place is not on the rod", "numbers from 0 to 1");
    observers.push_back(std::make_unique<RodSeries>(system, series.integer("every"), places, folder));
    if (output.has("nodal states"))
      observers.push_back(std::make_unique<NodalStates>(
          system, numbers(output.section("nodal states"), "times", "times [s], separated by spaces"), folder));
    return observers;
  }
} // namespace myolines
