// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/energy_guard.h>
#include <myolines/time/error_control.h>
#include <myolines/time/plan.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    class Fixed : public StepControl
    {
    public:
      explicit Fixed(Plan plan)
        : plan_(std::move(plan))
      {}

      double propose(const double t) const override
      {
        const Plan::Step step = plan_.at(t);
        return std::min(step.size, step.end - t);
      }
      double      next_landing(const double t) const override { return plan_.at(t).end; }
      void        accepted(double, double, const StepReport &) override {}
      bool        rejected(double, double, const StepReport &) override { return false; }
      std::string advice() const override { return "a smaller \"time/step\", or \"time/control/type\" = \"cut back\""; }
      void        save(Archive &) const override {}
      void        load(const Archive &) override {}

    private:
      const Plan plan_;
    };

    /// cuts_ is how often the planned step is halved at present; a fraction after growth by a factor that is no power of 2.
    class CutBack : public StepControl
    {
    public:
      CutBack(Plan plan, const double growth, const double minimum, const unsigned int maximum_cuts)
        : plan_(std::move(plan))
        , growth_(growth)
        , minimum_(minimum)
        , maximum_cuts_(maximum_cuts)
      {}

      /// The rest of the planned step in equal parts no longer than the present size.
      double propose(const double t) const override
      {
        const Plan::Step step      = plan_.at(t);
        const double     remainder = step.end - t;
        const double     size      = std::min(step.size * std::exp2(-cuts_), limit_);
        const double     parts     = std::max(1., std::ceil((remainder - time_tolerance(t, size)) / size));
        return parts == 1 ? std::min(size, remainder) : remainder / parts;
      }

      double next_landing(const double t) const override { return plan_.at(t).end; }

      void accepted(double, double, const StepReport &) override
      {
        cuts_       = std::max(0., cuts_ - std::log2(growth_));
        rejections_ = 0;
      }

      /// Steps that were too long for the method are cut to equal ones, and stay so: methods lose their stability where steps vary.
      bool rejected(const double t, const double dt, const StepReport &report) override
      {
        if (report.longest_step && *report.longest_step < dt)
          {
            limit_ = *report.longest_step;
            return limit_ >= minimum_ && moves_time(t, limit_);
          }
        const double half = dt / 2;
        cuts_             = std::log2(plan_.at(t).size / half);
        ++rejections_;
        return half >= minimum_ && moves_time(t, half) && rejections_ <= maximum_cuts_;
      }

      std::string advice() const override { return "a smaller \"time/step\", or more \"maximum cuts\" in \"time/control\""; }

      void save(Archive &archive) const override
      {
        archive.put("step control: cuts", cuts_);
        archive.put("step control: longest step", limit_);
      }
      void load(const Archive &archive) override
      {
        if (archive.has_numbers("step control: cuts")) // else the run to resume had another control
          cuts_ = archive.number("step control: cuts");
        if (archive.has_numbers("step control: longest step"))
          limit_ = archive.number("step control: longest step");
      }

    private:
      const Plan         plan_;
      const double       growth_;
      const double       minimum_;
      const unsigned int maximum_cuts_;
      double             cuts_       = 0;
      double             limit_      = std::numeric_limits<double>::infinity(); ///< of the method [s]
      unsigned int       rejections_ = 0;                                       ///< since the last accepted step
    };

    Plan scheduled(const scene::Node &time, const double start, const double end)
    {
      const std::vector<SchedulePiece> pieces = parse_schedule(time.text("steps"), time, "steps");
      std::vector<unsigned int>        counts;
      std::vector<double>              sizes;
      double                           sum = start;
      for (const SchedulePiece &piece : pieces)
        {
          counts.push_back(piece.count);
          sizes.push_back(piece.size);
          sum += piece.count * piece.size;
        }
      if (std::abs(sum - end) > 1e-9 * (end - start))
        {
          std::ostringstream what, expected;
          what.precision(12);
          expected.precision(12);
          what << "the schedule ends at " << sum << " s";
          expected << "steps that cover start to end, " << start << " s to " << end << " s";
          time.refuse("steps", what.str(), expected.str(), "change \"end\" or the counts and sizes of the schedule");
        }
      return Plan(start, end, counts, sizes);
    }

    Plan make_plan(const scene::Node &time)
    {
      const double start = time.number("start");
      const double end   = time.number("end");
      if (!(end > start))
        time.refuse("end", "the end does not come after the start", "a time later than \"start\" [s]");
      require_steps(time);
      return time.has("steps") ? scheduled(time, start, end) : Plan(start, end, time.number("step"));
    }
  } // namespace

  scene::Schema time_schema()
  {
    using scene::Range;
    scene::Schema fixed("The planned steps only; the run ends at a step that fails.");
    scene::Schema cut_back("A step that fails is repeated with half its size; sub-steps land on the ends of the planned steps.");
    cut_back.number("growth factor", 2, "-", Range{1, 10, false, false}, "Growth of the step after a success, up to the planned size.")
        .number("minimum step", 0, "s", Range::not_negative(), "The run ends rather than take a smaller step.")
        .integer("maximum cuts", 10, Range::closed(0, 50), "Largest number of times a step is halved before one succeeds.");
    scene::Schema by_error = error_control_schema();
    for (scene::Schema *control : {&fixed, &cut_back, &by_error})
      add_largest_gain(*control);

    scene::Schema schema("Steps in time.");
    schema.number("start", 0, "s", Range::any(), "Initial time.")
        .number("end", std::nullopt, "s", Range::any(), "Final time; reached exactly.")
        .optional_number("step", "s", Range::positive(),
                         "Step size; the last step is shorter if the steps do not fit. The first one if steps are chosen by error.")
        .optional_text("steps",
                       "Schedule of steps instead of one size, \"count x size\" separated by semicolons: \"4 x 0.025; 8 x 0.0125\".")
        .optional_text("land on",
                       "Further times at which a step ends, separated by spaces, for example \"0.1 0.25\": for values of exactly there.")
        .section("control",
                 scene::Schema("How long steps are, and what happens when one fails.")
                     .variant("type", "cut back", {{"fixed", fixed}, {"cut back", cut_back}, {"error", by_error}}, "Kind of step control."))
        .choice("boundary rates", "exact", {"exact", "scheme"},
                "Velocity and acceleration of moving boundaries: derivatives of the prescribed motion, or the formulas of the integrator.")
        .choice("start velocity", "consistent", {"consistent", "impulse"},
                "Where a moving boundary starts or jumps to another velocity: the rest of the body keeps its velocity, or is given the "
                "impulse of the consistent mass; with \"scheme\" rates and an impulse the boundary itself starts from rest.")
        .choice("start state", "as given", {"as given", "equilibrium", "saved"},
                "Where the run starts from: the displacement that the system gives, or that at rest under the loads, activation and "
                "prescribed displacements of the initial time, velocities as given; or displacements and velocities that a run has saved.")
        .optional_file("saved state", "Checkpoint or kept state of a run of the same body on the same mesh; its time does not matter.")
        .choice("events", "restart", {"restart", "land", "ignore"},
                "Kinks of the drives: land on them and restart the integrator with right limits, land on them only, or ignore them.");
    return schema;
  }

  BoundaryRates boundary_rates(const scene::Node &time)
  {
    return time.text("boundary rates") == "exact" ? BoundaryRates::exact : BoundaryRates::scheme;
  }

  StartVelocity start_velocity(const scene::Node &time)
  {
    return time.text("start velocity") == "impulse" ? StartVelocity::impulse : StartVelocity::consistent;
  }

  bool starts_from_equilibrium(const scene::Node &time) { return time.text("start state") == "equilibrium"; }

  std::vector<SchedulePiece> parse_schedule(const std::string &text, const scene::Node &node, const std::string &parameter)
  {
    std::vector<SchedulePiece> pieces;
    std::istringstream         stream(text);
    for (std::string part; std::getline(stream, part, ';');)
      {
        std::istringstream words(part);
        long               count = 0;
        std::string        times, rest;
        double             size = 0;
        if (!(words >> count >> times >> size) || times != "x" || (words >> rest) || count < 1 || count > 1000000000 || !(size > 0) ||
            !std::isfinite(size))
          node.refuse(parameter, "\"" + part + "\" is not a piece of a schedule",
                      "\"count x size\" with a positive count and a positive size [s]", "for example \"4 x 0.025; 8 x 0.0125\"");
        pieces.push_back({static_cast<unsigned int>(count), size});
      }
    if (pieces.empty())
      node.refuse(parameter, "the schedule is empty", "\"count x size\" separated by semicolons", "for example \"4 x 0.025; 8 x 0.0125\"");
    return pieces;
  }

  void require_steps(const scene::Node &time)
  {
    if (time.has("step") == time.has("steps"))
      time.refuse("step", time.has("step") ? "both \"step\" and \"steps\" are given" : "neither \"step\" nor \"steps\" is given",
                  "exactly one of them", "\"step\" is one size [s], \"steps\" a schedule such as \"4 x 0.025; 8 x 0.0125\"");
  }

  std::unique_ptr<StepControl> make_step_control(const scene::Node &time, const unsigned int error_exponent)
  {
    const scene::Node &control = time.section("control");
    if (control.text("type") == "error")
      return make_error_control(time, error_exponent);
    Plan plan = make_plan(time);
    if (control.text("type") == "fixed")
      return std::make_unique<Fixed>(std::move(plan));
    return std::make_unique<CutBack>(std::move(plan), control.number("growth factor"), control.number("minimum step"),
                                     control.integer("maximum cuts"));
  }
} // namespace myolines
