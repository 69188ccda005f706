// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/fem/node_space.h>
#include <myolines/muscle3d/body_measures.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/outputs.h>

#include "../output/folder.h"
#include "../support/conditions.h"

#include <cmath>
#include <map>

using namespace myolines;

/// A block whose motion has closed forms.
namespace
{
  const double pi = 3.14159265358979323846;

  /// a(t) = 4 t.
  class Ramp : public Drive
  {
  public:
    double              value(const double t, Side) const override { return 4 * t; }
    double              first_derivative(double, Side) const override { return 4; }
    double              second_derivative(double, Side) const override { return 0; }
    std::vector<double> kinks(double, double) const override { return {}; }
  };

  test::Condition fixed(const std::string &name, const unsigned int face) { return test::held(face, "x y z", name); }

  /// 3 x 1 x 2 cm, eight cells along x so that the slab is exactly the two in the middle; pennation 30 degrees.
  Muscle3dParameters block()
  {
    Muscle3dParameters p;
    p.geometry.size            = {{0.03, 0.01, 0.02}};
    p.geometry.cells           = {{8, 1, 1}};
    p.geometry.refinement      = 0;
    p.n_points                 = 3;
    p.muscle().fibre.direction = {{std::cos(pi / 6), 0, std::sin(pi / 6)}};
    p.activation               = std::make_shared<Ramp>();
    return p;
  }

  using Diagonal = dealii::Point<3>;

  /// u_c = stretch_c X_c, v_c = rate_c X_c + speed_c.
  State homogeneous(const Muscle3dSystem &system, const double t, const Diagonal &stretch, const Diagonal &rate, const Diagonal &speed = {})
  {
    const NodeSpace &space = *system.discretisation().space;
    State            state{t, space.make_vector(), space.make_vector(), space.make_vector()};
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->zero_out_ghost_values();
    for (unsigned int node = 0; node < system.n_unknowns() / 3; ++node)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double X        = space.node_position(node)[c];
          state.u(3 * node + c) = stretch[c] * X;
          state.v(3 * node + c) = rate[c] * X + speed[c];
        }
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->update_ghost_values();
    return state;
  }

  std::string setting(const std::string &name, const std::string &type, const std::string &value)
  {
    return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
  }

  scene::Node output_scene(const std::string &series, const std::string &fields = "")
  {
    return scene::parse_scene("<ParameterList name=\"scene\"><ParameterList name=\"series\">" + series + "</ParameterList>" + fields +
                                  "</ParameterList>",
                              muscle3d_output_schema());
  }

  StepRecord step(const std::size_t number)
  {
    StepRecord record;
    record.number = number;
    return record;
  }

  bool is_there(const test::Folder &folder, const std::string &file) { return std::filesystem::exists(folder.path / file); }
} // namespace
