// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "bindings.h"

#include <myolines/output/status.h>
#include <myolines/time/loop.h>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    inline py::dict report_dict(const StepReport &report)
    {
      py::dict dict;
      dict["outcome"]              = outcome_text(report.outcome);
      dict["reason"]               = report.reason;
      dict["newton iterations"]    = report.newton_iterations;
      dict["linear iterations"]    = report.linear_iterations;
      dict["residual evaluations"] = report.residual_evaluations;
      return dict;
    }

    inline py::dict step_dict(const StepRecord &record)
    {
      py::dict dict  = report_dict(record.report);
      dict["number"] = record.number;
      dict["t"]      = record.t;
      dict["dt"]     = record.dt;
      return dict;
    }
  } // namespace python
} // namespace myolines
