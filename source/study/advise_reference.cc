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

    Values distance(const Values &a, const Values &b)
    {
      Values differences;
      for (std::size_t q = 0; q < a.size(); ++q)
        differences.push_back(std::abs(a[q] - b[q]));
      return differences;
    }

    std::string words_of_values(const PilotRun &run)
    {
      std::string text = run.name + ":";
      for (const NamedValue &value : run.values)
        text += " " + digits(value.value, 6);
      return text + (run.done() ? "" : " " + run.outcome.status + (run.outcome.reason.empty() ? "" : ", " + run.outcome.reason));
    }
  } // namespace

  TimeReference::TimeReference(Pilot &pilot, const Choices &choices, const Rung *mesh)
    : pilot_(pilot)
    , method_(choices.candidates.at(choices.reference))
    , mesh_(mesh)
  {
    const Candidate &check = choices.candidates.at(choices.check);
    const PilotRun  *other = nullptr;
    for (std::size_t rung = 0; rung < method_.rungs.size(); ++rung)
      {
        const auto      both  = pilot.run({{&method_, rung, mesh}, {&check, std::min(rung, check.rungs.size() - 1), mesh}});
        const PilotRun *found = both[0];
        other                 = both[1];
        rung_                 = rung;
        take(*found);
        if (change_.empty() || !other->done())
          continue;
        const Values between = distance(found->plain_values(), other->plain_values());
        if (changes_less_than(near_itself) && ratio(between) <= near_another)
          return;
      }
    throw SolveError("there is no value to measure errors against: steps of \"" + method_.name + "\" and \"" + check.name +
                     "\" do not come within the accuracy. The last ones are " + words_of_values(*runs_.back()) + "; " +
                     words_of_values(*other) + ". A larger --accuracy, or a quantity that rings less, may help");
  }

  void TimeReference::take(const PilotRun &run)
  {
    change_.clear();
    if (run.done())
      {
        accuracy_ = pilot_.accuracy_of(run.plain_values());
        if (!runs_.empty() && runs_.back()->done() && run.finer_than(*runs_.back()))
          change_ = distance(run.plain_values(), runs_.back()->plain_values());
      }
    runs_.push_back(&run);
  }

  bool TimeReference::sharpen()
  {
    if (rung_ + 1 >= method_.rungs.size())
      return false;
    const PilotRun &run = pilot_.run({&method_, rung_ + 1, mesh_});
    if (!run.done() || !run.finer_than(this->run()))
      return false;
    ++rung_;
    take(run);
    return true;
  }

  Values TimeReference::errors_of(const PilotRun &run) const
  {
    Values errors = distance(run.plain_values(), this->run().plain_values());
    for (std::size_t q = 0; q < errors.size(); ++q)
      errors[q] = std::max(errors[q], change_[q]);
    return errors;
  }

  double TimeReference::ratio(const Values &errors) const
  {
    double largest = 0;
    for (std::size_t q = 0; q < errors.size(); ++q)
      largest = std::max(largest, errors[q] / accuracy_[q]);
    return largest;
  }

  std::size_t TimeReference::rung_within(const double part) const
  {
    for (std::size_t rung = 0; rung < rung_; ++rung)
      if (runs_[rung]->done() && ratio(errors_of(*runs_[rung])) <= part)
        return rung;
    return rung_;
  }
} // namespace myolines::study
