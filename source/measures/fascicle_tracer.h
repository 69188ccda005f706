// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/measures/fascicles.h>
#include <myolines/muscle3d/discretisation.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <optional>
#include <vector>

namespace myolines
{
  /// Goes along fibres through the cells that a rank knows, own ones and their neighbours.
  class FascicleTracer
  {
  public:
    using Vector3 = dealii::Tensor<1, 3>;

    /// A place within a cell.
    struct Place
    {
      NodeSpace::Cell  cell;
      dealii::Point<3> unit; ///< within [0, 1]^3
    };

    explicit FascicleTracer(const Muscle3dSystem &system);

    /// The place of @p x, searched from @p near across faces; nothing outside of the cells that this rank knows.
    std::optional<Place> locate(const dealii::Point<3> &x, const NodeSpace::Cell &near) const;
    bool                 is_muscle(const Place &place) const;
    /// Fibre direction, of the sense of @p along.
    Vector3 direction(const Place &place, const Vector3 &along) const;

    struct Step
    {
      dealii::Point<3>              x;
      std::optional<Place>          place; ///< nothing where the line has ended
      std::optional<Fascicles::End> end;
    };
    /// One step from @p x in @p from, of which @p along was the last direction and becomes the next.
    Step step(const dealii::Point<3> &x, const Place &from, Vector3 &along) const;

  private:
    struct Batch
    {
      unsigned int number, lane;
    };
    Material material(const Batch &batch, int q) const;

    const CellSweep                  sweep_;
    const Element                   &element_;
    std::map<NodeSpace::Cell, Batch> batches_;
  };
} // namespace myolines
