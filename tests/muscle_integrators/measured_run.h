// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/body_measures.h>

#include <string>
#include <vector>

namespace myolines::testing
{
  using Overrides = std::vector<std::string>;

  /// What a run of a scene of the muscle ends with, and what it took.
  struct MeasuredRun
  {
    Vector              u, v;                 ///< of all nodes at the end
    std::vector<double> mid_velocity;         ///< axial, of the middle of the block, at the start and after every step [m/s]
    double              newton_per_stage = 0; ///< start-up excluded
    double              cpu_seconds      = 0; ///< steps only
  };

  /// Runs @p scene, a file of input/, with @p overrides as of --set, fixed steps, and Newton tight enough to see errors of 1e-8.
  /// @throws InputError, SolveError.
  MeasuredRun measured_run(const std::string &scene, const Overrides &overrides);

  /// |x - reference| / |reference|, l2 over all nodes.
  double relative_error(const Vector &x, const Vector &reference);

  /// Sum of the absolute changes of values over that of @p reference at the same instants. The steps of the reference are a multiple.
  double relative_variation(const std::vector<double> &values, const std::vector<double> &reference);

  /// A method as in the table of tests/data/integrators_3d.csv.
  struct Scheme
  {
    std::string name;
    Overrides   parameters;
  };
  const std::vector<Scheme> &schemes();
  const Scheme              &scheme(const std::string &name);

  /// The run of input/kinked_block.xml, which has the conventions of the study, with @p n steps of @p scheme at @p refinement, and as
  /// many quadrature points as there: three.
  MeasuredRun kinked_run(const Scheme &scheme, unsigned int n, unsigned int refinement, const Overrides &more = {});
} // namespace myolines::testing
