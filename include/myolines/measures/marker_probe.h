// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// Evaluates vectors of the system at fixed material points. @throws InputError naming the marker if one lies outside the body.
  struct Marker
  {
    std::string      name;     ///< as the scene has it
    dealii::Point<3> position; ///< reference [m]
  };
  /// Displacements and velocities at markers: the shape functions of their cells, found once.
  class MarkerProbe
  {
  public:
    /// @p where: the place in the scene, for messages. @p system outlives the object. Collective.
    MarkerProbe(const Muscle3dSystem &system, std::vector<Marker> markers, const std::string &where);
    /// Of displacements or velocities: @p x has one entry for each unknown.
    std::vector<dealii::Tensor<1, 3>> values(const Vector &x) const;
    std::vector<dealii::Tensor<1, 3>> displacements(const State &state) const { return values(state.u); } ///< [m]
    const std::vector<Marker>        &markers() const { return markers_; } ///< those of the constructor, in its order

  private:
    const Muscle3dSystem &system_;
    std::vector<Marker>   markers_;
    struct Place;
    std::vector<std::shared_ptr<const Place>> places_; ///< null where another rank owns the point
  };
} // namespace myolines
