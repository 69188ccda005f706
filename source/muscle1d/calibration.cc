// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>

#include <cmath>
#include <functional>
#include <map>

namespace myolines
{
  namespace
  {
    /// The zero of @p f in [a, b], where its signs differ, by bisection to the last digit.
    double bisect(const std::function<double(double)> &f, double a, double b)
    {
      const bool rises = f(b) > 0;
      for (double middle = (a + b) / 2; middle != a && middle != b; middle = (a + b) / 2)
        ((f(middle) > 0) == rises ? b : a) = middle;
      return (a + b) / 2;
    }

    /// The zero of @p f next to @p near within @p low and @p high, looked for in steps of a thousandth of that range.
    double nearest_zero(const std::function<double(double)> &f, const double near, const double low, const double high,
                        const std::string &what)
    {
      const double x    = std::clamp(near, low, high);
      const double step = (high - low) / 1000, at_x = f(x);
      if (at_x == 0)
        return x;
      double left = x, right = x, at_left = at_x, at_right = at_x;
      while (left > low || right < high)
        {
          const double next_left = std::max(left - step, low), next_right = std::min(right + step, high);
          const double f_left = f(next_left), f_right = f(next_right);
          if (next_right > right && (f_right > 0) != (at_right > 0))
            return bisect(f, right, next_right);
          if (next_left < left && (f_left > 0) != (at_left > 0))
            return bisect(f, next_left, left);
          left     = next_left;
          right    = next_right;
          at_left  = f_left;
          at_right = f_right;
        }
      throw SolveError(what);
    }

    struct OfMuscle
    {
      double volume_fraction, length_ratio, unit_length_subject_1, unit_length_subject_2;
    };
  } // namespace

  MuscleData MuscleData::table21(const std::string &muscle, const std::string &task)
  {
    static const std::map<std::string, OfMuscle> muscles{
        {"MG", {0.0362, 0.54, 0.3910, 0.3952}}, {"VM", {0.0606, 0.84, 0.2770, 0.2171}}, {"ST", {0.026, 0.70, 0.4122, 0.4381}}};
    static const std::map<std::string, bool> tasks{{"walking", false}, {"running", false}, {"cycling", true}};

    const OfMuscle &of      = muscles.at(muscle);
    const bool      cycling = tasks.at(task);
    MuscleData      data;
    data.volume_fraction = of.volume_fraction;
    data.length_ratio    = of.length_ratio;
    data.unit_length     = cycling ? of.unit_length_subject_2 : of.unit_length_subject_1;
    if (cycling)
      {
        data.maximum_strain_rate = 10;
        data.zajac.time_constant = 0.025;
      }
    return data;
  }

  double MuscleData::volume() const { return volume_fraction * (47 * body_mass * body_height + 1285) * 1e-6; }

  OptimalLengths calibrate(const double unit_length, const double length_ratio)
  {
    const double muscle = unit_length * length_ratio, tendon = unit_length * (1 - length_ratio);
    const auto   balance = [&](const double d) {
      return hill::passive(muscle / (muscle + d)).value - hill::tendon(tendon / (tendon - d)).value;
    };
    const double reach = 0.2 * tendon;
    const double d     = nearest_zero(balance, 0, -reach, reach, "The passive forces of muscle and tendon balance at no optimal length.");
    return {muscle + d, tendon - d};
  }

  double balanced_length(const OptimalLengths &optimal, const double unit_length, const double activation, const double estimate)
  {
    const auto balance = [&](const double muscle) {
      const double stretch = muscle / optimal.muscle;
      return activation * hill::active(stretch).value + hill::passive(stretch).value -
             hill::tendon((unit_length - muscle) / optimal.tendon).value;
    };
    return nearest_zero(balance, estimate, 0.4 * optimal.muscle, 1.7 * optimal.muscle,
                        "Muscle and tendon balance at no initial length of the muscle.");
  }

  double musculoskeletal_reynolds_number(const double density, const double length, const double maximum_strain_rate,
                                         const double maximum_stress)
  {
    return density * std::pow(length * maximum_strain_rate, 2) / maximum_stress;
  }
} // namespace myolines
