// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/point_states.h>

#include <deal.II/base/symmetric_tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace myolines
{
  /// A field that lives at quadrature points.
  struct PointField
  {
    std::string  name, unit;
    unsigned int n_components; ///< 1: the first component of the value alone; 3: a vector
    std::function<Vector3(const Muscle3dParameters &, const Activation &, const PointState &)> value;
  };

  const std::vector<PointField> &point_fields();

  constexpr const char *stress_of_law = "stress of "; ///< before the name of a LawPart: that field
  /// Of each law of the tissues of a body, the size of its Cauchy stress [Pa].
  std::vector<PointField> law_fields(const Muscle3dParameters &parameters);

  /// A principal direction of a symmetric tensor that lives at quadrature points. The tensor is projected, and has directions where they
  /// are written: those of the points have no sense, so that their mean would mean nothing.
  struct PrincipalField
  {
    std::string                                                                                name;
    std::function<Matrix3(const Muscle3dParameters &, const Activation &, const PointState &)> tensor;
    unsigned int which; ///< 0: that of the largest value, algebraically
  };
  const std::vector<PrincipalField> &principal_fields();
  /// Unit eigenvector, of the two the one whose largest component is positive; zero where another value is the same to rounding, so that no
  /// direction is the principal one.
  Vector3 principal_direction(const dealii::SymmetricTensor<2, 3> &tensor, unsigned int which);

  /// nullptr if there is none of that name, here or among @p more, which is borrowed.
  const PointField     *find_point_field(const std::string &name, const std::vector<PointField> &more = {});
  const PrincipalField *find_principal_field(const std::string &name);
} // namespace myolines
