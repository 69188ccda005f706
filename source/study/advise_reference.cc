// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_reference.h"
#include "number_text.h"

#include <myolines/base/error.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    constexpr double near_itself = 0.1, near_another = 0.25; // of the accuracy

    /// To steps so many times shorter, by powers of two: waves that all long steps damp make no difference to twice as long ones.
    constexpr std::size_t leap = 3;

    std::string words_of_values(const PilotRun &run)
    {
      std::string text = run.name + ":";
      for (const NamedValue &value : run.values)
        text += " " + digits(value.value, 6);
      return text + (run.done() ? "" : " " + run.outcome.status + (run.outcome.reason.empty() ? "" : ", " + run.outcome.reason));
    }
  } // namespace

  Values distance(const Values &a, const Values &b)
  {
    Values differences;
    for (std::size_t q = 0; q < a.size(); ++q)
      differences.push_back(std::abs(a[q] - b[q]));
    return differences;
  }

  double largest_ratio(const Values &errors, const Values &accuracy)
  {
    double largest = 0;
    for (std::size_t q = 0; q < errors.size(); ++q)
      largest = std::max(largest, errors[q] / accuracy[q]);
    return largest;
  }

  TimeReference::TimeReference(Pilot &pilot, const Choices &choices, const Rung *mesh)
    : pilot_(pilot)
    , method_(choices.candidates.at(choices.reference))
    , mesh_(mesh)
  {
    const Candidate &check = choices.candidates.at(choices.check);
    const PilotRun  *other = nullptr;
    for (std::size_t rung = 0; rung < method_.rungs.size(); ++rung)
      {
        pilot.run({{&method_, rung, mesh}, {&check, std::min(rung, check.rungs.size() - 1), mesh}}); // both at a time
        take(rung);
        other = &pilot.run({&check, std::min(rung, check.rungs.size() - 1), mesh});
        if (change_.empty() || !other->done() || !changes_less_than(near_itself) ||
            ratio(distance(run().plain_values(), other->plain_values())) > near_another)
          continue;
        if (rung + leap >= method_.rungs.size())
          return;
        rung += leap;
        if (!pilot.run({&method_, rung, mesh}).done())
          return;
        take(rung);
        if (!change_.empty() && changes_less_than(near_itself))
          return;
      }
    throw SolveError("there is no value to measure errors against: steps of \"" + method_.name + "\" and \"" + check.name +
                     "\" do not come within the accuracy. The last ones are " + words_of_values(run()) + "; " + words_of_values(*other) +
                     ". A larger --accuracy, or a quantity that rings less, may help");
  }

  void TimeReference::take(const std::size_t rung)
  {
    const PilotRun &taken = pilot_.run({&method_, rung, mesh_});
    change_.clear();
    if (taken.done())
      {
        accuracy_ = pilot_.accuracy_of(taken.plain_values());
        if (!steps_.empty() && run().done() && taken.finer_than(run()))
          change_ = distance(taken.plain_values(), run().plain_values());
      }
    steps_.push_back({rung, &taken});
  }

  bool TimeReference::sharpen()
  {
    if (rung() + 1 >= method_.rungs.size())
      return false;
    const PilotRun &finer = pilot_.run({&method_, rung() + 1, mesh_});
    if (!finer.done() || !finer.finer_than(run()))
      return false;
    take(rung() + 1);
    return true;
  }

  Values TimeReference::errors_of(const PilotRun &run) const
  {
    Values errors = distance(run.plain_values(), this->run().plain_values());
    for (std::size_t q = 0; q < errors.size(); ++q)
      errors[q] = std::max(errors[q], change_[q]);
    return errors;
  }

  std::size_t TimeReference::rung_within(const double part) const
  {
    for (const Step &step : steps_)
      if (step.run->done() && ratio(errors_of(*step.run)) <= part)
        return step.rung;
    return rung();
  }
} // namespace myolines::study
