// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fascicle_tracer.h"
#include <myolines/muscle3d/forest_order.h>
#include <myolines/muscle3d/point_states.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace myolines
{
  namespace
  {
    /// How many things the ranks before this one have, and all together, of which this rank has @p own. Collective.
    struct Share
    {
      std::size_t before = 0, total = 0;

      Share(const std::size_t own, const MPI_Comm communicator)
      {
        const auto         counts = dealii::Utilities::MPI::all_gather(communicator, own);
        const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(communicator);
        before                    = std::accumulate(counts.begin(), counts.begin() + rank, std::size_t(0));
        total                     = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
      }
    };

    /// A point of a line on the rank that passed it: the line, its number along the line (negative on one side of the seed), and the nodes
    /// that move it.
    struct Passed
    {
      std::size_t                                  line;
      int                                          number;
      dealii::Point<3>                             x;
      std::vector<dealii::types::global_dof_index> nodes;
      std::vector<double>                          weights;
    };

    /// One of the two ways from a seed, where it has come to. All ranks know all of them.
    struct Way
    {
      std::size_t      line;
      int              sense; ///< of the numbers of its points: 1 or -1
      int              number = 0;
      dealii::Point<3> x;
      Vector3          along;
      double           length = 0; ///< so far [m]
      dealii::CellId   cell;
      bool             over = false;
      Fascicles::End   end  = Fascicles::End::none;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &line &sense &number &x &along &length &cell &over &end;
      }
    };

    /// Traces lines over all ranks: each goes on with the ways that are in its cells until they leave them, then all tell all.
    class Tracing
    {
    public:
      Tracing(const Muscle3dSystem &system, const double longest)
        : tracer_(system)
        , d_(system.discretisation())
        , longest_(longest)
      {
        for (const NodeSpace::Cell &cell : cells_in_forest_order(d_))
          own_cells_[cell->id()] = cell;
      }

      /// @p seeds: cells of this rank through whose centres lines go; the lines are numbered over all ranks in order.
      void trace(const std::vector<NodeSpace::Cell> &seeds)
      {
        std::size_t      line = Share(seeds.size(), d_.communicator).before;
        std::vector<Way> begun;
        for (const NodeSpace::Cell &cell : seeds)
          {
            const FascicleTracer::Place place{cell, dealii::Point<3>(0.5, 0.5, 0.5)};
            const Vector3               along = tracer_.direction(place, Vector3());
            Way                         way;
            way.line = line++;
            way.x    = cell->center();
            way.cell = cell->id();
            pass(way, place);
            for (const int sense : {1, -1})
              {
                way.sense = sense;
                way.along = sense * along;
                begun.push_back(way);
              }
          }
        while (exchange(begun))
          for (Way &way : ways_)
            if (!way.over)
              {
                const auto cell = own_cells_.find(way.cell);
                if (cell == own_cells_.end())
                  continue;
                follow(way, cell->second);
                begun.push_back(way);
              }
      }

      const std::vector<Way> &ways() const { return ways_; }
      std::vector<Passed>     passed() { return std::move(passed_); }

    private:
      /// Takes what all ranks have to tell of ways; false: all are over.
      bool exchange(std::vector<Way> &told)
      {
        for (const std::vector<Way> &of_rank : dealii::Utilities::MPI::all_gather(d_.communicator, told))
          for (const Way &way : of_rank)
            {
              const auto known =
                  std::find_if(ways_.begin(), ways_.end(), [&](const Way &w) { return w.line == way.line && w.sense == way.sense; });
              if (known == ways_.end())
                ways_.push_back(way);
              else
                *known = way;
            }
        told.clear();
        return std::any_of(ways_.begin(), ways_.end(), [](const Way &way) { return !way.over; });
      }

      /// As far as the cells of this rank reach.
      void follow(Way &way, const NodeSpace::Cell &cell)
      {
        auto place = tracer_.locate(way.x, cell);
        while (place && place->cell->is_locally_owned())
          {
            const FascicleTracer::Step step = tracer_.step(way.x, *place, way.along);
            way.length += step.x.distance(way.x);
            way.x = step.x;
            way.number += way.sense;
            pass(way, step.place ? *step.place : FascicleTracer::Place{tracer_.locate(way.x, place->cell).value_or(*place)});
            way.over = step.end || way.length > longest_;
            way.end  = step.end.value_or(Fascicles::End::none);
            if (way.over)
              return;
            place = step.place;
          }
        if (place)
          way.cell = place->cell->id();
        else
          way.over = true;
      }

      void pass(const Way &way, const FascicleTracer::Place &place)
      {
        const dealii::FiniteElement<3> &fe = d_.space->nodes().get_fe();
        Passed                          passed{way.line, way.number, way.x, {}, {}};
        passed.nodes.resize(fe.n_dofs_per_cell());
        place.cell->get_dof_indices(passed.nodes);
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          passed.weights.push_back(fe.shape_value(i, place.unit));
        passed_.push_back(std::move(passed));
      }

      const FascicleTracer                      tracer_;
      const Muscle3dDiscretisation             &d_;
      const double                              longest_;
      std::map<dealii::CellId, NodeSpace::Cell> own_cells_;
      std::vector<Way>                          ways_;
      std::vector<Passed>                       passed_;
    };

    /// Own cells of muscle among which the seeds are chosen, in forest order.
    std::vector<NodeSpace::Cell> muscle_cells(const Muscle3dSystem &system)
    {
      const std::optional<LineOfAction> &line = system.line_of_action().line;
      const FascicleTracer               tracer(system);
      std::vector<NodeSpace::Cell>       all, in_slab;
      for (const NodeSpace::Cell &cell : cells_in_forest_order(system.discretisation()))
        if (tracer.is_muscle({cell, dealii::Point<3>(0.5, 0.5, 0.5)}))
          {
            all.push_back(cell);
            if (line && line->in_slab(cell->center(), 1e-12))
              in_slab.push_back(cell);
          }
      return dealii::Utilities::MPI::sum(in_slab.size(), system.discretisation().communicator) > 0 ? in_slab : all;
    }

    /// At most @p number of the cells of all ranks, evenly among them.
    std::vector<NodeSpace::Cell> choose(const std::vector<NodeSpace::Cell> &cells, const std::size_t number, const MPI_Comm communicator)
    {
      const auto [before, total]     = Share(cells.size(), communicator);
      const std::size_t            n = std::min(number, total);
      std::vector<NodeSpace::Cell> chosen;
      for (std::size_t i = 0; i < n; ++i)
        if (const std::size_t place = (2 * i + 1) * total / (2 * n); place >= before && place < before + cells.size())
          chosen.push_back(cells[place - before]);
      return chosen;
    }

    double diameter(const Geometry &geometry) { return std::hypot(geometry.size[0], geometry.size[1], geometry.size[2]); }

    double polyline_length(const std::vector<dealii::Point<3>> &points)
    {
      double length = 0;
      for (std::size_t i = 1; i < points.size(); ++i)
        length += points[i].distance(points[i - 1]);
      return length;
    }
  } // namespace

  /// Points of all lines one after the other; every rank has the places of those that it passed.
  struct Fascicles::Lines
  {
    struct Moved
    {
      std::size_t                                  point; ///< among all
      std::vector<dealii::types::global_dof_index> nodes;
      std::vector<double>                          weights;
    };

    std::vector<std::vector<dealii::Point<3>>> at_rest;
    std::vector<double>                        lengths;
    std::array<std::size_t, 3>                 ends{};
    std::vector<Moved>                         places;
    std::size_t                                n_points = 0;
    MPI_Comm                                   communicator;

    /// Values of a vector of the system at all points.
    std::vector<Vector3> values(const Vector &x) const
    {
      const CurrentGhosts current(x);
      std::vector<double> sums(3 * n_points);
      for (const Moved &place : places)
        for (std::size_t i = 0; i < place.nodes.size(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
            sums[3 * place.point + c] += place.weights[i] * current.vector()(3 * place.nodes[i] + c);
      dealii::Utilities::MPI::sum(sums, communicator, sums);
      std::vector<Vector3> values(n_points);
      for (std::size_t p = 0; p < n_points; ++p)
        values[p] = Vector3({sums[3 * p], sums[3 * p + 1], sums[3 * p + 2]});
      return values;
    }
  };

  namespace
  {
    /// A point as all ranks hear of it.
    struct Told
    {
      std::size_t      line;
      int              number;
      dealii::Point<3> x;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &line &number &x;
      }
    };
  } // namespace

  Fascicles::Fascicles(const Muscle3dSystem &system, const unsigned int number)
    : system_(system)
  {
    const MPI_Comm all   = system.discretisation().communicator;
    auto           lines = std::make_unique<Lines>();
    lines->communicator  = all;
    Tracing tracing(system, 10 * diameter(system.parameters().geometry));
    tracing.trace(choose(muscle_cells(system), number, all));

    std::map<std::size_t, bool> ended; // by line
    for (const Way &way : tracing.ways())
      ended[way.line] = (ended.count(way.line) == 0 || ended[way.line]) && way.end != End::none;
    for (const Way &way : tracing.ways())
      if (ended[way.line])
        ++lines->ends[way.end == End::surface ? 0 : 1];
    lines->ends[2] = std::count_if(ended.begin(), ended.end(), [](const auto &line) { return !line.second; });

    const std::vector<Passed>                          own = tracing.passed();
    std::vector<Told>                                  tell;
    std::map<std::pair<std::size_t, int>, std::size_t> places; // of points by line and number
    for (const Passed &point : own)
      tell.push_back({point.line, point.number, point.x});
    std::map<std::pair<std::size_t, int>, dealii::Point<3>> points;
    for (const std::vector<Told> &of_rank : dealii::Utilities::MPI::all_gather(all, tell))
      for (const Told &point : of_rank)
        if (ended[point.line])
          points[{point.line, point.number}] = point.x;
    std::size_t last = std::numeric_limits<std::size_t>::max();
    for (const auto &[key, x] : points)
      {
        if (key.first != last)
          lines->at_rest.emplace_back();
        last        = key.first;
        places[key] = lines->n_points++;
        lines->at_rest.back().push_back(x);
      }
    for (const Passed &point : own)
      if (const auto found = places.find({point.line, point.number}); found != places.end())
        lines->places.push_back({found->second, point.nodes, point.weights});
    for (const auto &line : lines->at_rest)
      lines->lengths.push_back(polyline_length(line));
    lines_ = std::move(lines);
  }

  Fascicles::~Fascicles() = default;

  std::size_t                Fascicles::size() const { return lines_->at_rest.size(); }
  const std::vector<double> &Fascicles::rest_lengths() const { return lines_->lengths; }
  double                     Fascicles::mean_rest_length() const
  {
    return std::accumulate(lines_->lengths.begin(), lines_->lengths.end(), 0.) / static_cast<double>(size());
  }
  std::array<std::size_t, 3>    Fascicles::ends() const { return lines_->ends; }
  std::vector<dealii::Point<3>> Fascicles::line(const std::size_t i) const { return lines_->at_rest.at(i); }

  std::vector<Fascicles::Shape> Fascicles::shapes(const State &state) const
  {
    const std::vector<Vector3>         u = lines_->values(state.u), v = lines_->values(state.v);
    const std::optional<LineOfAction> &line = system_.line_of_action().line;
    std::vector<Shape>                 shapes;
    std::size_t                        first = 0;
    for (const std::vector<dealii::Point<3>> &rest : lines_->at_rest)
      {
        Shape                  shape{0, 0, 0, std::numeric_limits<double>::quiet_NaN()};
        const auto             place = [&](const std::size_t i) { return rest[i] + u[first + i]; };
        std::optional<Vector3> before;
        double                 turning = 0, turned = 0; // over which length
        constexpr double       tiny  = 1e-3;            // of a step: a last one may be of any size, and its direction is rounding then
        double                 usual = 0;
        for (std::size_t i = 1; i < rest.size(); ++i)
          usual = std::max(usual, rest[i].distance(rest[i - 1]));
        for (std::size_t i = 1; i < rest.size(); ++i)
          {
            const Vector3 piece  = place(i) - place(i - 1);
            const double  length = piece.norm();
            shape.length += length;
            if (length > 0)
              shape.rate += piece * (v[first + i] - v[first + i - 1]) / length;
            if (rest[i].distance(rest[i - 1]) < tiny * usual)
              continue;
            if (before)
              {
                turning += std::atan2(cross_product_3d(*before, piece).norm(), *before * piece);
                turned += (before->norm() + length) / 2;
              }
            before = piece;
          }
        shape.curvature = turned > 0 ? turning / turned : 0;
        if (line)
          shape.angle = line->angle_to(place(rest.size() - 1) - place(0));
        shapes.push_back(shape);
        first += rest.size();
      }
    return shapes;
  }

  double ReferenceFibre::length() const
  {
    const Muscle3dParameters &parameters = system_.parameters();
    const BodyFields         &fields     = parameters.fields;
    const bool                uniform    = fields.direction[0].empty() && !fields.laplace && !fields.table;
    if (!parameters.geometry.mesh && uniform)
      return parameters.fibre_length();
    if (!traced_)
      traced_ = Fascicles(system_, enough_fascicles).mean_rest_length();
    return *traced_;
  }
} // namespace myolines
