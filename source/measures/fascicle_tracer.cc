// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fascicle_tracer.h"

#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  FascicleTracer::FascicleTracer(const Muscle3dSystem &system)
    : sweep_(system.sweep())
    , element_(system.discretisation().element)
  {
    const CellBatches &batches = sweep_.batches;
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
        batches_[batches.cell(b, lane)] = {b, lane};
  }

  Material FascicleTracer::material(const Batch &batch, const int q) const { return sweep_.materials.at(batch.number, q, batch.lane); }

  std::optional<FascicleTracer::Place> FascicleTracer::locate(const dealii::Point<3> &x, const NodeSpace::Cell &near) const
  {
    static const dealii::MappingQ1<3> mapping;
    constexpr double                  slack = 1e-10;
    constexpr unsigned int            most  = 30; // cells on the way: a step is shorter than a cell
    NodeSpace::Cell                   cell  = near;
    for (unsigned int hop = 0; hop < most; ++hop)
      {
        dealii::Point<3> unit;
        try
          {
            unit = mapping.transform_real_to_unit_cell(cell, x);
          }
        catch (const dealii::Mapping<3>::ExcTransformationFailed &)
          {
            return std::nullopt;
          }
        unsigned int face  = 0;
        double       worst = 0;
        for (unsigned int c = 0; c < 3; ++c)
          for (const unsigned int upper : {0u, 1u})
            if (const double beyond = upper == 1 ? unit[c] - 1 : -unit[c]; beyond > worst)
              {
                worst = beyond;
                face  = 2 * c + upper;
              }
        if (worst <= slack)
          return Place{cell, dealii::GeometryInfo<3>::project_to_unit_cell(unit)};
        if (cell->at_boundary(face))
          return std::nullopt;
        cell = cell->neighbor(face);
        if (batches_.count(cell) == 0)
          return std::nullopt;
      }
    return std::nullopt;
  }

  namespace
  {
    /// The Gauss points on both sides of @p x, and the weight of the second; one point beyond the outermost.
    struct Between
    {
      int    first, second;
      double weight;
    };

    Between between(const std::vector<double> &points, const double x)
    {
      const int n = static_cast<int>(points.size());
      if (x <= points.front())
        return {0, 0, 0};
      if (x >= points.back())
        return {n - 1, n - 1, 0};
      int i = 0;
      while (points[i + 1] < x)
        ++i;
      return {i, i + 1, (x - points[i]) / (points[i + 1] - points[i])};
    }
  } // namespace

  bool FascicleTracer::is_muscle(const Place &place) const
  {
    const int n = element_.n_points_1d;
    int       nearest[3];
    for (unsigned int c = 0; c < 3; ++c)
      {
        const Between side = between(element_.point, place.unit[c]);
        nearest[c]         = side.weight > 0.5 ? side.second : side.first;
      }
    const Material m = material(batches_.at(place.cell), nearest[0] + n * (nearest[1] + n * nearest[2]));
    return static_cast<unsigned int>(m[material_tissue]) == muscle_id;
  }

  FascicleTracer::Vector3 FascicleTracer::direction(const Place &place, const Vector3 &along) const
  {
    const int     n     = element_.n_points_1d;
    const Batch   batch = batches_.at(place.cell);
    const Between x = between(element_.point, place.unit[0]), y = between(element_.point, place.unit[1]),
                  z = between(element_.point, place.unit[2]);
    Vector3 sum;
    for (const int k : {0, 1})
      for (const int j : {0, 1})
        for (const int i : {0, 1})
          {
            const double weight =
                (i == 0 ? 1 - x.weight : x.weight) * (j == 0 ? 1 - y.weight : y.weight) * (k == 0 ? 1 - z.weight : z.weight);
            if (weight == 0)
              continue;
            const Material m =
                material(batch, (i == 0 ? x.first : x.second) + n * ((j == 0 ? y.first : y.second) + n * (k == 0 ? z.first : z.second)));
            const Vector3 a({m[0], m[1], m[2]});
            sum += (a * along < 0 ? -weight : weight) * a;
          }
    const double norm = sum.norm();
    return norm > 0 ? sum / norm : along;
  }

  namespace
  {
    /// How far along the unit vector @p a until a coordinate of the reference cell has changed by one, taken from the mean edges of @p cell
    /// [m]: in flat cells a way along them is not measured by their thickness.
    double length_along(const NodeSpace::Cell &cell, const dealii::Tensor<1, 3> &a)
    {
      dealii::Tensor<2, 3> edges; // dx/dxi in the middle, by columns
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < 3; ++i)
            edges[i][c] += ((v >> c & 1) == 1 ? 0.25 : -0.25) * cell->vertex(v)[i];
      const dealii::Tensor<1, 3> rate     = invert(edges) * a;
      const double               greatest = std::max({std::abs(rate[0]), std::abs(rate[1]), std::abs(rate[2])});
      return std::isfinite(greatest) && greatest > 0 ? 1 / greatest : cell->minimum_vertex_distance();
    }
  } // namespace

  FascicleTracer::Step FascicleTracer::step(const dealii::Point<3> &x, const Place &from, Vector3 &along) const
  {
    const auto   ended = [&](const std::optional<Place> &place) { return !place || !is_muscle(*place); };
    Vector3      a     = direction(from, along);
    const double h     = std::max(from.cell->minimum_vertex_distance() / 8, length_along(from.cell, a) / 16);
    if (const std::optional<Place> middle = locate(x + h / 2 * a, from.cell); middle && is_muscle(*middle))
      a = direction(*middle, a);
    along                            = a;
    const std::optional<Place> place = locate(x + h * a, from.cell);
    if (!ended(place))
      return {x + h * a, place, std::nullopt};

    double inside = 0, outside = 1;
    for (unsigned int halving = 0; halving < 40; ++halving)
      {
        const double middle                                               = (inside + outside) / 2;
        (ended(locate(x + middle * h * a, from.cell)) ? outside : inside) = middle;
      }
    const std::optional<Place> beyond = locate(x + outside * h * a, from.cell);
    return {x + inside * h * a, std::nullopt, beyond ? Fascicles::End::tissue : Fascicles::End::surface};
  }
} // namespace myolines
